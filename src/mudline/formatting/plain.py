"""Long tables of plain numbers, laid out as arrays of characters; whatever else they hold is declined."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mudline.formatting.columns import LONGEST, Columns, Shape

_PLAIN = b"0123456789+-.eEdD, \t\r\n"
_GAP = re.compile(rb"(?<=[^ \t\r\n])[ \t]+(?=[^ \t\r\n])")
_BLANK, _LF, _COMMA, _POINT, _LETTERS = 32, 10, 44, 46, 65

_Array = NDArray[np.intp]


@dataclass(slots=True)
class PlainRows:
    """Rows of numbers: the characters of all fields laid end to end, and where each field ends in them.

    `sizes` and `lefts` (fields,) are the characters of a field, and those before its decimal point or exponent;
    `column` (fields,) counts from 0 in each row, `last` (fields,) says that a field ends its row.
    """

    characters: NDArray[np.uint8]
    sizes: _Array
    lefts: _Array
    column: _Array
    last: NDArray[np.bool_]

    @classmethod
    def read(cls, text: str, most: int) -> Self | None:
        """The rows of some whole lines, cut to `most` fields; None for all that is not simply numbers."""
        data = text.encode("utf-8")
        if data.translate(None, _PLAIN):
            return None
        if b"," not in data:
            data = _GAP.sub(b",", data)
        codes = np.frombuffer(data if data.endswith(b"\n") else data + b"\n", dtype=np.uint8)
        inked = (codes > _BLANK) & (codes != _COMMA)
        marks = np.flatnonzero((codes == _COMMA) | (codes == _LF))
        ends = np.cumsum(inked)[marks]
        sizes = np.diff(ends, prepend=0)
        starts = ends - sizes
        places = np.flatnonzero(inked)
        full = sizes > 0
        gaps = places[ends[full] - 1] - places[starts[full]] + 1 != sizes[full]
        characters = codes[places]
        if gaps.any() or (characters[starts[full]] >= _LETTERS).any():
            return None
        last = codes[marks] == _LF
        opens = np.flatnonzero(np.concatenate(([True], last[:-1])))
        column = np.arange(len(marks)) - np.repeat(opens, np.diff(opens, append=len(marks)))
        if not np.add.reduceat(sizes, opens).all():
            return None
        points = np.flatnonzero((characters == _POINT) | (characters >= _LETTERS))
        point = np.append(points, len(characters))[np.searchsorted(points, starts)]
        rows = cls(characters, sizes, np.minimum(point, ends) - starts, column, last)
        return rows._cut(opens, most)

    def _cut(self, opens: _Array, most: int) -> Self | None:
        """The rows, each of which begins at one of the fields `opens`, without the empty fields at their ends."""
        filled = np.maximum.reduceat(np.where(self.sizes > 0, self.column, -1), opens)
        if filled.max() >= most:
            return None
        end = np.repeat(filled, np.diff(opens, append=len(self.column)))
        kept = self.column <= end
        last = (self.column == end)[kept]
        return type(self)(self.characters, self.sizes[kept], self.lefts[kept], self.column[kept], last)

    def measure(self, columns: Columns) -> None:
        """Make room for the rows."""
        short = self.sizes <= LONGEST
        for number, column in enumerate(columns.upto(int(self.column.max()) + 1)):
            here = short & (self.column == number)
            lefts = self.lefts[here]
            column.take_numbers(int(lefts.max(initial=0)), int((self.sizes[here] - lefts).max(initial=0)))

    def lines(self, shapes: Sequence[Shape]) -> str:
        """The lines of the rows, each with a LF."""
        width = np.array([shape.width for shape in shapes])[self.column]
        point = np.array([shape.point for shape in shapes])[self.column]
        before = np.maximum(point - self.lefts, 0)
        after = np.maximum(width - before - self.sizes, 0) + 1
        after[self.last] = 0
        before[self.column == 0] += 1
        room = before + self.sizes + 1 + after
        begins = np.cumsum(room) - room + before
        out = np.full(int(room.sum()), _BLANK, dtype=np.uint8)
        starts = np.cumsum(self.sizes) - self.sizes
        out[np.arange(len(self.characters)) + np.repeat(begins - starts, self.sizes)] = self.characters
        out[begins + self.sizes] = np.where(self.last, _LF, _COMMA)
        return out.tobytes().decode("ascii")
