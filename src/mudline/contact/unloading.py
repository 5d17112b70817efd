"""Stage `unloading`: the reaction leaves the virgin path when the motion turns."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.inputs import ContactInput, LawKind
from mudline.contact.laws import unloading
from mudline.contact.laws.unloading import UnloadingHistory, UnloadingReaction, VirginPath
from mudline.contact.result import ContactResult


class Unloading:
    """The elements that have an unloading stiffness; `stiffness` (m,) is NaN for the others."""

    def __init__(self, inputs: ContactInput, stiffness: FloatArray) -> None:
        self.elements: IndexArray = np.flatnonzero(~np.isnan(stiffness))
        self._stiffness = stiffness[self.elements]
        self._diameter = inputs.diameter[self.elements]
        linear = inputs.linear_stiffness[self.elements]
        self._linear = np.where(np.isnan(linear), 0.0, linear)
        on_curve = inputs.law[self.elements] == LawKind.CURVE
        self._index = np.where(on_curve, inputs.curve_index[self.elements], -1)
        self._curves = [(used, inputs.curves[used]) for used in np.unique(self._index[on_curve]).tolist()]

    def initial(self) -> UnloadingHistory:
        """Nothing has touched the bed."""
        return UnloadingHistory.initial(self._stiffness)

    def apply(self, part: ContactResult, history: UnloadingHistory) -> tuple[UnloadingReaction, UnloadingHistory]:
        """Put the reaction in the place of the virgin one, of the one step of `part`.

        An element without a depth keeps its history and has no reaction.
        """
        found = part.depth[0][self.elements]
        depth = np.fmax(found, 0.0)
        force, stiffness = part.force[0][self.elements], part.stiffness[0][self.elements]
        (deeper,) = (depth > history.z_max).nonzero()
        reaction, after = unloading.step(history, depth, VirginPath(force, stiffness, self._steepest(depth, deeper)))
        known = ~np.isnan(found)
        uplift = np.where(known, after.z_p - found, 0.0)
        reaction = reaction._replace(uplift=uplift, compressed=reaction.compressed & known)
        part.force[0][self.elements] = reaction.force
        part.stiffness[0][self.elements] = reaction.stiffness
        part.slope[0][self.elements] = reaction.stiffness * self._diameter
        return reaction, after

    def _steepest(self, depth: FloatArray, deeper: IndexArray) -> FloatArray:
        """The steepest slope of the virgin path between the mudline and each depth; of curves where it is `deeper`."""
        steepest = self._linear.copy()
        if not deeper.size:
            return steepest
        for number, curve in self._curves:
            rows = deeper[self._index[deeper] == number]
            diameter = self._diameter[rows]
            steepest[rows] = unloading.steepest_slope(curve, depth[rows] / diameter) / diameter
        return steepest
