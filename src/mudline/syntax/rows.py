"""Runs of rows to arrays: the slow reader defines the meaning, the fast one answers the same bits or declines."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.diagnostics import Span
from mudline.syntax.fields import Field, field_at, split

_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][-+]?[0-9]+)?")
_WORD = re.compile(r"[^ \t\r\n]+")
_SPECIAL = re.compile(r'[\["{]')
_PLAIN = b"0123456789+-.eEdD, \t\n"
_BLANKS = " \t\r"
_PIECE = 1024 * 1024
_FEW_LINES = 24
_LONG_LINE = 10_000
"""Longer lines are never taken for numbers parted by blanks: counting a stray file's words would fill the memory."""


class Rows(NamedTuple):
    """A run of rows.

    `values` (rows, columns) holds NaN where `words` has a text that is no number, "" for an empty field. `lengths`
    (rows,) counts the fields of each row; fields beyond the last column are counted but not kept.
    """

    values: NDArray[np.float64]
    lengths: NDArray[np.intp]
    words: dict[tuple[int, int], str]

    def same(self, other: Rows) -> bool:
        """Equal to the last bit, NaN and the sign of zero included."""
        return (
            self.values.shape == other.values.shape
            and self.values.tobytes() == other.values.tobytes()
            and bool(np.array_equal(self.lengths, other.lengths))
            and self.words == other.words
        )


def read_number(text: str) -> float | None:
    """The finite double that a field spells, or None. Fortran's D exponent is read as E."""
    if not _NUMBER.fullmatch(text):
        return None
    try:
        value = float(text)
    except ValueError:
        value = float(text.upper().replace("D", "E"))
    return value if math.isfinite(value) else None


def read_rows(text: str, span: Span, columns: int) -> Rows:
    """Read the lines of a run into at most `columns` columns. `text` must have LF or CRLF line ends."""
    return _joined([_read_piece(text, piece, columns) for piece in _pieces(text, span)], columns)


def _read_piece(text: str, piece: Span, columns: int) -> Rows:
    """A few lines are read sooner than the fast reader gets ready."""
    if text.count("\n", *piece) < _FEW_LINES:
        return read_rows_slow(text, piece, columns)
    values = _plain_numbers(text[slice(*piece)], columns)
    return read_rows_slow(text, piece, columns) if values is None else _full(values)


def read_rows_slow(text: str, span: Span, columns: int) -> Rows:
    """The meaning of a table, field by field."""
    special = _SPECIAL.search(text, *span) is not None
    values: list[list[float]] = []
    lengths: list[int] = []
    words: dict[tuple[int, int], str] = {}
    for index, line in enumerate(_lines(text[slice(*span)])):
        fields, length = _row_words(line, columns, special=special)
        lengths.append(length)
        row = [math.nan] * columns
        for column, word in enumerate(fields):
            value = read_number(word)
            if value is None:
                words[index, column] = word
            else:
                row[column] = value
        values.append(row)
    array = np.array(values, dtype=np.float64).reshape(len(values), columns)
    width = min(max(lengths, default=0), columns)
    return Rows(np.ascontiguousarray(array[:, :width]), np.array(lengths, dtype=np.intp), words)


def read_rows_fast(text: str, span: Span, columns: int) -> Rows | None:
    """The same rows where every field is a number and all rows have one length; None otherwise."""
    parts: list[NDArray[np.float64]] = []
    for piece in _pieces(text, span):
        values = _plain_numbers(text[slice(*piece)], columns)
        if values is None:
            return None
        parts.append(values)
    one_width = len({part.shape[1] for part in parts}) == 1
    return _full(np.concatenate(parts)) if one_width else None


def _plain_numbers(piece: str, columns: int) -> NDArray[np.float64] | None:
    """The rows of a piece as numpy reads them, where that is sure to be what the slow reader reads."""
    piece = piece.removesuffix("\n").replace("\r\n", "\n").removesuffix("\r")
    if not piece.isascii() or piece.encode().translate(None, _PLAIN) or piece.isspace() or not piece:
        return None
    lines = piece.translate(_EXPONENTS).split("\n") if "D" in piece or "d" in piece else piece.split("\n")
    if max(map(len, lines)) > _LONG_LINE:
        return None
    try:
        values = np.loadtxt(lines, delimiter="," if "," in piece else None, comments=None, ndmin=2, encoding=None)
    except ValueError:
        return None
    fits = len(values) == len(lines) and values.shape[1] <= columns and bool(np.isfinite(values).all())
    return values if fits else None


_EXPONENTS = str.maketrans("dD", "eE")


def _full(values: NDArray[np.float64]) -> Rows:
    return Rows(values, np.full(len(values), values.shape[1], dtype=np.intp), {})


def _joined(parts: Sequence[Rows], columns: int) -> Rows:
    """Parts of one run, narrower ones padded with NaN."""
    if len(parts) == 1:
        return parts[0]
    width = max((part.values.shape[1] for part in parts), default=columns)
    values = np.full((sum(len(part.values) for part in parts), width), math.nan)
    words: dict[tuple[int, int], str] = {}
    start = 0
    for part in parts:
        values[start : start + len(part.values), : part.values.shape[1]] = part.values
        words |= {(row + start, column): word for (row, column), word in part.words.items()}
        start += len(part.values)
    lengths = [part.lengths for part in parts] or [np.zeros(0, dtype=np.intp)]
    return Rows(values, np.concatenate(lengths), words)


def _pieces(text: str, span: Span) -> Iterator[Span]:
    """Parts of about a million characters that end with a line: one list for all lines would take much memory."""
    start = span.start
    while start < span.end:
        stop = text.find("\n", start + _PIECE, span.end) + 1 or span.end
        yield Span(start, stop)
        start = stop


def _lines(body: str) -> list[str]:
    return [line for line in body.split("\n") if line.strip(_BLANKS)]


def line_spans(text: str, span: Span) -> Iterator[Span]:
    """The lines of a run, without their ends; blank ones are no rows."""
    start = span.start
    while start < span.end:
        stop = text.find("\n", start, span.end)
        stop = span.end if stop < 0 else stop
        if text[start:stop].strip(_BLANKS):
            yield Span(start, stop)
        start = stop + 1


def row_fields(text: str, line: Span, columns: int) -> list[Field]:
    """The first `columns` fields of one row, with their places."""
    body = text[slice(*line)]
    if _SPECIAL.search(body):
        return split(text, line)[0][:columns]
    if "," not in body and blank_separated(body):
        words = list(_WORD.finditer(body))[:columns]
        return [Field(word[0], Span(line.start + word.start(), line.start + word.end())) for word in words]
    fields: list[Field] = []
    start = line.start
    for piece in body.split(",", columns)[:columns]:
        fields.append(field_at(text, start, start + len(piece)))
        start += len(piece) + 1
    return fields


def _row_words(line: str, columns: int, *, special: bool) -> tuple[list[str], int]:
    """The first `columns` fields of a row, and how many it has: parted by commas, or by blanks where all is numbers.

    Empty fields behind the last column, as trailing commas leave them, do not count.
    """
    if special and _SPECIAL.search(line):
        fields = [field.text for field in split(line, Span(0, len(line)))[0]]
        while len(fields) > columns and not fields[-1]:
            fields.pop()
        return fields[:columns], len(fields)
    if "," not in line and blank_separated(line):
        words = _WORD.findall(line)
        return words[:columns], len(words)
    pieces = line.split(",", columns)
    beyond = pieces.pop() if len(pieces) > columns else ""
    length = line.rstrip(", \t\r").count(",") + 1 if beyond.strip(", \t\r") else len(pieces)
    return [piece.strip(_BLANKS) for piece in pieces], length


def blank_separated(line: str) -> bool:
    """Whether a line without commas is several numbers parted by blanks."""
    if len(line) > _LONG_LINE:
        return False
    words = _WORD.findall(line)
    return len(words) > 1 and all(_NUMBER.fullmatch(word) for word in words)
