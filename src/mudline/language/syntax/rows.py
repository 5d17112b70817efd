"""Reading of runs of rows to arrays: rows of numbers as JSON, many at a time; all others field by field."""

from __future__ import annotations

import math
import re
from array import array
from collections.abc import Iterator, Sequence
from itertools import starmap
from operator import methodcaller
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic_core import from_json

from mudline.basics.limits import LONGEST_BLANK_SEPARATED, LONGEST_NUMBER
from mudline.language.diagnostics import Span
from mudline.language.syntax.fields import Field, split

NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][-+]?[0-9]+)?")
"""Number as decks write it."""
_WORD = re.compile(r"[^ \t\r\n]+")
_ROW = re.compile(r"^[ \t\r]*[^ \t\r\n][^\n]*", re.MULTILINE)
GROUPED = re.compile(r'[\["{]')
"""Opening marks of an equation, a string or a label, in which a comma does not separate fields."""
_ONLY_EQUATIONS = re.compile(r'(?:[^"{\[]++|(?<==)\[[^\[\]"{,]*+\])*')
"""Row whose only brackets are those of equations without commas, brackets, strings or labels inside."""
PIECE = 256 * 1024
"""Number of characters that are read at a time: their arrays stay in the fast memory of a processor."""
_FEW = 1024
"""Number of characters of lines that are read field by field, if not all are numbers."""
_IN_NUMBERS = b"0123456789+-.eE \t\r"
_D_TO_E = bytes.maketrans(b"dD", b"EE")
_SIGNED_ZERO = re.compile(rb"-0(?![.eE])(?<![eE]-0)")
"""Zero whose sign JSON does not keep."""
_DIGITS = bytes.maketrans(b"123456789", b"000000000")
_LONG = b"0" * 40
"""Digits of a number that is read by `float`."""


class RawRows(NamedTuple):
    """Values of a run of rows.

    Attributes:
        values: (rows, columns); NaN where `words` has a text that is not a number.
        words: texts of such fields, "" for an empty field.
        lengths: (rows,) number of fields of each row; fields beyond the last column count, but are not kept.
    """

    values: NDArray[np.float64]
    lengths: NDArray[np.intp]
    words: dict[tuple[int, int], Any]


def read_number(text: str) -> float | None:
    """Return the finite double in a field, or None. Fortran's D exponent is read as E."""
    if len(text) > LONGEST_NUMBER or not NUMBER.fullmatch(text):
        return None
    value = float(text.upper().replace("D", "E"))
    return value if math.isfinite(value) else None


def spells_number(text: str) -> bool:
    """Return True if a text has the form of a number of any size."""
    return NUMBER.fullmatch(text) is not None


def read_rows(text: str, span: Span, columns: int) -> RawRows:
    """Return the lines of a run as at most `columns` columns; `text` must have LF or CRLF line ends."""
    return stacked([_piece(text[slice(*piece)], columns) for piece in _pieces(text, span)])


def _piece(lines: str, columns: int) -> RawRows:
    """Return the rows of lines, as many at a time as are all numbers; few lines with others are read field by field."""
    values = read_numbers(lines, columns) if len(lines) <= 2 * PIECE else None  # longer pieces are a single line
    if values is not None:
        return RawRows(values, np.full(len(values), values.shape[1], dtype=np.intp), {})
    middle = lines.find("\n", len(lines) // 2) if len(lines) > _FEW else -1
    if middle < 0:
        return read_rows_slow(lines, Span(0, len(lines)), columns)
    return stacked([_piece(lines[:middle], columns), _piece(lines[middle + 1 :], columns)])


def read_numbers(lines: str, columns: int) -> NDArray[np.float64] | None:
    """Return rows of equally many finite numbers, at most `columns`; None for any other lines.

    The text between the numbers of a line, commas and line end, must be the same in each line.
    """
    data = lines.encode("ascii", "replace").translate(_D_TO_E)
    marks = data.translate(None, _IN_NUMBERS)
    if not marks.strip(b"\n"):
        rows = data.split(b"\n")
        if max(map(len, rows)) > LONGEST_BLANK_SEPARATED:
            return None
        data = b"\n".join([b",".join(row.split()) for row in rows])
        marks = data.translate(None, _IN_NUMBERS)
    count = marks.count(b"\n") + 1
    width = (len(marks) + 1) // count
    if width > columns or marks + b"\n" != (b"," * (width - 1) + b"\n") * count:
        return None
    flat = data.replace(b"\n", b",")
    try:
        values = np.array(_doubles(flat))
    except (ValueError, OverflowError):
        return None
    return values.reshape(count, width) if len(values) and np.isfinite(values).all() else None


def _doubles(numbers: bytes) -> Sequence[float]:
    """Return the numbers between commas, read as JSON, or by `float` if they are not in the form of JSON."""
    if not _SIGNED_ZERO.search(numbers) and _LONG not in numbers.translate(_DIGITS):
        try:
            return array("d", from_json(b"[%b]" % numbers))
        except ValueError:
            pass
    words = numbers.split(b",")
    if max(map(len, words)) > LONGEST_NUMBER:
        raise ValueError("a number is too long")
    return [float(word) for word in words]


def read_rows_slow(text: str, span: Span, columns: int) -> RawRows:
    """Return the rows of a run, read field by field; slower than `read_rows`, with the same result."""
    values: list[list[float]] = []
    lengths: list[int] = []
    words: dict[tuple[int, int], str] = {}
    for index, line in enumerate(line_spans(text, span)):
        found, length = row_words(text[line.start : line.end], columns)
        lengths.append(length)
        row = [math.nan] * columns
        for column, word in enumerate(found):
            value = read_number(word)
            if value is None:
                words[index, column] = word
            else:
                row[column] = value
        values.append(row)
    array = np.array(values, dtype=np.float64).reshape(len(values), columns)
    width = min(max(lengths, default=0), columns)
    return RawRows(np.ascontiguousarray(array[:, :width]), np.array(lengths, dtype=np.intp), words)


def stacked(parts: Sequence[RawRows]) -> RawRows:
    """Return the rows of consecutive parts as one run."""
    if len(parts) == 1:
        return parts[0]
    width = max((part.values.shape[1] for part in parts), default=0)
    values = np.full((sum(len(part.values) for part in parts), width), math.nan)
    words: dict[tuple[int, int], Any] = {}
    start = 0
    for part in parts:
        end = start + len(part.values)
        values[start:end, : part.values.shape[1]] = part.values
        words |= {(row + start, column): word for (row, column), word in part.words.items()}
        start = end
    return RawRows(values, np.concatenate([np.zeros(0, np.intp), *(part.lengths for part in parts)]), words)


def _pieces(text: str, span: Span) -> Iterator[Span]:
    """Yield spans of whole lines of about `PIECE` characters each, without the line end of the last line."""
    start, end = span
    while end > start and text[end - 1] in "\r\n":
        end -= 1
    while start < end:
        stop = text.find("\n", min(start + PIECE, end), end)
        stop = end if stop < 0 else stop
        yield Span(start, stop)
        start = stop + 1


def line_spans(text: str, span: Span) -> Iterator[Span]:
    """Return the spans of the lines of a run, which begins a line, without line ends; blank lines are not rows."""
    return starmap(Span, map(methodcaller("span"), _ROW.finditer(text, *span)))


def row_starts(text: str, run: Span) -> array[int]:
    """Return the offsets of the lines of a run that are rows."""
    return array("q", map(methodcaller("start"), _ROW.finditer(text, *run)))


def row_fields(text: str, line: Span, columns: int) -> list[Field]:
    """Return the first `columns` fields of one row, with their places."""
    body = text[line.start : line.end]
    fields: list[Field] = []
    at = 0
    for word in row_words(body, columns)[0]:
        at = body.index(word, at)
        fields.append(Field(word, line.start + at))
        comma = body.find(",", at + len(word))
        at = comma + 1 if comma >= 0 else at + len(word)
    return fields


def row_words(body: str, columns: int) -> tuple[list[str], int]:
    """Return the first `columns` fields of a row, and its number of fields; spaces separate if all fields are numbers.

    Empty fields behind the last column, which trailing commas leave, do not count.
    """
    if GROUPED.search(body) and not (body.count(",") < columns and _ONLY_EQUATIONS.fullmatch(body)):
        texts = [field.text for field in split(body, Span(0, len(body)))[0]]
        while len(texts) > columns and not texts[-1]:
            texts.pop()
        return texts[:columns], len(texts)
    if "," not in body and blank_separated(body):
        words = _WORD.findall(body)
        return words[:columns], len(words)
    pieces = body.split(",", columns)
    beyond = pieces.pop().strip(", \t\r") if len(pieces) > columns else ""
    length = body.count(",") + 1 if beyond else len(pieces)
    return [piece.strip(" \t\r") for piece in pieces], length


def blank_separated(body: str) -> bool:
    """Return True if a line without commas holds several numbers separated by spaces."""
    if len(body.rstrip("\r")) > LONGEST_BLANK_SEPARATED:
        return False
    words = _WORD.findall(body)
    return len(words) > 1 and all(NUMBER.fullmatch(word) for word in words)
