"""Rows of plain numbers to an array by pyarrow, which takes a third of the time that our own reader takes.

It is an extra, and reads less: what it refuses, or reads as other than a finite number, is left to our own reader.
"""

from __future__ import annotations

import re
import sys
from importlib import import_module
from types import ModuleType

import numpy as np

from mudline.syntax.decimals import Floats

PIECE = 1 << 21
"""Characters that are best read at once: of shorter texts the calls show, of longer ones the memory."""

_PAYS, _PAYS_WITH_IMPORT = 1 << 18, 10_000_000
"""Characters of the shortest texts that are read sooner, and of those that repay the import of 50 milliseconds."""
_LONE_RETURN = re.compile(rb"\r(?!\n|\Z)")
"""What would end a line of pyarrow's."""
_DIGITS = np.uint64(0x1010101010101010)
"""The bit that digits have in a word of eight characters; signs, points, exponents, blanks and commas lack it."""


def arrow_csv(size: int) -> ModuleType | None:
    """Pyarrow with its reader, where it is installed and a text of so many characters is read sooner with it."""
    if size < (_PAYS if sys.modules.get("pyarrow.csv") else _PAYS_WITH_IMPORT):
        return None
    try:
        import_module("pyarrow.csv")
        return import_module("pyarrow")
    except ImportError:
        return None


def read(arrow: ModuleType, lines: str, columns: int) -> Floats | None:
    """The rows of some lines that hold as many numbers each, at most `columns`, between commas; None otherwise.

    The numbers are those that `read_number` gives, to the last bit.
    """
    width = lines.count(",", 0, max(lines.find("\n"), 0)) + 1
    if not 1 < width <= columns or len(lines) > 2 * PIECE or not lines.isascii():
        return None
    data = lines.encode("ascii")
    if _may_have_long_number(data) or (b"\r" in data and _LONE_RETURN.search(data)):
        return None
    names = [str(column) for column in range(width)]
    try:
        table = arrow.csv.read_csv(
            arrow.BufferReader(data),
            arrow.csv.ReadOptions(use_threads=False, block_size=len(data) + 1, column_names=names),
            arrow.csv.ParseOptions(quote_char=False, double_quote=False),
            arrow.csv.ConvertOptions(column_types=dict.fromkeys(names, arrow.float64()), null_values=[]),
        )
    except arrow.ArrowInvalid:
        return None
    values = np.empty((table.num_rows, width))
    for column in range(width):
        start = 0
        for chunk in table.column(column).chunks:
            if chunk.null_count:
                return None
            # the numbers themselves: to_numpy would import pandas where that is installed
            found = np.frombuffer(chunk.buffers()[1], np.float64, len(chunk), 8 * chunk.offset)
            values[start : start + len(chunk), column] = found
            start += len(chunk)
    return values if np.isfinite(values).all() else None


def _may_have_long_number(data: bytes) -> bool:
    """Whether some number may be longer than `LONGEST_NUMBER`.

    At most four of its characters are not digits, so it has at least 80 digits in a row, and these hold four blocks of
    16 characters whatever place they begin at; of each block the first half is looked at.
    """
    halves = np.frombuffer(data, np.uint64, len(data) // 16 * 2)[::2]
    full = (halves & _DIGITS) == _DIGITS
    return bool((full[:-3] & full[1:-2] & full[2:-1] & full[3:]).any())
