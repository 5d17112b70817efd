"""Walking through arrays of any layout in blocks, so that work arrays have a fixed size."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

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
