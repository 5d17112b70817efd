"""Columns of a table: how wide they are, and rows of words laid out in them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from mudline.formatting.places import RowKind

LONGEST = 32
"""Longer fields, such as equations, do not widen their column: what follows them on their row stands further right."""

_INTEGER = re.compile(r"[-+0-9]*")
_NUMERIC = frozenset("+-.0123456789")


@dataclass(slots=True)
class Column:
    """Widths of what stands before and from the decimal point on, and of words.

    A column of `text`, or one without a number, is aligned on the left.
    """

    text: bool = False
    left: int = 0
    right: int = 0
    words: int = 0

    def take(self, text: str) -> None:
        """Make room for a field."""
        length = len(text)
        if length > LONGEST:
            return
        if self.text or text[:1] not in _NUMERIC:
            self.words = max(self.words, length)
        else:
            self.take_number(point := _point(text), length - point)

    def take_number(self, left: int, right: int) -> None:
        """Make room for a number."""
        self.left = max(self.left, left)
        self.right = max(self.right, right)

    @property
    def width(self) -> int:
        """Characters of a field with its blanks."""
        return max(self.left + self.right, self.words)

    @property
    def point(self) -> int:
        """Where the decimal points stand, and the commas of empty fields."""
        return self.width - self.right if self.left or self.right else 0

    def before(self, text: str) -> int:
        """Blanks before a field."""
        if not text:
            return self.point
        if not self.left and not self.right:
            return 0
        inner = _point(text) if text[0] in _NUMERIC else len(text) - self.right
        return max(self.point - inner, 0)


def _point(number: str) -> int:
    """Length of a number before its decimal point or its exponent."""
    match = _INTEGER.match(number)
    return match.end() if match else 0


@dataclass(slots=True)
class Columns:
    """The columns of rows of one kind."""

    kind: RowKind
    columns: list[Column] = field(default_factory=list)

    def upto(self, count: int) -> Sequence[Column]:
        """At least `count` columns."""
        for number in range(len(self.columns), count):
            self.columns.append(Column(self.kind.is_text(number)))
        return self.columns


@dataclass(slots=True)
class WordRows:
    """Rows as lists of fields."""

    rows: list[list[str]]

    def measure(self, columns: Columns) -> None:
        """Make room for the rows."""
        for row in self.rows:
            for column, text in zip(columns.upto(len(row)), row, strict=False):
                column.take(text)

    def lines(self, columns: Columns) -> str:
        """The lines of the rows, each with a LF."""
        return "".join(f"{line(row, columns.columns)}\n" for row in self.rows)


def line(row: Sequence[str], columns: Iterable[Column]) -> str:
    """A row, indented by one blank; a row of one empty field is a comma, as an empty line would be no row."""
    pieces: list[str] = []
    for text, column in zip(row, columns, strict=False):
        before = column.before(text)
        after = max(column.width - before - len(text), 0)
        pieces += (" ", " " * before, text, ",", " " * after)
    return "".join(pieces[:-2]).rstrip(" ") or " ,"
