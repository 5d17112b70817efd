"""Linear normal law of `*ELASTIC SURFACE` and of STIFFNESS=number of `*SEABED PROPERTIES`."""

from __future__ import annotations

from dataclasses import dataclass

from mudline.contact.arrays import FloatArray, IndexArray, Picked
from mudline.contact.inputs import ContactInput, LawKind
from mudline.contact.laws.spring import Spring, Springs


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

    def spring(self, element: Picked, depth: FloatArray, ratio: FloatArray) -> Spring:
        """See `Springs`."""
        del ratio  # the law is one of penetration
        return linear_spring(self.stiffness[element], depth, self.diameter[element]).checked()


def linear_springs(inputs: ContactInput) -> list[Springs]:
    """Return the group of all elements with a linear law."""
    on_linear = inputs.with_law(LawKind.LINEAR)
    if inputs.extras.smoothing is None:
        return [LinearSprings(on_linear, inputs.linear_stiffness, inputs.diameter)]
    from mudline.contact.laws.smoothed import SmoothedSprings  # noqa: PLC0415 - only now is it needed

    return [SmoothedSprings(on_linear, inputs.linear_stiffness, inputs.diameter, inputs.extras.smoothing)]
