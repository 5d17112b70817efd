"""Rows of one kind that belong together: all are measured, then all are laid out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from mudline.diagnostics import Span
from mudline.formatting.columns import Columns, WordRows
from mudline.formatting.places import RowKind
from mudline.formatting.plain import PlainRows
from mudline.syntax.rows import line_spans, row_fields

_PIECE = 256 * 1024


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
            yield PlainRows.read(piece, len(kind.columns)) or word_rows(piece, len(kind.columns))
            start = stop


def word_rows(text: str, most: int) -> WordRows:
    """The rows of some whole lines, cut to `most` fields, whatever stands in them."""
    spans = line_spans(text, Span(0, len(text)))
    return WordRows([[given.text for given in row_fields(text, span, most)] for span in spans])


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
        for member in self.members:
            yield member.span, "".join(part.lines(columns) for part in member.parts(self.kind))
