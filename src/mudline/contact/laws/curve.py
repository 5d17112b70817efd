"""Force-embedment law of `*EMBEDMENT` and `*SEABED STIFFNESS`."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray, Picked
from mudline.contact.inputs import ContactInput, LawKind
from mudline.contact.laws.spring import LawError, Spring
from mudline.curves import ForceCurve, QueryError


def curve_spring(curve: ForceCurve, ratio: FloatArray, diameter: FloatArray) -> Spring:
    """Force and slope of the curve at the embedment ratio; stiffness = slope / diameter.

    Raises:
        LawError: the force overflows.
    """
    try:
        force, slope = curve.evaluate(ratio)
    except QueryError as error:
        raise LawError(str(error), error.index) from error
    return Spring(force, slope, stiffness=slope / diameter)


def cut_tension(spring: Spring) -> Spring:
    """Return the spring with force, slope and stiffness 0 where its force is negative."""
    pulls = spring.force < 0.0
    force, slope, stiffness = (np.where(pulls, 0.0, values) for values in spring[:3])
    return Spring(force, slope, stiffness, cut=pulls)


@dataclass(frozen=True, slots=True)
class CurveSprings:
    """The elements on one curve."""

    elements: IndexArray
    curve: ForceCurve
    diameter: FloatArray
    cuts: bool

    def spring(self, element: Picked, depth: FloatArray, ratio: FloatArray) -> Spring:
        """See `Springs`."""
        del depth  # the law is one of the ratio
        spring = curve_spring(self.curve, ratio, self.diameter[element])
        return (cut_tension(spring) if self.cuts else spring).checked()


def curve_springs(inputs: ContactInput) -> list[CurveSprings]:
    """Return a group for each curve that an element has."""
    on_curve = inputs.with_law(LawKind.CURVE)
    index = inputs.curve_index[on_curve]
    cuts = inputs.tension == "cut"
    return [
        CurveSprings(on_curve[index == used], inputs.curves[used], inputs.diameter, cuts) for used in np.unique(index)
    ]
