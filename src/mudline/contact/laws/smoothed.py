"""Linear normal laws with quadratic zones; see `smoothing` for the law itself."""

from __future__ import annotations

from dataclasses import dataclass

from mudline.contact.arrays import FloatArray, IndexArray, Picked
from mudline.contact.extras import Smoothing
from mudline.contact.laws.smoothing import force_and_slope
from mudline.contact.laws.spring import Spring


@dataclass(frozen=True, slots=True)
class SmoothedSprings:
    """The elements with a linear law, some of them with a zone."""

    elements: IndexArray
    stiffness: FloatArray
    diameter: FloatArray
    smoothing: Smoothing

    def spring(self, element: Picked, depth: FloatArray, ratio: FloatArray) -> Spring:
        """See `Springs`."""
        del ratio  # the law is one of penetration
        width, one_sided = self.smoothing.half_width[element], self.smoothing.one_sided[element]
        force, slope = force_and_slope(depth, self.stiffness[element], width, one_sided)
        return Spring(force, slope * self.diameter[element], slope).checked()
