"""Newton's method with a bracket on k equations of one unknown side by side."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import BoolArray, FloatArray

Residual = Callable[[FloatArray], tuple[FloatArray, FloatArray, FloatArray]]
"""Residuals (k,) at unknowns (k,), their derivatives, and the size of the largest term in each residual."""

_TOLERANCE, _MOST = 1e-8, 100
"""In the unit of the residual; corrections after which an equation has failed."""
_ROUND_OFF = 16.0 * float(np.finfo(np.float64).eps)
"""Of the largest term of a residual: where forces are huge, this and not the tolerance can be reached."""
_COLLAPSED = 4.0 * float(np.finfo(np.float64).eps)
"""Width of a bracket over its larger end: nothing lies between its ends any more, so the residual jumps there."""


class Solution(NamedTuple):
    """Arrays (k,): roots, NaN where an equation has failed; `jumps` where the residual jumps across 0 at the root."""

    root: FloatArray
    jumps: BoolArray


def solve(residual: Residual, start: FloatArray) -> Solution:
    """Iterate from `start` (k,) until all equations have converged or failed; those that have stay as they are.

    At least one correction is made: accelerations below the tolerance would otherwise never change. The two nearest
    points between which the residual changes its sign are kept, and their middle is taken where a correction leads out
    of them, so no iterates alternate.
    """
    root = np.array(start, np.float64)
    low, high = np.full(root.shape, -np.inf), np.full(root.shape, np.inf)
    jumps: BoolArray = np.zeros(root.shape, np.bool_)
    value, slope, size = residual(root)
    open_: BoolArray = np.isfinite(value)
    for _ in range(_MOST):
        low, high = np.where(value < 0.0, root, low), np.where(value > 0.0, root, high)
        change = 0.0 - value / slope
        inside = (root + change > low) & (root + change < high)
        middle = 0.5 * low + 0.5 * high
        toward = np.copysign(np.where(np.isfinite(change), change, 1.0 + np.abs(root)), -value)
        change = np.where(inside, change, np.where(np.isfinite(middle), middle - root, toward))
        root = np.where(open_, root + change, root)
        value, slope, size = residual(root)
        open_ &= np.isfinite(value) & ~(np.abs(value) < np.maximum(_TOLERANCE, _ROUND_OFF * size))
        width = _COLLAPSED * np.maximum(np.abs(low), np.abs(high))
        now = open_ & np.isfinite(width) & (high - low <= width)
        jumps, open_ = jumps | now, open_ & ~now
        if not open_.any():
            break
    return Solution(np.where(open_ | ~np.isfinite(value), np.nan, root), jumps)
