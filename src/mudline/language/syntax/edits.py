"""Edits of a text: replacements of spans, applied at the same time; unchanged text keeps its bytes and columns."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterable
from itertools import accumulate, islice
from typing import NamedTuple

from mudline.language.diagnostics import Span
from mudline.language.syntax.fields import Field, first_key, split, trimmed
from mudline.language.syntax.source import Source

_LONE_LF = re.compile(r"(?<!\r)\n")


class TextEdit(NamedTuple):
    """Replacement of `span` by `text`; offsets are those of the text before any edit, an empty span inserts."""

    span: Span
    text: str


class OverlapError(ValueError):
    """Overlap of two edits."""


def apply_edits(text: str, edits: Iterable[TextEdit]) -> str:
    """Return the text with all edits applied; the replacement texts are literal.

    Edits may come in any order. Insertions at one place keep their order, and come before a replacement that begins
    there. Raises OverlapError, or ValueError for a span outside the text.
    """
    pieces: list[str] = []
    at = 0
    before: TextEdit | None = None
    for edit in sorted(edits, key=lambda edit: edit.span):
        start, end = edit.span
        if not 0 <= start <= end <= len(text):
            raise ValueError(f"an edit of {tuple(edit.span)} does not lie in a text of {len(text)} characters")
        if before is not None and start < at:
            raise OverlapError(f"edits overlap: {tuple(before.span)} and {tuple(edit.span)}")
        pieces += (text[at:start], edit.text)
        at, before = end, edit
    pieces.append(text[at:])
    return "".join(pieces)


class Undoing:
    """Map from places in an edited text to places in the original text; fast for many places."""

    def __init__(self, edits: Iterable[TextEdit]) -> None:
        self._edits = sorted(edits, key=lambda edit: edit.span)
        grown = [len(edit.text) - (edit.span.end - edit.span.start) for edit in self._edits]
        self._grown = [0, *accumulate(grown)]
        self._ends = [edit.span.end + by for edit, by in zip(self._edits, self._grown[1:], strict=True)]

    def before(self, span: Span) -> Span:
        """Return the span of the original text that corresponds to a span of the edited text."""
        # edits that end before the span only shift it
        first = (bisect_right if span.end > span.start else bisect_left)(self._ends, span.start)
        start, end = span.moved(-self._grown[first])
        for edit in islice(self._edits, first, None):
            if edit.span.start >= end:
                break
            grown = len(edit.text) - (edit.span.end - edit.span.start)
            if edit.span.start < start + (not edit.text):  # text at the place of a deletion is behind it
                start = max(start - grown, edit.span.start)
            end = max(end - grown, edit.span.start)
        return Span(start, max(start, end))

    def touches(self, place: Span) -> bool:
        """Return True if a place of the edited text overlaps inserted text."""
        index, new = self._at(place)
        return index < len(self._edits) and new.start < max(place.end, place.start + 1)

    def is_in_new_lines(self, place: Span) -> bool:
        """Return True if a place of the edited text is within whole lines that an edit inserted."""
        index, new = self._at(place)
        if index == len(self._edits) or self._edits[index].span.end > self._edits[index].span.start:
            return False
        return self._edits[index].text.endswith(("\n", "\r")) and new.start <= place.start < place.end < new.end

    def _at(self, place: Span) -> tuple[int, Span]:
        """Return the index of the first edit whose text ends behind the start of a place, and the span of that text."""
        index = bisect_right(self._ends, place.start)
        if index == len(self._edits):
            return index, Span(0, 0)
        return index, Span(self._ends[index] - len(self._edits[index].text), self._ends[index])


def with_line_ends(source: Source, edits: Iterable[TextEdit]) -> list[TextEdit]:
    """Return the edits with each LF in their texts replaced by the line end of the nearest line before (CRLF stays)."""
    ends = ((edit, line_end_before(source, edit.span.start)) for edit in edits)
    return [edit._replace(text=_LONE_LF.sub(end, edit.text)) for edit, end in ends]


def line_end_before(source: Source, offset: int) -> str:
    """Return the end of the last line that ends before an offset; without such a line that of the first; default LF."""
    starts = source.line_starts
    line = max(bisect_right(starts, offset) - 1, 1)
    if line == len(starts):
        return "\n"
    end = starts[line]
    return "\r\n" if source.text[end - 2 : end] == "\r\n" else source.text[end - 1]


def edited_bytes(source: Source, edits: Iterable[TextEdit]) -> bytes:
    """Return the bytes of a source with edits applied, in its own line ends and encoding; unchanged bytes stay.

    Raises as `apply_edits`, and UnicodeEncodeError if an edit has a character that the encoding lacks.
    """
    return source.to_bytes(apply_edits(source.text, with_line_ends(source, edits)))


# ------------------------------------------------------------------------------------------------ columns that are kept


class _Row(NamedTuple):
    """Fields of a line, and the offset of the line."""

    start: int
    fields: list[Field]


def replacement_in_layout(source: Source, span: Span, text: str) -> list[TextEdit]:
    """Return the edits that replace `span` by `text`.

    If the field of the same number in the row above or below ends or begins in the same column, the blanks before or
    behind the field compensate for the difference in length. At least one blank stays.
    """
    replaced = [TextEdit(span, text)]
    growth = len(text) - (span.end - span.start)
    row = _row(source, source.position(span.start)[0])
    index = next((i for i, field in enumerate(row.fields) if field.span == span), None) if row else None
    if row is None or index is None or not growth:
        return replaced
    blanks = _to_resize(source, row, index)
    if blanks is None:
        return replaced
    return [*replaced, TextEdit(blanks, " " * max(blanks.end - blanks.start - growth, 1))]


def _to_resize(source: Source, row: _Row, index: int) -> Span | None:
    """Return the blanks before a field that ends in the column of its neighbours, or behind one that begins there.

    Columns that are in line only because all fields are of equal length are not aligned.
    """
    span = row.fields[index].span
    line = source.position(span.start)[0]
    near_rows = [_row(source, number) for number in (line - 1, line + 1) if 1 <= number <= len(source.line_starts)]
    neighbours = [(near.fields[index].span, near.start) for near in near_rows if near and index < len(near.fields)]
    if any(span.end - row.start == near.end - start for near, start in neighbours):
        return _wide_blanks_before(source, row, span)
    if index + 1 < len(row.fields) and any(span.start - row.start == near.start - start for near, start in neighbours):
        return _wide_blanks_before(source, row, row.fields[index + 1].span)
    return None


def _wide_blanks_before(source: Source, row: _Row, span: Span) -> Span | None:
    """Return the blanks directly before a field; None if there are fewer than two, or a tab stands before it."""
    before = source.text[row.start : span.start]
    length = len(before) - len(before.rstrip(" "))
    return Span(span.start - length, span.start) if length > 1 and "\t" not in before else None


def _row(source: Source, number: int) -> _Row | None:
    """Return a line as a row of fields; None for a setting, a comment, a keyword."""
    span = source.line_span(number)
    line = source.text[slice(*span)]
    if not line.strip() or line[0] in "Cc*$" or line.lstrip()[0] in "*$" or first_key(source.unified, span):
        return None
    fields, problems = split(source.unified, trimmed(source.unified, *span))
    return None if problems else _Row(span.start, fields)
