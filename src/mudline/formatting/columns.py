"""Columns of rows: how wide they are, and rows of words laid out in them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import NamedTuple

from mudline.formatting.places import RowKind

LONGEST = 32
"""Longer fields, such as equations, do not widen their column: what follows them on their row stands further right."""

_INTEGER = re.compile(r"[-+0-9]*")
_NUMERIC = frozenset("+-.0123456789")


class Shape(NamedTuple):
    """The blanks of a column: its width, where its decimal points stand, and how much room is behind them.

    Without numbers all of it is 0 but the width: words stand on the left. Among numbers they stand on the right.
    """

    width: int
    point: int
    right: int

    def padded(self, text: str) -> str:
        """A field with its comma, one blank before it, and its column's blanks on both sides."""
        before = self.point - self._inner(text)
        if before <= 0:
            return f" {text},{' ' * (self.width - len(text))}"
        return f" {' ' * before}{text},{' ' * (self.width - before - len(text))}"

    def _inner(self, text: str) -> int:
        """How much of a field stands before the decimal point of its column."""
        if not text or text[0] in _NUMERIC:
            return _integer(text)
        return len(text) - self.right


def _integer(number: str) -> int:
    """Length of a number before its decimal point or its exponent."""
    at = number.find(".")
    if at < 0:
        match = _INTEGER.match(number)
        at = match.end() if match else 0
    return at


@dataclass(slots=True)
class Column:
    """Room for a column: before the decimal point, from there on, and for words; of `text` all are words."""

    text: bool = False
    left: int = 0
    right: int = 0
    words: int = 0

    def take(self, texts: Iterable[str]) -> None:
        """Make room for fields."""
        short = [text for text in texts if len(text) <= LONGEST]
        numbers = [] if self.text else [text for text in short if text[:1] in _NUMERIC]
        if len(numbers) < len(short):
            words = short if self.text else (text for text in short if text[:1] not in _NUMERIC)
            self.words = max(self.words, *map(len, words))
        if numbers:
            lefts = list(map(_integer, numbers))
            rights = (len(text) - left for text, left in zip(numbers, lefts, strict=True))
            self.take_numbers(max(lefts), max(rights))

    def take_numbers(self, left: int, right: int) -> None:
        """Make room for numbers of at most these lengths before their decimal point, and from there on."""
        self.left = max(self.left, left)
        self.right = max(self.right, right)

    def shape(self) -> Shape:
        """What came out."""
        width = max(self.left + self.right, self.words)
        return Shape(width, width - self.right if self.left or self.right else 0, self.right)


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

    def shapes(self) -> list[Shape]:
        """The shape of each column."""
        return [column.shape() for column in self.columns]


@dataclass(slots=True)
class WordRows:
    """Rows as lists of fields."""

    rows: list[list[str]]

    def measure(self, columns: Columns) -> None:
        """Make room for the rows."""
        texts = list(zip_longest(*self.rows, fillvalue=""))
        for column, fields in zip(columns.upto(len(texts)), texts, strict=False):
            column.take(fields)

    def lines(self, shapes: Sequence[Shape]) -> str:
        """The lines of the rows, each with a LF."""
        return "".join(f"{line(row, shapes)}\n" for row in self.rows)


def cut(fields: list[str]) -> list[str]:
    """The fields of a row without the empty ones behind the last that holds something."""
    length = len(fields)
    while length > 1 and not fields[length - 1]:
        length -= 1
    return fields[:length]


def line(row: Sequence[str], shapes: Iterable[Shape]) -> str:
    """A row, indented by one blank; a row of one empty field is a comma, as an empty line would be no row."""
    *first, last = map(Shape.padded, shapes, row)
    return ("".join(first) + last[: last.rindex(",")]).rstrip(" ") or " ,"
