"""Rows of one kind that belong together: all are measured, then all are laid out."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from mudline.diagnostics import Span
from mudline.formatting.columns import Columns, WordRows, cut
from mudline.formatting.places import RowKind
from mudline.formatting.plain import PlainRows
from mudline.syntax.rows import line_spans, row_fields

_PIECE = 256 * 1024
_SHORT = 1000
"""Characters of a table from which on arrays are faster than lists."""
_HELD_TOGETHER = re.compile(r'[\["{]')


class Run(NamedTuple):
    """Lines of a table, which may be very many."""

    text: str
    span: Span

    def parts(self, kind: RowKind) -> Iterator[WordRows | PlainRows]:
        """The rows in pieces of some thousand."""
        start, end = self.span
        while start < end:
            stop = self.text.find("\n", min(start + _PIECE, end), end) + 1 or end
            piece = self.text[start:stop]
            plain = PlainRows.read(piece, len(kind.columns)) if len(piece) > _SHORT else None
            yield plain or word_rows(piece, len(kind.columns))
            start = stop


def word_rows(text: str, most: int) -> WordRows:
    """The rows of some whole lines, cut to `most` fields, whatever stands in them."""
    rows: list[list[str]] = []
    for line in line_spans(text, Span(0, len(text))):
        body = text[slice(*line)]
        if "," not in body or _HELD_TOGETHER.search(body):
            rows.append(cut([given.text for given in row_fields(text, line, most)]))
        else:
            rows.append(cut([piece.strip(" \t\r") for piece in body.split(",")[:most]]))
    return WordRows(rows)


class Single(NamedTuple):
    """A row cut into its fields, and its line."""

    fields: list[str]
    span: Span

    def parts(self, _kind: RowKind) -> Iterator[WordRows | PlainRows]:
        """The row."""
        yield WordRows([self.fields])


@dataclass(slots=True)
class Rows:
    """Rows of one kind with nothing but comments and blank lines between them."""

    kind: RowKind
    members: list[Run | Single] = field(default_factory=list)

    def laid_out(self) -> Iterator[tuple[Span, str]]:
        """The lines of each member in aligned columns, each with a LF."""
        columns = Columns(self.kind)
        for member in self.members:
            for part in member.parts(self.kind):
                part.measure(columns)
        shapes = columns.shapes()
        for member in self.members:
            yield member.span, "".join(part.lines(shapes) for part in member.parts(self.kind))
