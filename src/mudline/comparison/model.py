"""A difference between two decks, and how values are compared."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

Value: TypeAlias = float | int | str | list["Value"] | None
"""What is reported of a value; None where there is none."""

Kind = Literal["added", "removed", "changed"]


@dataclass(frozen=True, slots=True)
class Difference:
    """One difference. `group` is what it belongs to, `where` a path with `/` between its steps.

    `before` and `after` are the values in the first and the second deck, None where there is none; the lines count from
    1 and are None where the thing stands in no line of that file.
    """

    kind: Kind
    group: str
    where: str
    before: Value = None
    after: Value = None
    before_line: int | None = None
    after_line: int | None = None


@dataclass(frozen=True, slots=True)
class Tolerance:
    """How far two numbers may be apart, relative to the larger one; NaN is equal to NaN."""

    relative: float = 0.0

    def arrays(self, one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Where two arrays of one shape are equal."""
        same: NDArray[np.bool_] = (one == other) | (np.isnan(one) & np.isnan(other))
        if self.relative:
            # Halves, because the difference of two large numbers may overflow; inf stays apart from everything.
            with np.errstate(invalid="ignore"):
                apart = np.abs(one / 2 - other / 2)
                near = apart <= self.relative * np.maximum(np.abs(one / 2), np.abs(other / 2))
            same |= near & np.isfinite(one) & np.isfinite(other)
        return same

    def values(self, one: object, other: object) -> bool:
        """Whether two values are equal; texts compare without case."""
        if _is_number(one) and _is_number(other):
            return bool(self.arrays(np.array([one], dtype=np.float64), np.array([other], dtype=np.float64))[0])
        if isinstance(one, list | tuple) and isinstance(other, list | tuple):
            return len(one) == len(other) and all(map(self.values, one, other))
        if isinstance(one, str) and isinstance(other, str):
            return one.casefold() == other.casefold()
        return one == other


def _is_number(value: object) -> bool:
    return isinstance(value, int | float)


def plain(value: float) -> Value:
    """A number as JSON can hold it; None for NaN, a text for an infinite one."""
    if math.isfinite(value):
        return value
    return None if math.isnan(value) else str(value)
