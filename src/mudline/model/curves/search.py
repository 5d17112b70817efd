"""How many points of a curve lie at or below each ratio, and ratios of any layout a block at a time."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mudline.model.curves.points import FloatArray, IndexArray

BLOCK = 32768
"""Numbers at a time, so that work arrays stay in the second-level cache."""
_COUNTED_POINTS = 60
"""Up to this many points, comparing with each is faster than a binary search."""
_RATIOS_PER_POINT = 50
"""Below this, the calls for each point cost more than a binary search."""


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


def passed(points: FloatArray, ratio: FloatArray) -> IndexArray:
    """Return how many of the ascending points (n,) lie at or below each ratio (k,); any number up to n for NaN."""
    if len(points) > _COUNTED_POINTS or len(ratio) < _RATIOS_PER_POINT * len(points):
        return np.searchsorted(points, ratio, side="right")
    count: NDArray[np.uint8] = (ratio >= points[0]).view(np.uint8)
    more = np.empty(len(ratio), np.bool_)
    for point in points[1:]:
        np.greater_equal(ratio, point, out=more)
        np.add(count, more.view(np.uint8), out=count)
    return count.astype(np.intp)
