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
        self._linear = inputs.linear_stiffness[self.elements]
        index = np.where(inputs.law[self.elements] == LawKind.CURVE, inputs.curve_index[self.elements], -1)
        self._curves = [(inputs.curves[used], np.flatnonzero(index == used)) for used in np.unique(index[index >= 0])]

    def initial(self) -> UnloadingHistory:
        """Nothing has touched the bed."""
        return UnloadingHistory.initial(self._stiffness)

    def apply(self, part: ContactResult, history: UnloadingHistory) -> tuple[UnloadingReaction, UnloadingHistory]:
        """Put the reaction in the place of the virgin one, of the one step of `part`.

        An element without a depth keeps its history and has no reaction.
        """
        at = (0, self.elements)
        known = ~np.isnan(part.depth[at])
        depth = np.where(known, np.maximum(part.depth[at], 0.0), 0.0)
        virgin = VirginPath(part.force[at], part.stiffness[at], self._steepest(depth))
        reaction, after = unloading.step(history, depth, virgin)
        uplift = np.where(known, after.z_p - part.depth[at], 0.0)
        reaction = reaction._replace(uplift=uplift, compressed=reaction.compressed & known)
        part.force[at] = reaction.force
        part.stiffness[at] = reaction.stiffness
        part.slope[at] = reaction.stiffness * self._diameter
        return reaction, after

    def _steepest(self, depth: FloatArray) -> FloatArray:
        """The steepest slope of the virgin path between the mudline and each depth."""
        steepest = np.where(np.isnan(self._linear), 0.0, self._linear)
        for curve, rows in self._curves:
            diameter = self._diameter[rows]
            steepest[rows] = unloading.steepest_slope(curve, depth[rows] / diameter) / diameter
        return steepest
