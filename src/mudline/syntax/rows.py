"""Runs of rows to arrays: the slow reader defines their meaning, the fast one says the same bit for bit or declines."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic_core import from_json

from mudline.diagnostics import Span
from mudline.syntax.fields import Field, split

_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][-+]?[0-9]+)?")
_WORD = re.compile(r"[^ \t\r\n]+")
_SPECIAL = re.compile(r'[\["{]')
_PLAIN = b"0123456789+-.eEdD, \t\r\n"
_LOST_SIGN = re.compile(rb"-0(?![.0-9eE])")
_BLANKS_BETWEEN = re.compile(rb"(?<=[0-9.])[ \t]+(?=[-+.0-9])")
_NO_FRACTION = re.compile(rb"(?<=[0-9])\.(?![0-9])")
_NO_WHOLE = re.compile(rb"(?<![0-9])\.(?=[0-9])")
_PLUS = re.compile(rb"(?<![eE0-9.+-])\+(?=[0-9.])")
_ODD_LINE = re.compile(r"^.*[^0-9eEdD+\-., \t\r\n].*$", re.MULTILINE)
_BLANK_LINE = re.compile(r"^[ \t\r]*$", re.MULTILINE)
_WORTH_PARTING = 10_000
_MOST_ODD = 0.5
_D_TO_E = bytes.maketrans(b"dD", b"EE")
_PIECE = 128 * 1024
_LONGEST_BLANK_SEPARATED = 10_000
_DIGITS = 400
"""Longer numbers are refused by `read_number`: nobody writes them, and reading one takes time square in its length."""
_TOO_LONG = re.compile(rb"[^, \t\r\n]{%d}" % (_DIGITS + 1))


class Rows(NamedTuple):
    """A run of rows.

    `values` (rows, columns) holds NaN where `words` has a text that is not a number ("" for an empty field).

    `lengths` (rows,) counts the fields of each row, also those beyond the last column, which are not kept.
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
    if len(text) > _DIGITS or not _NUMBER.fullmatch(text):
        return None
    try:
        value = float(text)
    except ValueError:
        value = float(text.upper().replace("D", "E"))
    return value if math.isfinite(value) else None


def spells_number(text: str) -> bool:
    """Whether a text has the form of a number, whatever its size."""
    return _NUMBER.fullmatch(text) is not None


def read_rows(text: str, span: Span, columns: int) -> Rows:
    """Read the lines of a run into at most `columns` columns. `text` must have LF or CRLF line ends."""
    return (
        read_rows_fast(text, span, columns)
        or read_rows_apart(text, span, columns)
        or read_rows_slow(text, span, columns)
    )


def read_rows_slow(text: str, span: Span, columns: int) -> Rows:
    """The meaning of a table, field by field."""
    values: list[list[float]] = []
    lengths: list[int] = []
    words: dict[tuple[int, int], str] = {}
    for index, line in enumerate(line_spans(text, span)):
        row_words, length = _row_words(text[line.start : line.end], columns)
        lengths.append(length)
        row = [math.nan] * columns
        for column, word in enumerate(row_words):
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
    body = text[span.start : span.end]
    if not body.isascii():
        return None
    data = body.encode("ascii")
    if data.translate(None, _PLAIN) or _LOST_SIGN.search(data):
        return None
    pieces = [_plain_rows(piece) for piece in _pieces(data)]
    tables = [piece for piece in pieces if piece is not None]
    widths = {table.shape[1] for table in tables}
    if len(tables) < len(pieces) or len(widths) != 1 or not 0 < (width := widths.pop()) <= columns:
        return None
    values = np.concatenate(tables)
    return Rows(values, np.full(len(values), width, dtype=np.intp), {})


def read_rows_apart(text: str, span: Span, columns: int) -> Rows | None:
    """The same rows where only some lines hold more than numbers: those slow, the others fast; None otherwise."""
    body = text[span.start : span.end].rstrip("\r\n")
    odd = [match.span() for match in _ODD_LINE.finditer(body)]
    if not odd or len(body) < _WORTH_PARTING or _BLANK_LINE.search(body):
        return None
    count = body.count("\n") + 1
    if len(odd) > _MOST_ODD * count:
        return None
    ends = [0, *(end + 1 for _, end in odd)]
    between = [body[end:start] for end, (start, _) in zip(ends, odd, strict=False)] + [body[ends[-1] :]]
    plain = "".join(piece if piece.endswith("\n") or not piece else f"{piece}\n" for piece in between)
    numbers = read_rows_fast(plain, Span(0, len(plain)), columns)
    if numbers is None:
        return None
    lines = "\n".join(body[start:end] for start, end in odd)
    others = read_rows_slow(lines, Span(0, len(lines)), columns)
    before = np.cumsum([piece.count("\n") for piece in between[:-1]])
    return _merged(numbers, others, before + np.arange(len(odd)), count)


def _merged(numbers: Rows, others: Rows, at: NDArray[np.intp], count: int) -> Rows:
    """Rows of which `others` stand at the indices `at`, `numbers` in order at all the rest."""
    rest = np.ones(count, dtype=bool)
    rest[at] = False
    width = max(numbers.values.shape[1], others.values.shape[1])
    values = np.full((count, width), math.nan)
    values[rest, : numbers.values.shape[1]] = numbers.values
    values[at, : others.values.shape[1]] = others.values
    lengths = np.empty(count, dtype=np.intp)
    lengths[rest], lengths[at] = numbers.lengths, others.lengths
    places = at.tolist()
    return Rows(values, lengths, {(places[row], column): word for (row, column), word in others.words.items()})


def _plain_rows(piece: bytes) -> NDArray[np.float64] | None:
    """The rows of a piece; None where they are none, or not of one length, or not finite."""
    if len(piece) > 2 * _PIECE:
        return None
    if max(map(len, piece.split(b"\n"))) > _DIGITS and _TOO_LONG.search(piece):  # the search alone takes a second
        return None
    table = _json_rows(piece)
    return _json_rows(_as_json(piece)) if table is None else table


def _json_rows(piece: bytes) -> NDArray[np.float64] | None:
    """The rows of a piece whose fields are plain JSON numbers, read as one list of lists."""
    try:
        table = np.array(from_json(b"[[" + piece.replace(b"\n", b"],[") + b"]]"), dtype=np.float64)
    except (ValueError, OverflowError):
        return None
    return table if table.ndim == 2 and np.isfinite(table).all() else None


def _as_json(piece: bytes) -> bytes:
    """Numbers as legacy tools spell them, `1.`, `.5`, `+1`, `1.D3`, separated only by spaces, in the spelling of JSON.

    What was not a number before is not one afterwards.
    """
    piece = _NO_WHOLE.sub(b"0.", _NO_FRACTION.sub(b".0", _PLUS.sub(b"", piece.translate(_D_TO_E))))
    if b"," in piece or any(len(line) > _LONGEST_BLANK_SEPARATED for line in piece.split(b"\n")):
        return piece
    return _BLANKS_BETWEEN.sub(b",", piece)


def _pieces(data: bytes) -> Iterator[bytes]:
    """Parts of about 128 kB that end with a line: one list for all of a long run would take ten times its size."""
    start, end = 0, len(data.rstrip(b"\r\n"))
    while start < end:
        stop = data.find(b"\n", min(start + _PIECE, end), end)
        stop = end if stop < 0 else stop
        yield data[start:stop]
        start = stop + 1


def line_spans(text: str, span: Span) -> Iterator[Span]:
    """The lines of a run without their ends; blank ones are no rows."""
    start = span.start
    while start < span.end:
        stop = text.find("\n", start, span.end)
        stop = span.end if stop < 0 else stop
        if text[start:stop].strip(" \t\r"):
            yield Span(start, stop)
        start = stop + 1


def row_fields(text: str, line: Span, columns: int) -> list[Field]:
    """The first `columns` fields of one row, with their places."""
    body = text[line.start : line.end]
    fields: list[Field] = []
    at = 0
    for word in _row_words(body, columns)[0]:
        at = body.index(word, at)
        fields.append(Field(word, Span(line.start + at, line.start + at + len(word))))
        comma = body.find(",", at + len(word))
        at = comma + 1 if comma >= 0 else at + len(word)
    return fields


def _row_words(body: str, columns: int) -> tuple[list[str], int]:
    """The first `columns` fields of a row, and how many it has: separated by commas, or by spaces where all is numbers.

    Empty fields behind the last column, as trailing commas leave them, do not count.
    """
    if _SPECIAL.search(body):
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
    """Whether a line without commas is several numbers separated by spaces."""
    if len(body) > _LONGEST_BLANK_SEPARATED:
        return False
    words = _WORD.findall(body)
    return len(words) > 1 and all(_NUMBER.fullmatch(word) for word in words)
