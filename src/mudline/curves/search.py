"""How many points of a curve lie at or below each ratio: one answer, three ways to find it.

A search serves one query, a block at a time. `passed` is asked for the points after the first only, so its answer is
also the index of the point to reckon the force from.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from mudline.curves.arrays import FloatArray, IndexArray
from mudline.curves.buckets import BucketTable
from mudline.curves.knots import Knots
from mudline.curves.work import Work

_COUNTED_POINTS = 20
"""Up to this many points, counting is faster than a table."""

_FEW_RATIOS = 1024
"""Below this, the calls that the other ways make cost more than a binary search."""


class Search(Protocol):
    """Counts the points at or below ratios."""

    def passed(self, ratio: FloatArray) -> IndexArray:
        """Return how many points lie at or below each ratio; any valid number for NaN. Valid until the next call."""
        ...


def search_for(knots: Knots, total: int, work: Work) -> Search:
    """Return the fastest search for a query of `total` ratios."""
    if total < _FEW_RATIOS:
        return Bisection(knots.inner)
    if len(knots.inner) <= _COUNTED_POINTS:
        return Counting(knots.inner, work)
    if knots.table is not None or total >= len(knots.inner):
        return Bucketing(knots.prepare(), work)
    return Bisection(knots.inner)


class Bisection:
    """Binary search: for any points, and nothing to prepare."""

    def __init__(self, points: FloatArray) -> None:
        self._points = points

    def passed(self, ratio: FloatArray) -> IndexArray:
        """See `Search`."""
        return np.searchsorted(self._points, ratio, side="right")


class Counting:
    """Compares every ratio with every point: for few points, however they are spaced."""

    def __init__(self, points: FloatArray, work: Work) -> None:
        self._points = points
        self._work = work

    def passed(self, ratio: FloatArray) -> IndexArray:
        """See `Search`."""
        work, size = self._work, len(ratio)
        count, flag, index = work.small.view(np.uint8)[:size], work.flag[:size], work.index[:size]
        more = flag.view(np.uint8)
        np.greater_equal(ratio, self._points[0], out=count.view(np.bool_))
        for point in self._points[1:]:
            np.greater_equal(ratio, point, out=flag)
            np.add(count, more, out=count)
        index[...] = count
        return index


class Bucketing:
    """Looks into a table of buckets; bisects for ratios in a bucket of several points."""

    def __init__(self, table: BucketTable, work: Work) -> None:
        self._table = table
        self._points = table.knots[:-1]
        self._work = work
        self._in_vain = False

    def passed(self, ratio: FloatArray) -> IndexArray:
        """See `Search`."""
        if self._in_vain:
            return np.searchsorted(self._points, ratio, side="right")
        table, work, size = self._table, self._work, len(ratio)
        below, flag = work.small.view(table.below.dtype)[:size], work.flag[:size]
        index, knot = work.index[:size], work.real[:size]
        key = np.add(ratio, table.addend, out=knot).view(np.int64)
        np.right_shift(key, table.shift, out=key)
        np.subtract(key, table.base, out=key)
        np.take(table.below, key, out=below, mode="clip")
        index[...] = below
        np.take(table.knots, index, out=knot, mode="clip")
        np.greater_equal(ratio, knot, out=flag)
        np.add(index, flag, out=index)
        if below.max() > len(self._points):
            crowded = np.flatnonzero(np.greater(below, len(self._points), out=flag))
            index[crowded] = np.searchsorted(self._points, ratio[crowded], side="right")
            # More than half in crowded buckets: the binary search alone is faster.
            self._in_vain = 2 * len(crowded) > size
        return index
