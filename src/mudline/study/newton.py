"""Newton's method on k equations of one unknown, side by side."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray

Residual = Callable[[FloatArray], tuple[FloatArray, FloatArray, FloatArray]]
"""Residuals (k,) at unknowns (k,), their derivatives, and the size of the largest term in each residual."""

TOLERANCE = 1e-8
"""Of the residual, in the unit of force."""
ROUND_OFF = 16.0 * float(np.finfo(np.float64).eps)
"""Of the largest term of a residual: where forces are huge, this and not the tolerance can be reached."""

_HALVINGS = 10


class Solution(NamedTuple):
    """Arrays (k,).

    root: the last iterate.
    iterations: corrections made.
    residual: its amount where it is above the tolerance, NaN where it is not a number; 0 where it converged.
    evaluations: how often the residuals were evaluated.
    """

    root: FloatArray
    iterations: IndexArray
    residual: FloatArray
    evaluations: int


@dataclass(frozen=True, slots=True)
class Newton:
    """How to iterate.

    An equation has converged where |residual| < `tolerance`, or is no more than round-off of its largest term.

    Attributes:
        tolerance: in the unit of the residual.
        most: corrections after which an equation has failed.
        halving: whether a correction that does not lessen the residual is halved, up to ten times (line search).
        least: corrections that are made in any case. A time step makes one: accelerations below the tolerance would
            else stay for ever.
    """

    tolerance: float = TOLERANCE
    most: int = 50
    halving: bool = False
    least: int = 0

    def solve(self, residual: Residual, start: FloatArray) -> Solution:
        """Iterate from `start` (k,) until all equations have converged or failed; those that have stay as they are."""
        root = np.array(start, np.float64)
        iterations = np.zeros(root.shape, np.intp)
        with np.errstate(all="ignore"):
            value, slope, size = residual(root)
            evaluations = 1
            open_ = self._wanted(value, size, iterations)
            while open_.any():
                change = np.where(open_, 0.0 - value / slope, 0.0)
                value, slope, size, tries = self._move(residual, root, change, value)
                evaluations += tries
                iterations += open_
                open_ = open_ & self._wanted(value, size, iterations)
            left = np.where(self._converged(value, size), 0.0, np.abs(value))
        return Solution(root, iterations, left, evaluations)

    def _move(
        self, residual: Residual, root: FloatArray, change: FloatArray, before: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray, int]:
        """Change `root` in place; return the residuals there and how often they were evaluated."""
        origin = root.copy()
        value, slope, size = residual(origin + change)
        tries = 1
        while self.halving and tries <= _HALVINGS:
            worse = (change != 0.0) & ~(np.abs(value) < np.abs(before)) & ~self._converged(value, size)
            if not worse.any():
                break
            change = np.where(worse, 0.5 * change, change)
            value, slope, size = residual(origin + change)
            tries += 1
        root[...] = origin + change
        return value, slope, size, tries

    def _converged(self, value: FloatArray, size: FloatArray) -> BoolArray:
        return np.abs(value) < np.maximum(self.tolerance, ROUND_OFF * size)

    def _wanted(self, value: FloatArray, size: FloatArray, iterations: IndexArray) -> BoolArray:
        """Which equations need another correction, and may have one."""
        enough = self._converged(value, size) & (iterations >= self.least)
        return np.isfinite(value) & ~enough & (iterations < self.most)
