"""Newton's method on k equations of one unknown side by side: plain, with halved corrections, or with a bracket."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray

Residual = Callable[[FloatArray], tuple[FloatArray, FloatArray, FloatArray]]
"""Residuals (k,) at unknowns (k,), their derivatives, and the size of the largest term in each residual."""

_ROUND_OFF = 16.0 * float(np.finfo(np.float64).eps)
"""Of the largest term of a residual: where forces are huge, this and not the tolerance can be reached."""
_HALVED_AWAY = 30
"""Fewer corrections leave numbers in a bracket."""
_COLLAPSED = 4.0 * float(np.finfo(np.float64).eps)
"""Width of a bracket over its larger end: nothing lies between its ends any more, so the residual jumps there."""


class Solution(NamedTuple):
    """Arrays (k,).

    root: the last iterate.
    iterations: corrections made.
    residual: its amount where it is above the tolerance, NaN where it is not a number; 0 where it converged.
    evaluations: how often the residual was evaluated; solved alone each equation would take as many.
    jumps: where the residual jumps across 0 at the root, so that nothing but the root can be given.
    """

    root: FloatArray
    iterations: IndexArray
    residual: FloatArray
    evaluations: IndexArray
    jumps: BoolArray


@dataclass(frozen=True, slots=True)
class Newton:
    """Settings of the iteration.

    An equation has converged where |residual| < `tolerance`, or is no more than round-off of its largest term.

    Attributes:
        tolerance: in the unit of the residual.
        most: corrections after which an equation has failed.
        least: corrections that are made in any case. A time step makes one: accelerations below the tolerance would
            otherwise never change.
        halvings: how often a correction that does not lessen the residual is halved (line search).
        bracketed: whether the two nearest points are kept between which the residual changes its sign, from negative to
            positive, and their middle is taken where a correction leads out of them. So no iterates alternate.
    """

    tolerance: float = 1e-8
    most: int = 50
    least: int = 0
    halvings: int = 0
    bracketed: bool = False

    def solve(self, residual: Residual, start: FloatArray) -> Solution:
        """Iterate from `start` (k,) until all equations have converged or failed; those that have stay as they are."""
        root = np.array(start, np.float64)
        iterations, evaluations = np.zeros(root.shape, np.intp), np.ones(root.shape, np.intp)
        jumps: BoolArray = np.zeros(root.shape, np.bool_)
        bracket = _Bracket(root.shape)
        with np.errstate(all="ignore"):
            value, slope, size = residual(root)
            open_ = self._wanted(value, size, iterations)
            while open_.any():
                change = np.where(open_, 0.0 - value / slope, 0.0)
                if self.bracketed:
                    change = np.where(open_, bracket.keep(root, value, change), 0.0)
                value, slope, size = self._move(residual, root, change, value, evaluations)
                iterations += open_
                evaluations += open_
                open_ = open_ & self._wanted(value, size, iterations)
                if self.bracketed and iterations.max() > _HALVED_AWAY:
                    jumps |= open_ & bracket.collapsed(root, value)
                    open_ = open_ & ~jumps
            left = np.where(self._converged(value, size) | jumps, 0.0, np.abs(value))
        return Solution(root, iterations, left, evaluations, jumps)

    def _move(
        self, residual: Residual, root: FloatArray, change: FloatArray, before: FloatArray, evaluations: IndexArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Change `root` in place and count the halvings; return the residuals there."""
        origin = root.copy()
        value, slope, size = residual(origin + change)
        for _ in range(self.halvings):
            worse = (change != 0.0) & ~(np.abs(value) < np.abs(before)) & ~self._converged(value, size)
            if not worse.any():
                break
            change = np.where(worse, 0.5 * change, change)
            value, slope, size = residual(origin + change)
            evaluations += worse
        root[...] = origin + change
        return value, slope, size

    def _converged(self, value: FloatArray, size: FloatArray) -> BoolArray:
        return np.abs(value) < np.maximum(self.tolerance, _ROUND_OFF * size)

    def _wanted(self, value: FloatArray, size: FloatArray, iterations: IndexArray) -> BoolArray:
        """Which equations need another correction, and may have one."""
        enough = self._converged(value, size) & (iterations >= self.least)
        return np.isfinite(value) & ~enough & (iterations < self.most)


class _Bracket:
    """The nearest points below and above a root at which a residual was negative and positive."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        self._low, self._high = np.full(shape, -np.inf), np.full(shape, np.inf)

    def _narrow(self, root: FloatArray, value: FloatArray) -> None:
        self._low = np.where(value < 0.0, root, self._low)
        self._high = np.where(value > 0.0, root, self._high)

    def keep(self, root: FloatArray, value: FloatArray, change: FloatArray) -> FloatArray:
        """The corrections, those to the middle where they would leave the bracket, and none away from the root."""
        self._narrow(root, value)
        trial = root + change
        middle = 0.5 * self._low + 0.5 * self._high
        inside = (trial > self._low) & (trial < self._high)
        toward = np.copysign(np.where(np.isfinite(change), change, 1.0 + np.abs(root)), -value)
        return np.where(inside, change, np.where(np.isfinite(middle), middle - root, toward))

    def collapsed(self, root: FloatArray, value: FloatArray) -> BoolArray:
        """Where the bracket holds no other number than its ends."""
        self._narrow(root, value)
        width = _COLLAPSED * np.maximum(np.abs(self._low), np.abs(self._high))
        narrow: BoolArray = np.isfinite(width) & (self._high - self._low <= width)
        return narrow
