"""Work arrays of a fixed size, lent to one query after the other."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from mudline.curves.blocks import BLOCK


class Work:
    """Room for one block.

    Attributes:
        index: points passed.
        real: sums, distances.
        kept: ratios that results are about to replace.
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


# New memory for every query would cost a middling one as much as its evaluation.
_FREE: deque[Work] = deque(maxlen=4)


@contextmanager
def lent() -> Iterator[Work]:
    """Lend work arrays that nobody else uses meanwhile, in whatever thread."""
    try:
        work = _FREE.pop()
    except IndexError:
        work = Work()
    try:
        yield work
    finally:
        _FREE.append(work)
