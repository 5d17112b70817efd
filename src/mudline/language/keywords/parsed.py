"""Records as built from a block: plain values, and their places, which are computed on demand."""

from __future__ import annotations

from array import array
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import chain
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np

from mudline.basics.limits import MOST_COLUMNS
from mudline.basics.short_repr import short_repr
from mudline.language.diagnostics import Span
from mudline.language.keywords.model import FieldSpec, ListRow, Part, Path, Record, record_schema
from mudline.language.keywords.table import Column, Table, from_rows
from mudline.language.keywords.text import Value
from mudline.language.keywords.unknown import UNKNOWN, UNKNOWN_NAME, Partly, is_unknown
from mudline.language.keywords.values import Equation, Label
from mudline.language.syntax.fields import Field, trimmed
from mudline.language.syntax.rows import read_rows, row_fields, row_starts


class TableBuilder:
    """Collector of the runs of one table."""

    def __init__(self, columns: list[Column]) -> None:
        self.columns = columns
        self.runs: list[tuple[int, Span]] = []
        self.parts: list[Table] = []
        self.count = 0

    def add(self, text: str, span: Span) -> tuple[Table, list[int]]:
        """Add one run of a text; return its rows, and the numbers of those with faults."""
        self.runs.append((self.count, span))
        table, faults = from_rows(read_rows(text, span, len(self.columns)), self.columns)
        self.parts.append(table)
        self.count += len(table)
        return table, sorted({row for row, _ in faults})

    def finish(self) -> Table:
        """Return all rows in one table."""
        if len(self.parts) == 1:
            return self.parts[0]
        width = max((part.values.shape[1] for part in self.parts), default=0)
        values = np.full((self.count, width), np.nan)
        words: dict[tuple[int, int], Equation | Label | None] = {}
        start = 0
        for part in self.parts:
            values[start : start + len(part), : part.values.shape[1]] = part.values
            words |= {(row + start, column): word for (row, column), word in part.words.items()}
            start += len(part)
        lengths = [part.lengths for part in self.parts] or [np.zeros(0, dtype=np.intp)]
        return Table(values, np.concatenate(lengths), words)


class Item(NamedTuple):
    """Line or inner record of a record: order of writing, position in the text, number of items that it counts for."""

    order: int
    position: int
    size: int


class Written(NamedTuple):
    """Places of values on a line: span of the field `slot`, if it has one, and its fields by name.

    If `slot` is None, the names are those of the record's fields.
    """

    slot: str | None
    span: Span | None
    names: Sequence[str | int]
    fields: Sequence[Field]


@dataclass(slots=True)
class ParsedRecord:
    """Record as plain values, with the data needed to find their places and to insert comments.

    A record is `unsure` if some of its lines or settings could not be used: values that seem to be missing may be
    there. It is `unchosen` if the value that chooses its kind of rows is unknown. `opening` is its first own line.
    """

    part: type[Record]
    values: dict[str, Any] = field(default_factory=dict)
    children: dict[str, list[ParsedRecord]] = field(default_factory=dict)
    written: list[Written] = field(default_factory=list)
    tables: dict[str, TableBuilder] = field(default_factory=dict)
    items: list[Item] = field(default_factory=list)
    opening: Span | None = None
    sticky: object = None
    first: int = 0
    last: int | None = None
    unsure: bool = False
    unchosen: bool = False

    @property
    def known(self) -> dict[str, Any]:
        """Values that could be read."""
        return {name: value for name, value in self.values.items() if value is not UNKNOWN}

    def reach(self, position: int) -> None:
        """Extend the record to the line at a position."""
        if self.last is None:
            self.first = self.last = position
        elif position > self.last:
            self.last = position


def lose(built: ParsedRecord, positions: Sequence[int]) -> None:
    """Mark a record, and the inner records at the positions, as having lines that could not be used."""
    built.unsure = True
    inner = sorted(chain.from_iterable(built.children.values()), key=lambda child: child.first)
    firsts = [child.first for child in inner]
    of_child: dict[int, list[int]] = {}
    for position in positions:
        of_child.setdefault(bisect_right(firsts, position) - 1, []).append(position)
    for child in inner[bisect_right(firsts, min(positions)) :]:  # a line above the child may be the one with its name
        for slot in record_schema(child.part).slots[:1]:
            if slot.key:
                child.values.setdefault(slot.json, UNKNOWN)
    for index, inside in of_child.items():
        if index >= 0:
            lose(inner[index], inside)


def construct(built: ParsedRecord) -> Part:
    """Return a model without validation, for a block with unreadable values.

    A missing value is None. It is unknown if it is mandatory, or if a line that could not be used may contain it.
    """
    ready: dict[str, Any] = {}
    for slot in record_schema(built.part).slots:
        value = _known(slot, built.values.get(slot.json))
        if slot.record:
            inner = [construct(child) for child in built.children.get(slot.json, [])]
            ready[slot.name] = Partly(inner) if built.unsure else inner
        elif slot.json not in built.values:
            unknown = slot.required or (built.unsure and slot not in record_schema(built.part).tables)
            ready[slot.name] = _known(slot, UNKNOWN) if unknown else None
        elif slot.row and isinstance(value, list):
            columns = record_schema(slot.row).columns
            ready[slot.name] = _bare(slot.row, {c.json: v for c, v in zip(columns, value, strict=False)})
        elif slot.row and isinstance(value, dict):
            ready[slot.name] = _bare(slot.row, value)
        else:
            ready[slot.name] = value
    ready["comments"] = []
    if "keyword" in built.values:
        ready["keyword"] = built.values["keyword"]
    return built.part.model_construct(_given(ready), **ready)


def _bare(row: type[Part], values: dict[str, Value]) -> Part:
    """Return a row without validation."""
    ready = {slot.name: _known(slot, values.get(slot.json)) for slot in record_schema(row).columns}
    return row.model_construct(None if issubclass(row, ListRow) else _given(ready), **ready)


def _given(fields: dict[str, Any]) -> set[str]:
    """Return the names of the known fields: unknown ones are not written."""
    return {name for name, value in fields.items() if not is_unknown(value)}


def _known(slot: FieldSpec, value: object) -> Any:
    """Return the value of a field; for an unreadable value the one that stands for it."""
    return UNKNOWN_NAME if value is UNKNOWN and slot.is_text else value


@dataclass(slots=True)
class Places:
    """Spans by path. Tables store only the starts of their runs; a row is looked up on demand.

    `kept` has the offsets of lines that are passed through unchanged.
    """

    text: str
    block: Span
    spans: dict[Path, Span] = field(default_factory=dict)
    runs: dict[Path, list[tuple[int, Span]]] = field(default_factory=dict)
    kept: frozenset[int] = frozenset()
    _lines: dict[Span, array[int]] = field(default_factory=dict)

    __repr__ = short_repr

    def add(self, record: ParsedRecord, path: Path = ()) -> None:
        """Add the values of a record and of its inner records."""
        if record.opening:
            self.spans[path] = trimmed(self.text, *record.opening)
        for name, span, names, fields in record.written:
            inner = path if name is None else (*path, name)
            if span:
                self.spans[inner] = span
            for column, value in zip(names, fields, strict=False):
                self.spans[*inner, column] = value.span
        for name, table in record.tables.items():
            if table.runs:
                self.runs[*path, name] = table.runs
        for name, children in record.children.items():
            for index, child in enumerate(children):
                self.add(child, (*path, name, index))

    def find(self, path: Path) -> Span:
        """Return the span of a value; for a value that was left out, the span of the nearest enclosing object."""
        for length in range(len(path), 0, -1):
            inner = path[:length]
            if inner in self.spans:
                return self.spans[inner]
            if inner in self.runs:
                return self._cell(self.runs[inner], path[length:])
        return self.block

    def has(self, path: Path) -> bool:
        """Return True if exactly this value was written in the deck."""
        return path in self.spans or path in self.runs

    def at(self, offset: int) -> tuple[Path, Span] | None:
        """Return the innermost value that contains an offset or ends there, and its span."""
        around = [(path, span) for path, span in self.spans.items() if path and span.start <= offset <= span.end]
        for path, runs in self.runs.items():
            for first, run in runs:
                if run.start <= offset <= run.end and (cell := self._cell_at(run, offset)):
                    row, column, span = cell
                    around.append(((*path, first + row, column), span))
        return min(around, key=lambda place: place[1].end - place[1].start, default=None)

    def _cell_at(self, run: Span, offset: int) -> tuple[int, int, Span] | None:
        """Return row and column of a run at an offset, and the span of the field."""
        starts = self._starts(run)
        row = bisect_right(starts, offset) - 1
        if row < 0:
            return None
        stop = self.text.find("\n", starts[row], run.end)
        fields = row_fields(self.text, Span(starts[row], run.end if stop < 0 else stop), MOST_COLUMNS)
        at = (column for column, field in enumerate(fields) if field.span.start <= offset <= field.span.end)
        column = next(at, None)
        return None if column is None else (row, column, fields[column].span)

    def moved(self, text: str, by: int) -> Places:
        """Return the places in a longer text that contains this text at the offset `by`."""
        spans = {path: span.moved(by) for path, span in self.spans.items()}
        runs = {path: [(row, span.moved(by)) for row, span in starts] for path, starts in self.runs.items()}
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
        """Return the offsets of the rows of a run, cached."""
        if run not in self._lines:
            self._lines[run] = row_starts(self.text, run)
        return self._lines[run]
