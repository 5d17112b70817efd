"""Where values stand: a map from the path of a value to its span, kept beside the values; only diagnostics read it."""

from __future__ import annotations

from dataclasses import dataclass, field

from mudline.diagnostics import Span
from mudline.syntax.fields import trimmed
from mudline.syntax.rows import line_spans, row_fields

Path = tuple[str | int, ...]
"""Keys and indices as JSON has them, from the block inwards; a table is followed by row and column."""

_MOST_COLUMNS = 64


@dataclass(slots=True)
class Runs:
    """Where the rows of a table stand: the first row of each run and its span; lines are counted when asked for."""

    text: str
    first_rows: list[int] = field(default_factory=list)
    spans: list[Span] = field(default_factory=list)
    count: int = 0
    _lines: list[Span] = field(default_factory=list)

    def add(self, span: Span) -> int:
        """Take note of a run; returns its number of rows."""
        rows = self.text.count("\n", *span) + (self.text[span.end - 1] != "\n")
        self.first_rows.append(self.count)
        self.spans.append(span)
        self.count += rows
        return rows

    def line(self, row: int) -> Span:
        """The line of a row, without outer blanks."""
        if len(self._lines) < self.count:
            self._lines = [line for span in self.spans for line in line_spans(self.text, span)]
        return trimmed(self.text, *self._lines[min(row, self.count - 1)])

    def cell(self, row: int, column: int) -> Span:
        """A field of a row; the whole row where it has no such field."""
        line = self.line(row)
        fields = row_fields(self.text, line, _MOST_COLUMNS)
        return fields[column].span if 0 <= column < len(fields) else line


@dataclass(slots=True)
class Places:
    """Spans by path, of values and of the runs of tables; and which records are not complete."""

    text: str
    block: Span
    spans: dict[Path, Span] = field(default_factory=dict)
    runs: dict[Path, Runs] = field(default_factory=dict)
    damaged: set[Path] = field(default_factory=set)

    def find(self, path: Path) -> Span:
        """The span of a value; where it has none (it was left out), that of the nearest thing around it."""
        for length in range(len(path), 0, -1):
            inner = path[:length]
            if inner in self.spans:
                return self.spans[inner]
            if inner in self.runs:
                row, column = (*path[length:], 0, -1)[:2] if length < len(path) else (0, -1)
                return self.runs[inner].cell(int(row), int(column))
        return self.block

    def has(self, path: Path) -> bool:
        """Whether exactly this value was written in the deck."""
        return path in self.spans or path in self.runs
