"""The normal laws of one element or node: zones of linear laws, and where curves are looked up."""

from __future__ import annotations

from typing import Final

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.jit import jitted

_WIDEST: Final = 0.25 * float(np.finfo(np.float64).max)
_SMALL_SHARE: Final = 2.0**-960


@jitted
def zone(z: float, stiffness: float, h: float, one_sided: bool) -> tuple[float, float]:  # noqa: FBT001 - a number here
    """See `laws.smoothing.force_and_slope`."""
    start = 0.0 if one_sided else 0.0 - h
    if not z > start:
        return 0.0, 0.0
    if not z < (2.0 * h if one_sided else h):
        past = max(z - (h if one_sided else 0.0), 0.0)
        return stiffness * past, stiffness
    scale = 0.5 if h > _WIDEST else 1.0
    width = scale * h
    way = scale * z + (0.0 if one_sided else width)
    lift = 2.0**60 if way < _SMALL_SHARE * width else 1.0
    share = lift * way / (2.0 * width)
    large, small = max(stiffness, way), min(stiffness, way)
    return (large / lift * (share * (0.5 / scale))) * small, stiffness / lift * share


@jitted
def passed(ratios: FloatArray, first: int, last: int, ratio: float) -> int:
    """Index of the point to reckon from, of the points from `first` to `last` of all curves."""
    low, count = first, last - first + 1
    while count > 1:
        half = count // 2
        low = low + half if ratio >= ratios[low + half] else low
        count -= half
    return low
