"""Force-embedment law of `*EMBEDMENT` and `*SEABED STIFFNESS`: a curve over the ratio of penetration to diameter.

    F = F_i + s_i (z / D - r_i),  dF/dz = s_i / D

in the segment i that contains z / D; see `mudline.model.curves`. A negative force is kept, or cut to 0.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws import NormalLaw, Parameter, Value

if TYPE_CHECKING:
    from mudline.model.curves import ForceCurve


def on_segment(ratio: Value, start: Value, force: Value, slope: Value) -> Value:
    """Return the force at a ratio of the segment with this start, force and slope."""
    return force + slope * (ratio - start)


def steepest_slopes(curve: ForceCurve) -> FloatArray:
    """Return for each segment (n - 1,) the steepest slope between the mudline and its end."""
    first = int(curve.segment(np.zeros(1))[0])
    slopes: FloatArray = np.concatenate(
        [np.full(first, curve.slopes[first]), np.maximum.accumulate(curve.slopes[first:])]
    )
    return slopes


def steepest_slope(curve: ForceCurve, ratio: FloatArray) -> FloatArray:
    """Return the steepest slope (d force / d ratio) of the curve between the mudline and each embedment ratio > 0.

    At a point of the curve the segment to its right is not included; an infinite ratio includes the whole curve.
    """
    return steepest_slopes(curve)[np.searchsorted(curve.ratios[1:-1], ratio)]


CURVE = NormalLaw(
    name="curve",
    summary="force-embedment curve",
    acts_on="elements",
    parameters=(Parameter("curve", "1", "index of the curve"),),
    needs_diameter=True,
    tables=True,
    equation="F = F_i + s_i (z / D - r_i)",
    source="definition of *EMBEDMENT and *SEABED STIFFNESS",
)
