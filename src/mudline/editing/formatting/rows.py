"""Rows of one kind that belong together: all are measured, then all are laid out."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from mudline.language.diagnostics import Span
from mudline.language.keywords.model import FieldSpec
from mudline.language.keywords.values import Kind
from mudline.language.syntax.rows import PIECE, line_spans, row_words

WIDEST = 32
"""Width above which a field, such as an equation, does not widen its column; later fields of its row shift right."""

_NUMERIC = frozenset("+-.0123456789")


class RowKind(NamedTuple):
    """Kind of rows, by the field of a model that they fill.

    Attributes:
        slot: the field of the model.
        columns: the fields on a row.
        many: True if the row has any number of values of the one field.
        table: True if rows are read as arrays.
    """

    slot: FieldSpec
    columns: tuple[FieldSpec, ...]
    many: bool = False
    table: bool = False

    def is_text(self, column: int) -> bool:
        """Return True if a column holds names or text; other columns hold numbers, with a few equations and labels."""
        slot = self.columns[0] if self.many else self.columns[min(column, len(self.columns) - 1)]
        return bool(slot.choices) or slot.kind in (Kind.NAME, Kind.REAL_OR_NAME)


class ColumnShape(NamedTuple):
    """Alignment of a column.

    Words are aligned left, but right among numbers.

    Attributes:
        width: width of the column.
        point: position of the decimal points; 0 without numbers.
        right: width from the decimal point on; 0 without numbers.
    """

    width: int
    point: int
    right: int

    def padded(self, text: str) -> str:
        """Return a field with its comma, one blank before it, and the padding of its column on both sides."""
        numeric = not text or text[0] in _NUMERIC
        before = self.point - (_integer(text) if numeric else len(text) - self.right)
        if before <= 0:
            return f" {text},{' ' * (self.width - len(text))}"
        return f" {' ' * before}{text},{' ' * (self.width - before - len(text))}"


def _integer(number: str) -> int:
    """Return the length of a number before its decimal point or its exponent."""
    return len(number) - len(number.lstrip("-+0123456789"))


@dataclass(slots=True)
class ColumnWidths:
    """Widths of a column: before the decimal point, from there on, and of words; with `text` all fields are words."""

    text: bool = False
    left: int = 0
    right: int = 0
    words: int = 0

    def take(self, texts: Iterable[str]) -> None:
        """Widen the column for fields."""
        short = [text for text in texts if len(text) <= WIDEST]
        numbers = [] if self.text else [text for text in short if text[:1] in _NUMERIC]
        if len(numbers) < len(short):
            words = short if self.text else (text for text in short if text[:1] not in _NUMERIC)
            self.words = max(self.words, *map(len, words))
        if numbers:
            lefts = list(map(_integer, numbers))
            rights = (len(text) - left for text, left in zip(numbers, lefts, strict=True))
            self.take_numbers(max(lefts), max(rights))

    def take_numbers(self, left: int, right: int) -> None:
        """Widen the column for numbers of at most these lengths before their decimal point, and from there on."""
        self.left = max(self.left, left)
        self.right = max(self.right, right)

    def shape(self) -> ColumnShape:
        """Return the alignment of all fields so far."""
        width = max(self.left + self.right, self.words)
        return ColumnShape(width, width - self.right if self.left or self.right else 0, self.right)


@dataclass(slots=True)
class Columns:
    """Columns of rows of one kind."""

    kind: RowKind
    columns: list[ColumnWidths] = field(default_factory=list)

    def upto(self, count: int) -> Sequence[ColumnWidths]:
        """Return at least `count` columns."""
        for number in range(len(self.columns), count):
            self.columns.append(ColumnWidths(self.kind.is_text(number)))
        return self.columns


class WordRows(NamedTuple):
    """Rows as lists of fields."""

    rows: list[list[str]]

    def measure(self, columns: Columns) -> None:
        """Widen the columns for the rows."""
        texts = list(zip_longest(*self.rows, fillvalue=""))
        for column, fields in zip(columns.upto(len(texts)), texts, strict=False):
            column.take(fields)

    def lines(self, shapes: Sequence[ColumnShape]) -> str:
        """Return the lines of the rows, each with a LF."""
        return "".join(f"{line(row, shapes)}\n" for row in self.rows)


def cut(fields: list[str]) -> list[str]:
    """Return the fields of a row without trailing empty fields; at least one remains."""
    length = len(fields)
    while length > 1 and not fields[length - 1]:
        length -= 1
    return fields[:length]


def line(row: Sequence[str], shapes: Iterable[ColumnShape]) -> str:
    """Return a row, indented by one blank; a row of one empty field is a comma, as an empty line would not be a row."""
    *first, last = map(ColumnShape.padded, shapes, row)
    return ("".join(first) + last[: last.rindex(",")]).rstrip(" ") or " ,"


_GAP = re.compile(rb"(?<=[^ \t\r\n])[ \t]+(?=[^ \t\r\n])")
_TAB, _LF, _CR, _BLANK, _PLUS, _COMMA, _POINT, _SLASH, _DIGIT, _LETTERS = 9, 10, 13, 32, 43, 44, 46, 47, 57, 65
_WITHOUT_CASE, _D_OR_E = 0xDE, 0x44
"""Bits of a letter without its case, and those of D; E differs from D only in the lowest bit, which is masked too."""

_Array = NDArray[np.integer]


@dataclass(slots=True)
class NumberRows:
    """Rows of numbers.

    Attributes:
        characters: characters of all fields laid end to end, each with the comma or LF after it.
        sizes: characters of each field (fields,).
        lefts: characters of each field before its decimal point or exponent (fields,).
        column: column of each field (fields,), from 0 in each row.
    """

    characters: NDArray[np.uint8]
    sizes: _Array
    lefts: _Array
    column: _Array

    @classmethod
    def read(cls, text: str, most: int) -> Self | None:
        """Return the rows of whole lines; None for anything but plain numbers, at most `most` in a row."""
        data = text.encode("utf-8")
        if b"\r" in data:
            data = data.replace(b"\r\n", b"\n")
        if b"," not in data:
            data = _GAP.sub(b",", data)
        characters = _without_blanks(np.frombuffer(data if data.endswith(b"\n") else data + b"\n", dtype=np.uint8))
        if characters is None:
            return None
        marks = (characters == _COMMA) | (characters == _LF)
        letters = (characters & _WITHOUT_CASE) == _D_OR_E
        numerals = (characters >= _PLUS) & (characters <= _DIGIT) & (characters != _SLASH)
        if not (marks | letters | numerals).all():
            return None
        stops = np.flatnonzero(marks | letters | (characters == _POINT))
        closing = np.flatnonzero(marks[stops])  # the stops that end fields: after each, the next field begins
        ends = stops[closing]
        starts = np.concatenate(([0], ends[:-1] + 1))
        sizes = ends - starts
        if (characters[starts] >= _LETTERS).any():
            return None
        lefts = stops[np.concatenate(([0], closing[:-1] + 1))] - starts
        last = characters[ends] == _LF
        opens = np.flatnonzero(np.concatenate(([True], last[:-1])))
        column = np.arange(len(ends)) - np.repeat(opens, np.diff(opens, append=len(ends)))
        rows = cls(characters, sizes, lefts, column)
        if not sizes.all():
            return rows._cut(ends, opens, most)
        return None if column.max() >= most else rows

    def _cut(self, ends: _Array, opens: _Array, most: int) -> Self | None:
        """Return the rows without trailing empty fields; each row begins at one of the fields `opens`.

        `ends` are the places of the commas and LFs among the characters.
        """
        filled = np.maximum.reduceat(np.where(self.sizes > 0, self.column, -1), opens)
        if filled.min() < 0 or filled.max() >= most:
            return None
        last = np.repeat(filled, np.diff(opens, append=len(self.column)))
        kept = self.column <= last
        characters = self.characters.copy()
        characters[ends[self.column == last]] = _LF
        fields = (values[kept] for values in (self.sizes, self.lefts, self.column))
        return type(self)(np.delete(characters, ends[~kept]), *fields)

    def measure(self, columns: Columns) -> None:
        """Widen the columns for the rows."""
        short = self.sizes <= WIDEST
        for number, column in enumerate(columns.upto(int(self.column.max()) + 1)):
            here = short & (self.column == number)
            lefts = self.lefts[here]
            column.take_numbers(int(lefts.max(initial=0)), int((self.sizes[here] - lefts).max(initial=0)))

    def lines(self, shapes: Sequence[ColumnShape]) -> str:
        """Return the lines of the rows, each with a LF."""
        width = np.array([shape.width for shape in shapes])[self.column]
        point = np.array([shape.point for shape in shapes])[self.column]
        before = np.maximum(point - self.lefts, 0)
        after = np.maximum(width - before - self.sizes, 0)
        blanks = before + 1
        blanks[1:] += np.where(self.column[1:] > 0, after[:-1], 0)
        counts = np.column_stack([blanks, self.sizes.astype(np.intp) + 1]).ravel()
        inked = np.repeat(np.tile([False, True], len(blanks)), counts)
        out = np.full(len(inked), _BLANK, dtype=np.uint8)
        out[inked] = self.characters
        return out.tobytes().decode("ascii")


def _without_blanks(codes: NDArray[np.uint8]) -> NDArray[np.uint8] | None:
    """Return the characters that are not blank; None if a field contains blanks."""
    blank = (codes == _BLANK) | (codes == _TAB) | (codes == _CR)
    inked = ~blank & (codes != _COMMA) & (codes != _LF)
    places = np.flatnonzero(~blank)
    within = inked[places]
    if (within[:-1] & within[1:] & (np.diff(places) > 1)).any():
        return None
    kept: NDArray[np.uint8] = codes[~blank]
    return kept


_SHORT = 1000
"""Characters of a table from which on arrays are faster than lists."""


def word_rows(text: str, most: int) -> WordRows:
    """Return the rows of whole lines, cut to `most` fields, with any content."""
    lines = line_spans(text, Span(0, len(text)))
    return WordRows([cut(row_words(text[slice(*line)], most)[0]) for line in lines])


@dataclass(slots=True)
class AlignedRows:
    """Rows of one kind, separated only by comments and blank lines.

    Attributes:
        text: text of the file.
        kind: their kind.
        members: lines, and the fields of a row; none for the lines of a table, which may be very many.
    """

    text: str
    kind: RowKind
    members: list[tuple[Span, list[str]]] = field(default_factory=list)

    def laid_out(self) -> Iterator[tuple[Span, str]]:
        """Yield the lines of each member in aligned columns, each with a LF."""
        columns = Columns(self.kind)
        for member in self.members:
            for part in self._parts(*member):
                part.measure(columns)
        shapes = [column.shape() for column in columns.columns]
        for member in self.members:
            yield member[0], "".join(part.lines(shapes) for part in self._parts(*member))

    def _parts(self, span: Span, fields: list[str]) -> Iterator[WordRows | NumberRows]:
        """Yield a row, or the rows of a table in pieces of some thousand, which are read twice."""
        if fields:
            yield WordRows([fields])
            return
        start, end = span
        most = len(self.kind.columns)
        while start < end:
            stop = self.text.find("\n", min(start + PIECE, end), end) + 1 or end
            rows = NumberRows.read(self.text[start:stop], most) if stop - start > _SHORT else None
            yield rows or word_rows(self.text[start:stop], most)
            start = stop
