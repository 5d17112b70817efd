"""Finding the points below a ratio with a table of buckets instead of a binary search.

The key of a ratio r is the upper bits of the float64 r + c: of a positive sum they grow with r. Within one power of two
they grow evenly, so a large c gives buckets of equal width, and c = 0 gives the same number of buckets to every power
of two. Rounding keeps the order, so a point with a lower key lies below r and one with a higher key above; only points
in the bucket of r have to be compared with r. What is below the first bucket, negative sums among it, counts to the
first, what is above the last to the last.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.curves.arrays import FloatArray, read_only

_BUCKETS_PER_POINT = 16
"""At most; and at least half as many."""


class BucketTable(NamedTuple):
    """Where to look for a ratio.

    Attributes:
        knots: (n + 1,) the points, and infinity.
        below: for each bucket how many points lie in lower buckets; n + 1 if the bucket holds two points or more.
        addend: the c above.
        shift: how many lower bits of the sum do not count.
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
