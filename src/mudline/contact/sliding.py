"""Stage `friction`: the forces of the bed along u1 and u2 of the nodes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.extras import NodeFriction
from mudline.contact.friction.directions import at_angle
from mudline.contact.friction.law import FrictionHistory
from mudline.contact.friction.return_mapping import FrictionForce, Moved, PreparedLaw, move
from mudline.contact.result import ContactResult
from mudline.contact.vectors import gathered

if TYPE_CHECKING:  # most friction has no trench
    from mudline.contact.trenches import InTrench, TrenchStage


@dataclass(frozen=True, slots=True, eq=False)
class Sliding:
    """Friction of one step at nodes (n,): forces and derivatives, the directions, and where trenches are.

    `follows` (n,) marks nodes whose directions turn with the line. `to_centreline` (n, 3) is the way from the
    centreline to the node, None without trenches, and `offset_gradient` (n, 3) the derivative of the offset along u2 by
    the node's position.
    """

    force: FrictionForce
    directions: tuple[FloatArray, FloatArray]
    follows: BoolArray
    to_centreline: FloatArray | None = None
    offset_gradient: FloatArray | None = None


class FrictionStage:
    """Friction of the nodes that have it, with the trenches they lie in."""

    def __init__(self, friction: NodeFriction, trench: TrenchStage | None, same_normal: FloatArray | None) -> None:
        self._law = PreparedLaw(friction.law)
        self._angle = friction.angle
        self._turned = np.flatnonzero(~np.isnan(friction.angle))
        self._trench = trench
        self._fixed = (
            None if same_normal is None else self._at_angle(np.broadcast_to(same_normal, (len(self._turned), 3)))
        )

    def initial(self) -> FrictionHistory:
        """Nothing has touched the bed."""
        return FrictionHistory.start(self._law.law)

    def apply(
        self,
        part: ContactResult,
        points: FloatArray,
        along: tuple[FloatArray, FloatArray],
        history: FrictionHistory,
        laid: FloatArray,
        *,
        detailed: bool = True,
    ) -> tuple[Sliding | None, FrictionHistory]:
        """Add to the reaction of the one step of `part`, whose nodes stand at `points` (n, 3).

        `along` are the directions of the line and across it (n, 3), of whole elements, also of those that leave the
        bed. A node without a position, or off the bed, is open. Without `detailed` there are no derivatives.
        """
        absent = np.isnan(part.gap[0])
        places, compression = points, part.normal_force[0]
        if absent.any():
            places = np.where(absent[:, None], 0.0, points)
            compression = np.where(absent, 0.0, compression)
        directions = self._turn(along, part.normal[0])
        ditch = (
            None
            if self._trench is None
            else self._trench.locate(places, directions[1], laid, compression > 0.0, detailed=detailed)
        )
        moved = move(self._law, history, places, directions, compression, None if ditch is None else ditch.extra)
        _add(part, moved, directions)
        if not detailed:
            return None, moved.history
        return self._in_detail(moved, directions, ditch), moved.history

    def _turn(self, along: tuple[FloatArray, FloatArray], normals: FloatArray) -> tuple[FloatArray, FloatArray]:
        """u1 and u2 of all nodes, each (n, 3): those of the line, or at an angle to +Y."""
        if not self._turned.size:
            return along
        first, second = (np.array(axis, order="F") for axis in along)
        turned = self._at_angle(gathered(normals, self._turned)) if self._fixed is None else self._fixed
        for whole, values in zip((first, second), turned, strict=True):
            for column, part in zip(whole.T, values.T, strict=True):
                column[self._turned] = part
        return first, second

    def _at_angle(self, normals: FloatArray) -> tuple[FloatArray, FloatArray]:
        """u1 and u2 of the nodes at an angle to +Y, whose normals (k, 3) are given."""
        first, second = at_angle(self._angle[self._turned], normals)
        return np.asfortranarray(first), np.asfortranarray(second)

    def _in_detail(self, moved: Moved, directions: tuple[FloatArray, FloatArray], ditch: InTrench | None) -> Sliding:
        from mudline.contact.friction.derivatives import with_derivatives  # noqa: PLC0415 - only tangents need it

        follows = np.isnan(self._angle)
        if ditch is None:
            return Sliding(with_derivatives(self._law, moved, None), directions, follows)
        force = with_derivatives(self._law, moved, ditch.extra)
        return Sliding(force, directions, follows, ditch.away, ditch.gradient)


def _add(part: ContactResult, moved: Moved, directions: tuple[FloatArray, FloatArray]) -> None:
    term = np.empty(len(moved.force))
    for side, axis in enumerate(directions):
        for component in range(3):
            part.reaction[0, :, component] += np.multiply(axis[:, component], moved.force[:, side], out=term)
    if part.friction is not None and part.friction_state is not None:
        part.friction[0] += moved.force
        part.friction_state[0] = moved.history.states
