"""Stage `suction`: what holds elements back that are lifted off the bed."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.contact.errors import refuse_nodes
from mudline.contact.extras import ElementSuction, SuctionSprings
from mudline.contact.inputs import ContactInput
from mudline.contact.result import ContactResult
from mudline.contact.suction import Suction, SuctionHistory, SuctionState, step, suction_spring

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
        force, by_uplift = suction_spring(uplift, self._stiffness, self._extent)
        add_uplift(part, self.elements, force, by_uplift, self._diameter)


class SuctionStage:
    """`*SEABED SUCTION`: one state for each element that has it."""

    def __init__(self, inputs: ContactInput, suction: ElementSuction, onset: FloatArray) -> None:
        self.elements = suction.elements
        self._law = suction.law
        self._ends = inputs.element_nodes
        self._node_ids = inputs.node_ids
        self._onset = onset[self.elements]
        self._diameter = inputs.diameter[self.elements]

    def initial(self) -> SuctionHistory:
        """Nothing has touched the bed."""
        return SuctionHistory.initial(len(self.elements))

    def pull_out(self, part: ContactResult, moving: FloatArray, number: int) -> FloatArray:
        """Pull-out velocities (m,) of all elements in the step `number`, the mean of those of their nodes.

        `moving` (n, 3) are the velocities of the nodes; those off the bed or without position do not count.

        Raises:
            PositionError: the velocity of a node that counts is not finite.
        """
        along = np.einsum("ij,ij->i", moving, part.normal[0])
        wrong = ~np.isfinite(along) & ~np.isnan(part.gap[0])
        refuse_nodes(wrong[None], self._node_ids, number, "its velocity is not finite")
        first, second = self._ends.T
        mean: FloatArray = 0.5 * along[first] + 0.5 * along[second]
        return mean

    def apply(
        self,
        part: ContactResult,
        velocity: FloatArray,
        history: SuctionHistory,
        unloading: tuple[IndexArray, UnloadingReaction] | None,
    ) -> tuple[Suction, SuctionHistory]:
        """Add to the one step of `part`; `velocity` (m,) is the pull-out velocity of all elements.

        `unloading` are the elements on unloading lines, whose uplift counts from the trench bottom. An element without
        a depth, off the bed or without position, forgets what it knew.
        """
        uplift = self._onset - part.depth[0, self.elements]
        compressed = part.contact[0, self.elements]
        if unloading is not None:
            uplift, compressed = self._from_trench_bottom(uplift, compressed, *unloading)
        known = ~np.isnan(uplift)
        motion = np.where(known, velocity[self.elements], 0.0)
        suction, after = step(self._law, history, np.where(known, uplift, 0.0), motion, compressed & known)
        if not known.all():
            suction = Suction(*(np.where(known, values, 0.0) for values in suction))
            after = _forgotten(after, ~known)
        add_uplift(part, self.elements, suction.force, suction.by_uplift, self._diameter)
        if part.state is not None:
            part.state[0, self.elements] = after.state
        return suction, after

    def _from_trench_bottom(
        self, uplift: FloatArray, compressed: BoolArray, elements: IndexArray, reaction: UnloadingReaction
    ) -> tuple[FloatArray, BoolArray]:
        """Uplift and compression with those of the elements that unload on a line of their own."""
        shared, here, there = np.intersect1d(self.elements, elements, assume_unique=True, return_indices=True)
        del shared
        uplift, compressed = uplift.copy(), compressed.copy()
        known = ~np.isnan(uplift[here])
        uplift[here[known]] = reaction.uplift[there[known]]
        compressed[here] = reaction.compressed[there]
        return uplift, compressed


def add_uplift(
    part: ContactResult, elements: IndexArray, force: FloatArray, by_uplift: FloatArray, diameter: FloatArray
) -> None:
    """Add a force per unit length and its tangent, which is told by uplift, to elements of `part`."""
    part.force[:, elements] += force
    part.stiffness[:, elements] -= by_uplift
    part.slope[:, elements] -= by_uplift * diameter


def _forgotten(history: SuctionHistory, which: BoolArray) -> SuctionHistory:
    return replace(
        history,
        armed=history.armed & ~which,
        v_max=np.where(which, 0.0, history.v_max),
        state=np.where(which, np.int8(SuctionState.FREE), history.state),
    )
