"""Where values stand: a map from the path of a value to its span, made when somebody asks."""

from __future__ import annotations

from array import array
from bisect import bisect_right
from dataclasses import dataclass, field
from operator import itemgetter

from mudline.basics.limits import MOST_COLUMNS
from mudline.basics.short_repr import short_repr
from mudline.language.diagnostics import Span
from mudline.language.keywords.model import Path
from mudline.language.keywords.parsed import ParsedRecord
from mudline.language.syntax.fields import trimmed
from mudline.language.syntax.rows import row_fields, row_starts


@dataclass(slots=True)
class Places:
    """Spans by path. Tables keep only where their runs begin: a row is looked up when somebody asks.

    `kept` is where the lines begin that are passed through unchanged.
    """

    text: str
    block: Span
    spans: dict[Path, Span] = field(default_factory=dict)
    runs: dict[Path, list[tuple[int, Span]]] = field(default_factory=dict)
    kept: frozenset[int] = frozenset()
    _lines: dict[Span, array[int]] = field(default_factory=dict)

    __repr__ = short_repr

    def add(self, record: ParsedRecord, path: Path = ()) -> None:
        """Add the values of a record, and of the records in it."""
        if record.opening:
            self.spans[path] = trimmed(self.text, *record.opening)
        for name, span, names, fields in record.written:
            inner = path if name is None else (*path, name)
            if span:
                self.spans[inner] = span
            for column, given in zip(names, fields, strict=False):
                self.spans[*inner, column] = given.span
        for name, table in record.tables.items():
            if table.runs:
                self.runs[*path, name] = table.runs
        for name, children in record.children.items():
            for index, child in enumerate(children):
                self.add(child, (*path, name, index))

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

    def at(self, offset: int) -> tuple[Path, Span] | None:
        """The innermost value that stands at an offset, or that ends there, and its span."""
        around = [(path, span) for path, span in self.spans.items() if path and span.start <= offset <= span.end]
        for path, runs in self.runs.items():
            for first, run in runs:
                if run.start <= offset <= run.end and (cell := self._cell_at(run, offset)):
                    row, column, span = cell
                    around.append(((*path, first + row, column), span))
        return min(around, key=lambda found: found[1].end - found[1].start, default=None)

    def _cell_at(self, run: Span, offset: int) -> tuple[int, int, Span] | None:
        """Row and column of a run at an offset, and the span of the field."""
        starts = self._starts(run)
        row = bisect_right(starts, offset) - 1
        if row < 0:
            return None
        stop = self.text.find("\n", starts[row], run.end)
        fields = row_fields(self.text, Span(starts[row], run.end if stop < 0 else stop), MOST_COLUMNS)
        at = (column for column, given in enumerate(fields) if given.span.start <= offset <= given.span.end)
        column = next(at, None)
        return None if column is None else (row, column, fields[column].span)

    def moved(self, text: str, by: int) -> Places:
        """The same in a text in which all of it stands further behind."""
        spans = {path: span.moved(by) for path, span in self.spans.items()}
        runs = {path: [(row, span.moved(by)) for row, span in found] for path, found in self.runs.items()}
        return Places(text, self.block.moved(by), spans, runs, frozenset(at + by for at in self.kept))

    def _cell(self, runs: list[tuple[int, Span]], inner: Path) -> Span:
        row = int(inner[0]) if inner else 0
        first, run = runs[max(bisect_right(runs, row, key=itemgetter(0)) - 1, 0)]
        starts = self._starts(run)
        if not 0 <= row - first < len(starts):
            return run
        start = starts[row - first]
        stop = self.text.find("\n", start, run.end)
        line = Span(start, run.end if stop < 0 else stop)
        fields = row_fields(self.text, line, MOST_COLUMNS)
        if len(inner) > 1 and 0 <= int(inner[1]) < len(fields):
            return fields[int(inner[1])].span
        return Span(fields[0].span.start, fields[-1].span.end) if fields else line

    def _starts(self, run: Span) -> array[int]:
        """Where the rows of a run begin, found once."""
        if run not in self._lines:
            self._lines[run] = row_starts(self.text, run)
        return self._lines[run]
