"""Walking through arrays of any layout in blocks, with work arrays that are used again."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

BLOCK = 16384
"""Numbers at a time, so that the work arrays stay in the second-level cache."""


class Work:
    """Arrays used again from block to block: small counters, flags, indices and floats."""

    __slots__ = ("count", "flag", "index", "offset")

    def __init__(self, size: int) -> None:
        self.count = np.empty(size, np.uint8)
        self.flag = np.empty(size, np.bool_)
        self.index = np.empty(size, np.intp)
        self.offset = np.empty(size)

    def cut(self, size: int) -> Work:
        """Return arrays of `size` in the same memory."""
        if size == len(self.count):
            return self
        part = Work(0)
        part.count, part.flag = self.count[:size], self.flag[:size]
        part.index, part.offset = self.index[:size], self.offset[:size]
        return part


def blocks(source: NDArray[np.generic], *targets: NDArray[np.generic]) -> np.nditer:
    """Iterate over `source` (read as float64) and `targets` in flat order, BLOCK at a time, whatever their layout."""
    access: list[list[Literal["readonly", "writeonly"]]] = [["readonly"]]
    access += [["writeonly"] for _ in targets]
    return np.nditer(
        [source, *targets],
        flags=["external_loop", "buffered", "zerosize_ok", "copy_if_overlap"],
        op_flags=access,
        op_dtypes=[np.dtype(np.float64), *[target.dtype for target in targets]],
        order="C",
        casting="same_kind",
        buffersize=BLOCK,
    )
