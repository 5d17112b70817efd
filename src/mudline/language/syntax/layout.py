"""Replacement of a field with its columns kept: blanks beside the field compensate for the difference in length."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from mudline.language.diagnostics import Span
from mudline.language.syntax.edits import TextEdit
from mudline.language.syntax.fields import Field, first_key, split
from mudline.language.syntax.source import Source


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
    neighbours = [(line.fields[index].span, line.start) for line in _neighbours(source, span, index)]
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


def _neighbours(source: Source, span: Span, index: int) -> Iterator[_Row]:
    """Yield the rows directly above and below that have a field of this index."""
    line = source.position(span.start)[0]
    for number in (line - 1, line + 1):
        row = _row(source, number) if 1 <= number <= len(source.line_starts) else None
        if row is not None and index < len(row.fields):
            yield row


def _row(source: Source, number: int) -> _Row | None:
    """Return a line as a row of fields; None for a setting, a comment, a keyword."""
    start = source.line_starts[number - 1]
    line = source.line(number)
    span = Span(start, start + len(line))
    if not line.strip() or line[0] in "Cc*$" or line.lstrip()[0] in "*$" or first_key(source.unified, span):
        return None
    fields, problems = split(source.unified, span)
    return None if problems else _Row(start, fields)
