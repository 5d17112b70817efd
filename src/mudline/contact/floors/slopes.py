"""Slopes at the points of a profile, for a cubic between each two: value and slope given at both ends.

Both ways have slope 0 at the first and the last point, so the flat bed beyond goes on smoothly.
Widths `h` (n - 1,) of the segments and their chord slopes `c` (n - 1,) in, slopes (n,) out.
"""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray


def bessel_slopes(h: FloatArray, c: FloatArray) -> FloatArray:
    """Slope of the parabola through a point and its two neighbours: a curve with continuous slope."""
    share = h[1:] / (h[:-1] + h[1:])
    return np.concatenate([[0.0], share * c[:-1] + (1.0 - share) * c[1:], [0.0]])


def spline_slopes(h: FloatArray, c: FloatArray) -> FloatArray:
    """Slopes with which the curvature is continuous too: share m- + 2 m + (1 - share) m+ = 3 (Bessel's slope).

    The system is diagonally dominant, so elimination needs no pivots.
    """
    share = (h[1:] / (h[:-1] + h[1:])).tolist()
    right = (3.0 * bessel_slopes(h, c)[1:-1]).tolist()
    upper, before = [0.0], [0.0]
    for low, value in zip(share, right, strict=True):
        pivot = 2.0 - low * upper[-1]
        upper.append((1.0 - low) / pivot)
        before.append((value - low * before[-1]) / pivot)
    slopes = np.zeros(len(h) + 1)
    for number in range(len(h) - 1, 0, -1):
        slopes[number] = before[number] - upper[number] * slopes[number + 1]
    return slopes
