"""The least and the largest values over the steps of an evaluation, with the places of their first occurrence."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.model.scene.numbering import Floats, Indices

NO_STEP = -1
"""Step of a value that does not exist."""


class StepValues(NamedTuple):
    """Values (steps, k) of some steps: numbers, NaN for none, or a condition, whose steps are counted.

    `at` (steps, k) goes with the numbers: index of the element of a number, -1 for none.
    """

    values: NDArray[np.floating] | NDArray[np.bool_]
    at: NDArray[Any] | None = None


def largest_of_steps(values: Floats, chosen: Indices, *, by_size: bool = False) -> StepValues:
    """Return the largest of the values (steps, k) of each step, or that of the largest magnitude, as one column.

    `at` is the index in `chosen` (k,) of the first of equal ones.
    """
    if not values.shape[1]:
        return StepValues(np.full((len(values), 1), np.nan), np.full((len(values), 1), -1))
    ranked = np.where(np.isnan(values), -np.inf, np.abs(values) if by_size else values)
    column = ranked.argmax(axis=1)[:, np.newaxis]
    largest = np.take_along_axis(values, column, axis=1)
    return StepValues(largest, np.where(np.isnan(largest), -1, chosen[column]))


class PeakValue(NamedTuple):
    """A least or largest value over all steps, the step of its first occurrence, and the value that goes with it."""

    value: float
    step: int
    at: float = np.nan


class Best:
    """The least (`sign` 1) or the largest (-1) values of columns (k,) over steps.

    Attributes:
        values: the values; NaN without a value.
        steps: step of the first occurrence of each value, -1 without a value.
        at: value that goes with each of them, NaN for none.
    """

    def __init__(self, columns: int, sign: float) -> None:
        self._sign = sign
        self.values, self.at = np.full(columns, np.nan), np.full(columns, np.nan)
        self.steps = np.full(columns, NO_STEP, np.int64)

    def take(self, start: int, figure: StepValues) -> None:
        """Add the values of the steps from `start` on."""
        best = (np.fmin if self._sign > 0.0 else np.fmax).reduce(figure.values, axis=0)
        before = np.where(self.steps < 0, np.inf, self.values * self._sign)
        column = np.flatnonzero(best * self._sign < before)
        if column.size:
            row = (figure.values[:, column] == best[column]).argmax(axis=0)
            self.values[column], self.steps[column] = figure.values[row, column], start + row
            if figure.at is not None:
                self.at[column] = figure.at[row, column]

    def peak(self) -> PeakValue | None:
        """Return the best of all columns, the first of several equal ones; None without any."""
        known = np.flatnonzero(self.steps >= 0)
        if not known.size:
            return None
        at = known[np.lexsort((self.steps[known], self._sign * self.values[known]))[0]]
        return PeakValue(float(self.values[at]), int(self.steps[at]), float(self.at[at]))


class Extremes:
    """The least and the largest values of columns over steps."""

    def __init__(self, columns: int) -> None:
        self.least, self.largest = Best(columns, 1.0), Best(columns, -1.0)

    def take(self, start: int, figure: StepValues) -> None:
        """Add the values of the steps from `start` on."""
        self.least.take(start, figure)
        self.largest.take(start, figure)

    def farthest(self) -> PeakValue | None:
        """Return the value with the largest magnitude; None without any."""
        peaks = [peak for peak in (self.least.peak(), self.largest.peak()) if peak is not None]
        return min(peaks, key=lambda peak: (-abs(peak.value), peak.step), default=None)

    def extent(self, column: int, times: Floats | None) -> tuple[float, float, float, float] | None:
        """Return the least value of a column, its time, the largest value and its time; None without any."""
        if times is None or self.least.steps[column] < 0:
            return None
        low, high = (
            (float(best.values[column]), float(times[best.steps[column]])) for best in (self.least, self.largest)
        )
        return *low, *high
