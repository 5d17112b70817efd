"""Stage `suction`: what holds elements back that are lifted off the bed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.contact.ends import Ends
from mudline.contact.errors import refuse_nodes
from mudline.contact.extras import ElementSuction, SuctionSprings
from mudline.contact.inputs import ContactInput
from mudline.contact.result import ContactResult
from mudline.contact.suction import Suction, SuctionHistory, SuctionState, step, suction_spring
from mudline.contact.vectors import dot

if TYPE_CHECKING:  # suction does without unloading
    from mudline.contact.laws.unloading import UnloadingReaction


class UpliftSprings:
    """SUCTION= of `*SEABED PROPERTIES`: springs from the bed up to an extent, without history."""

    def __init__(self, inputs: ContactInput, springs: SuctionSprings, onset: FloatArray) -> None:
        self.elements: IndexArray = np.flatnonzero(springs.stiffness > 0.0)
        self._stiffness = springs.stiffness[self.elements]
        self._extent = springs.extent[self.elements]
        self._onset = onset[self.elements]
        self._diameter = inputs.diameter[self.elements]

    def apply(self, part: ContactResult) -> None:
        """Add to force, stiffness and slope of `part` (steps, m)."""
        uplift = self._onset - part.depth[:, self.elements]
        held = np.flatnonzero((uplift > 0.0) & (uplift <= self._extent))
        step, column = np.divmod(held, len(self.elements)) if held.size else (held, held)
        force, by_uplift = suction_spring(uplift.reshape(-1)[held], self._stiffness[column], self._extent[column])
        where = step * part.depth.shape[1] + self.elements[column]
        add_uplift(part, where, force, by_uplift, self._diameter[column])


class SuctionStage:
    """`*SEABED SUCTION`: one state for each element that has it."""

    def __init__(self, inputs: ContactInput, suction: ElementSuction, onset: FloatArray) -> None:
        self.elements = suction.elements
        self._law = suction.law
        self._ends = Ends(inputs.element_nodes, len(inputs.node_ids))
        self._node_ids = inputs.node_ids
        self._onset = onset[self.elements]
        self._diameter = inputs.diameter[self.elements]
        unloading = (
            np.zeros(0, np.intp)
            if inputs.extras.unloading is None
            else np.flatnonzero(~np.isnan(inputs.extras.unloading))
        )
        # which of these elements unload on a line of their own, and which of those that do so they are
        _, self._here, self._there = np.intersect1d(self.elements, unloading, assume_unique=True, return_indices=True)

    def initial(self) -> SuctionHistory:
        """Nothing has touched the bed."""
        return SuctionHistory.initial(len(self.elements))

    def apply(
        self,
        part: ContactResult,
        moving: FloatArray,
        history: SuctionHistory,
        unloading: UnloadingReaction | None,
        number: int,
    ) -> tuple[tuple[IndexArray, Suction], SuctionHistory]:
        """Add to the one step of `part`; return what pulls, with its elements, and the next history.

        `moving` (n, 3) are the velocities of the nodes in the step `number`. `unloading` is the reaction of elements on
        unloading lines, whose uplift counts from the trench bottom. An element without a depth, off the bed or without
        position, forgets what it knew.

        Raises:
            PositionError: the velocity of a node is not finite; those off the bed or without position do not count.
        """
        along = self._along_normals(part, moving, number)
        uplift = self._onset - part.depth[0][self.elements]
        compressed = part.contact[0][self.elements]
        if unloading is not None:
            self._from_trench_bottom(uplift, compressed, unloading)
        # all others are at rest: pressed, never pressed, or unknown
        loose = np.flatnonzero(
            (history.armed | (history.state == SuctionState.BROKEN)) & ~compressed & ~np.isnan(uplift)
        )
        elements = self.elements[loose]
        velocity = 0.5 * along[self._ends.first[elements]] + 0.5 * along[self._ends.second[elements]]
        suction, moved = step(
            self._law.rows(loose), history.rows(loose), uplift[loose], velocity, np.zeros(len(loose), np.bool_)
        )
        add_uplift(part, elements, suction.force, suction.by_uplift, self._diameter[loose])
        after = _after(compressed, loose, moved)
        if part.state is not None:
            part.state[0][self.elements] = after.state
        return (elements, suction), after

    def _along_normals(self, part: ContactResult, moving: FloatArray, number: int) -> FloatArray:
        """Velocities (n,) of the nodes along their normals."""
        along = dot(moving, part.normal[0])
        finite = np.isfinite(along)
        if not finite.all():
            refuse_nodes((~finite & ~np.isnan(part.gap[0]))[None], self._node_ids, number, "its velocity is not finite")
        return along

    def _from_trench_bottom(self, uplift: FloatArray, compressed: BoolArray, reaction: UnloadingReaction) -> None:
        """Put in uplift and compression those of the elements that unload on a line of their own."""
        known = ~np.isnan(uplift[self._here])
        uplift[self._here] = np.where(known, reaction.uplift[self._there], np.nan)
        compressed[self._here] = reaction.compressed[self._there]


def add_uplift(
    part: ContactResult, where: IndexArray, force: FloatArray, by_uplift: FloatArray, diameter: FloatArray
) -> None:
    """Add a force per unit length and its tangent, which is told by uplift, at flat positions of `part` (steps, m)."""
    if not where.size:
        return
    part.force.reshape(-1)[where] += force
    part.stiffness.reshape(-1)[where] -= by_uplift
    part.slope.reshape(-1)[where] -= by_uplift * diameter


def _after(compressed: BoolArray, loose: IndexArray, moved: SuctionHistory) -> SuctionHistory:
    """The history of all elements, from that of those that are `loose`."""
    after = SuctionHistory(compressed, np.zeros(len(compressed)), compressed.astype(np.int8))
    after.armed[loose], after.v_max[loose], after.state[loose] = moved.armed, moved.v_max, moved.state
    return after
