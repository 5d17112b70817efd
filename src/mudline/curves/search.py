"""How many points of a curve lie at or below each ratio: one answer, three ways to find it.

A search serves one query, a block at a time. It searches the points after the first only, so its answer is also the
index of the point from which the force is computed.

The table of buckets replaces a binary search. The key of a ratio r is the upper bits of the float64 r + c: of a
positive sum they grow with r. Within one power of two they grow evenly, so a large c gives buckets of equal width, and
c = 0 gives the same number of buckets to every power of two. Rounding keeps the order, so a point with a lower key lies
below r and one with a higher key above; only points in the bucket of r have to be compared with r. What is below the
first bucket, negative sums among it, is assigned to the first, what is above the last to the last.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from mudline.curves.points import FloatArray, IndexArray, read_only

BLOCK = 32768
"""Numbers at a time, so that the work arrays and the tables of a curve stay in the second-level cache."""


def blocks(source: NDArray[np.generic], *targets: NDArray[np.generic]) -> np.nditer:
    """Iterate over `source` (read as float64) and `targets` in flat order, BLOCK at a time, whatever their layout.

    The blocks are contiguous.

    A target may be the memory of `source`, number for number: its blocks are then those of the source. A target that
    overlaps it in any other way is written to a copy first.
    """
    # Of any type: numpy's stubs do not know "contig".
    access: list[list[Any]] = [["readonly", "contig", "overlap_assume_elementwise"]]
    access += [["writeonly", "contig", "overlap_assume_elementwise"] for _ in targets]
    return np.nditer(
        [source, *targets],
        flags=["external_loop", "buffered", "zerosize_ok", "copy_if_overlap"],
        op_flags=access,
        op_dtypes=[np.dtype(np.float64), *[target.dtype for target in targets]],
        order="C",
        casting="same_kind",
        buffersize=BLOCK,
    )


class Workspace:
    """Workspace arrays for one block.

    Attributes:
        index: points passed.
        real: sums, distances.
        kept: ratios that results are about to overwrite.
        small: small counters; of 32 bits, or seen as more of fewer bits.
        flag: comparisons.
    """

    __slots__ = ("flag", "index", "kept", "real", "small")

    def __init__(self) -> None:
        self.index = np.empty(BLOCK, np.intp)
        self.real = np.empty(BLOCK)
        self.kept = np.empty(BLOCK)
        self.small = np.empty(BLOCK, np.uint32)
        self.flag = np.empty(BLOCK, np.bool_)


# Allocating for every query would cost one of medium size as much as its evaluation.
_FREE: deque[Workspace] = deque(maxlen=4)


@contextmanager
def workspace() -> Iterator[Workspace]:
    """Workspace arrays that no other query in any thread uses at the same time."""
    try:
        work = _FREE.pop()
    except IndexError:
        work = Workspace()
    try:
        yield work
    finally:
        _FREE.append(work)


_BUCKETS_PER_POINT = 16
"""At most; and at least half as many."""


class BucketTable(NamedTuple):
    """Where to look for a ratio.

    Attributes:
        knots: (n + 1,) the points, and infinity.
        below: for each bucket how many points lie in lower buckets; n + 1 if the bucket holds two points or more.
        addend: the c of the key.
        shift: how many lower bits of the sum are ignored.
        base: the key of the first bucket.
        crowded: how many points share their bucket.
    """

    knots: FloatArray
    below: NDArray[np.unsignedinteger]
    addend: float
    shift: int
    base: int
    crowded: int


def bucket_table(ratios: FloatArray) -> BucketTable:
    """Return the table over the points of a curve but its first, in which the fewest share a bucket."""
    with np.errstate(all="ignore"):
        tables = [_table(ratios[1:], addend) for addend in _addends(ratios)]
    return min(tables, key=lambda table: table.crowded)


def _addends(ratios: FloatArray) -> list[float]:
    """For even spacing, for distances that grow from zero, and for distances that grow from the first point."""
    span = ratios[-1] - ratios[1]
    even = np.ldexp(1.0, int(np.frexp(span)[1])) - ratios[1]
    # 0.0 - x is never -0.0, so that neither is r + c, whose bits would not follow the order.
    addends = [float(even), 0.0, float(0.0 - ratios[0])]
    return [addend for addend in addends if np.isfinite(addend)]


def _table(points: FloatArray, addend: float) -> BucketTable:
    count = len(points)
    bits = (points + addend).view(np.int64)
    positive = bits[bits > 0]
    first, last = (int(positive[0]), int(positive[-1])) if positive.size else (1, 1)
    # Of the bits one at least has to go, or the difference of a negative number and the base might not fit.
    shift = max(1, ((last - first) // (_BUCKETS_PER_POINT * count)).bit_length())
    base = (first >> shift) - 1
    held = np.bincount(np.maximum((bits >> shift) - base, 0), minlength=(last >> shift) - base + 2)
    below = np.cumsum(held) - held
    crowd = held > 1
    below[crowd] = count + 1
    kind = np.uint16 if count + 1 <= np.iinfo(np.uint16).max else np.uint32
    return BucketTable(
        read_only(np.append(points, np.inf)),
        read_only(below.astype(kind)),
        addend,
        shift,
        base,
        crowded=int(held[crowd].sum()),
    )


class Knots:
    """The sorted points of a curve, and what is prepared once to evaluate it.

    Attributes:
        ratios: (n,) ascending ratios.
        forces: (n,) forces there.
        tails: (n,) slopes to the right of the points.
        inner: (n - 1,) the ratios that can be passed: all but the first, below which the first segment goes on.
        table: buckets over `inner`, once `prepare` has made them.
    """

    __slots__ = ("forces", "inner", "ratios", "table", "tails")

    table: BucketTable | None

    def __init__(self, ratios: FloatArray, forces: FloatArray, slopes: FloatArray) -> None:
        self.ratios = ratios
        self.forces = forces
        self.tails = read_only(np.concatenate((slopes, slopes[-1:])))
        self.inner = ratios[1:]
        self.table = None

    def prepare(self) -> BucketTable:
        """Return the buckets, made at the first call; needs three points or more."""
        if self.table is None:
            self.table = bucket_table(self.ratios)
        return self.table


_COUNTED_POINTS = 20
"""Up to this many points, counting is faster than a table."""

_FEW_RATIOS = 1024
"""Below this, the calls that the other ways make cost more than a binary search."""


class Search(Protocol):
    """Counts the points at or below ratios."""

    def passed(self, ratio: FloatArray) -> IndexArray:
        """Return how many points lie at or below each ratio; any valid number for NaN. Valid until the next call."""
        ...


def search_for(knots: Knots, total: int, work: Workspace) -> Search:
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

    def __init__(self, points: FloatArray, work: Workspace) -> None:
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

    def __init__(self, table: BucketTable, work: Workspace) -> None:
        self._table = table
        self._points = table.knots[:-1]
        self._work = work
        self._crowded = False

    def passed(self, ratio: FloatArray) -> IndexArray:
        """See `Search`."""
        if self._crowded:
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
            self._crowded = 2 * len(crowded) > size
        return index
