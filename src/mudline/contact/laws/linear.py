"""Linear normal law of `*ELASTIC SURFACE` and of STIFFNESS=number of `*SEABED PROPERTIES`."""

from __future__ import annotations

from dataclasses import dataclass

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.extras import Smoothing
from mudline.contact.inputs import ContactInput, LawKind
from mudline.contact.laws.smoothing import force_and_slope
from mudline.contact.laws.spring import Spring


def linear_spring(stiffness: FloatArray, depth: FloatArray, diameter: FloatArray) -> Spring:
    """Force = stiffness * depth, per unit length, for depth > 0.

    `stiffness` is force per unit length and length of penetration. The slope over the embedment ratio depth / diameter
    is stiffness * diameter, NaN where the diameter is.
    """
    return Spring(force=stiffness * depth, slope=stiffness * diameter, stiffness=stiffness)


@dataclass(frozen=True, slots=True)
class LinearSprings:
    """The elements with a linear law."""

    elements: IndexArray
    stiffness: FloatArray
    diameter: FloatArray
    smoothing: Smoothing | None = None

    def spring(self, element: IndexArray, depth: FloatArray, ratio: FloatArray) -> Spring:
        """See `Springs`."""
        del ratio  # the law is one of penetration
        stiffness, diameter = self.stiffness[element], self.diameter[element]
        if self.smoothing is None:
            return linear_spring(stiffness, depth, diameter).checked()
        width, one_sided = self.smoothing.half_width[element], self.smoothing.one_sided[element]
        force, slope = force_and_slope(depth, stiffness, width, one_sided)
        return Spring(force, slope * diameter, slope).checked()


def linear_springs(inputs: ContactInput) -> list[LinearSprings]:
    """Return the group of all elements with a linear law."""
    on_linear = inputs.with_law(LawKind.LINEAR)
    return [LinearSprings(on_linear, inputs.linear_stiffness, inputs.diameter, inputs.extras.smoothing)]
