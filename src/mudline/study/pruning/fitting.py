"""How a cost grows: the exponent of a power law through measured points."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def exponent(sizes: Sequence[float], seconds: Sequence[float]) -> float:
    """Slope of the straight line through log(size), log(seconds), by least squares; NaN for less than two sizes."""
    if len(set(sizes)) < 2:
        return float("nan")
    x, y = np.log(np.asarray(sizes, np.float64)), np.log(np.asarray(seconds, np.float64))
    x = x - x.mean()
    return float((x * (y - y.mean())).sum() / (x * x).sum())


def upper_half(sizes: Sequence[float], seconds: Sequence[float]) -> float:
    """The same for the larger half of the sizes, where the constant part of the cost matters least."""
    start = len(sizes) // 2
    return exponent(sizes[start:], seconds[start:])


def per_unit(sizes: Sequence[float], seconds: Sequence[float]) -> float:
    """Seconds that one more unit costs at the largest size: the difference of the last two points."""
    if len(sizes) < 2:
        return float("nan")
    return (seconds[-1] - seconds[-2]) / (sizes[-1] - sizes[-2])
