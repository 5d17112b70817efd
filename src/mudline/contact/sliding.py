"""Stage `friction`: the forces of the bed along u1 and u2 of the nodes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.extras import NodeFriction
from mudline.contact.friction.directions import at_angle, axial, senses
from mudline.contact.friction.law import FrictionHistory
from mudline.contact.friction.return_mapping import FrictionForce, slide
from mudline.contact.inputs import ContactInput
from mudline.contact.result import ContactResult
from mudline.contact.vectors import scaled

if TYPE_CHECKING:  # most friction has no trench
    from mudline.contact.trenches import TrenchStage


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

    def __init__(self, inputs: ContactInput, friction: NodeFriction, trench: TrenchStage | None) -> None:
        self._law = friction.law
        self._angle = friction.angle
        self._turned = np.flatnonzero(~np.isnan(friction.angle))
        self._elements = inputs.element_nodes
        self._sense = senses(inputs.element_nodes, len(inputs.node_ids))
        self._trench = trench

    def initial(self) -> FrictionHistory:
        """Nothing has touched the bed."""
        return FrictionHistory.start(self._law)

    def directions(self, points: FloatArray, normals: FloatArray) -> tuple[FloatArray, FloatArray]:
        """u1 and u2 of all nodes, each (n, 3)."""
        first, second = axial(points, self._elements, normals, self._sense)
        if self._turned.size:
            at = self._turned
            first[at], second[at] = at_angle(self._angle[at], normals[at])
        return first, second

    def apply(
        self, part: ContactResult, points: FloatArray, history: FrictionHistory, laid: FloatArray
    ) -> tuple[Sliding, FrictionHistory]:
        """Add to the reaction of the one step of `part`, whose nodes stand at `points` (n, 3).

        A node without a position, or off the bed, is open.
        """
        known = ~np.isnan(part.gap[0])
        places = np.where(known[:, None], points, 0.0)
        directions = self.directions(points, part.normal[0])  # of whole elements, also of those that leave the bed
        compression = np.where(known, part.normal_force[0], 0.0)
        ditch = None if self._trench is None else self._trench.locate(places, directions[1], laid)
        moved = slide(self._law, history, places, directions, compression, None if ditch is None else ditch.extra)
        for side, axis in enumerate(directions):
            part.reaction[0] += scaled(axis, moved.force[:, side])
        if part.friction is not None and part.friction_state is not None:
            part.friction[0] += moved.force
            part.friction_state[0] = moved.history.states
        follows = np.isnan(self._angle)
        if ditch is None:
            return Sliding(moved, directions, follows), moved.history
        return Sliding(moved, directions, follows, ditch.away, ditch.gradient), moved.history
