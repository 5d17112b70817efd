"""Where values stand: a map from the path of a value to its span, kept beside the values; only diagnostics read it."""

from __future__ import annotations

from dataclasses import dataclass, field

from mudline.diagnostics import Span
from mudline.syntax.rows import line_spans, row_fields

Path = tuple[str | int, ...]
"""Keys and indices as JSON has them, from the block inwards; a table is followed by row and column."""

_MOST_COLUMNS = 64


@dataclass(slots=True)
class Places:
    """Spans by path. Tables keep only where their runs begin: a row is looked up when somebody asks."""

    text: str
    block: Span
    spans: dict[Path, Span] = field(default_factory=dict)
    runs: dict[Path, list[tuple[int, Span]]] = field(default_factory=dict)
    damaged: set[Path] = field(default_factory=set)

    def find(self, path: Path) -> Span:
        """The span of a value; where it has none (it was left out), that of the nearest thing around it."""
        for length in range(len(path), 0, -1):
            inner = path[:length]
            if inner in self.spans:
                return self.spans[inner]
            if inner in self.runs:
                return self._cell(self.runs[inner], path[length:])
        return self.block

    def has(self, path: Path) -> bool:
        """Whether exactly this value was written in the deck."""
        return path in self.spans or path in self.runs

    def _cell(self, runs: list[tuple[int, Span]], inner: Path) -> Span:
        row = int(inner[0]) if inner else 0
        first, run = max((start for start in runs if start[0] <= row), default=runs[0], key=lambda start: start[0])
        for index, line in enumerate(line_spans(self.text, run)):
            if index == row - first:
                fields = row_fields(self.text, line, _MOST_COLUMNS)
                if len(inner) > 1 and int(inner[1]) < len(fields) and int(inner[1]) >= 0:
                    return fields[int(inner[1])].span
                return Span(fields[0].span.start, fields[-1].span.end)
        return run
