"""Records as built from a block: plain values, their places, and the lines between them."""

from __future__ import annotations

from array import array
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from operator import attrgetter, itemgetter
from typing import Any, NamedTuple

from mudline.basics.limits import MOST_COLUMNS
from mudline.basics.short_repr import short_repr
from mudline.language.codes.fields import SYN002, SYN003, SYN015
from mudline.language.codes.lines import SYN001, SYN004, SYN005
from mudline.language.diagnostics import Problem, Severity, Span
from mudline.language.keywords.contents import KeptLine
from mudline.language.keywords.model import FieldSpec, ListRow, Part, Path, Record, record_schema
from mudline.language.keywords.table import Column, Table, from_rows
from mudline.language.keywords.text import Value, reads_as_name
from mudline.language.keywords.values import UNKNOWN, UNKNOWN_NAME, Partly, is_unknown
from mudline.language.syntax.fields import Field, trimmed
from mudline.language.syntax.grammars import ROW, Content
from mudline.language.syntax.rows import RawRows, read_rows, row_fields, row_starts, stacked


class TableBuilder:
    """Collector of the runs of one table."""

    def __init__(self, columns: list[Column]) -> None:
        self.columns = columns
        self.parts: list[RawRows] = []
        self.count = 0

    def add(self, text: str, span: Span) -> tuple[Table, list[int]]:
        """Add one run of a text; return its rows, and the numbers of those with faults."""
        table, faults = from_rows(read_rows(text, span, len(self.columns)), self.columns)
        self.parts.append(RawRows(table.values, table.lengths, table.words))
        self.count += len(table)
        return table, sorted({row for row, _ in faults})

    def finish(self) -> Table:
        """Return all rows in one table."""
        return Table(*stacked(self.parts), self.columns)


class Item(NamedTuple):
    """Line or inner record of a record: order of writing, position in the text, number of items that it counts for."""

    order: int
    position: int
    size: int


@dataclass(slots=True)
class ParsedRecord:
    """Record as plain values, with the data needed to insert comments.

    A record is `unsure` if some of its lines or settings could not be used: values that seem to be missing may be
    there. It is `unchosen` if the value that chooses its kind of rows is unknown.

    `items` and `inner`, the `children` of all fields, are in the order of the text.
    """

    part: type[Record]
    path: Path = ()
    values: dict[str, Any] = field(default_factory=dict)
    children: dict[str, list[ParsedRecord]] = field(default_factory=dict)
    inner: list[ParsedRecord] = field(default_factory=list)
    tables: dict[str, TableBuilder] = field(default_factory=dict)
    items: list[Item] = field(default_factory=list)
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
    inner, first = built.inner, attrgetter("first")
    of_child: dict[int, list[int]] = {}
    for position in positions:
        of_child.setdefault(bisect_right(inner, position, key=first) - 1, []).append(position)
    # a line above a child may be the one with its name
    for child in inner[bisect_right(inner, min(positions), key=first) :]:
        for slot in record_schema(child.part).slots[:1]:
            if slot.key:
                child.values.setdefault(slot.json, UNKNOWN)
    for index, inside in of_child.items():
        if index >= 0:
            lose(inner[index], inside)


def construct(built: ParsedRecord) -> Part:
    """Return a model without validation, for a block with unreadable values.

    A missing value is None. It is unknown if it is mandatory, or if a line that could not be used may contain it. Lines
    that are passed through are kept, comments are not.
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
    if "unread" in built.values:
        ready["unread"] = [KeptLine(**line) for line in built.values["unread"]]
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

    `kept` has the spans of lines that are passed through unchanged, by their paths.
    """

    text: str
    block: Span
    spans: dict[Path, Span] = field(default_factory=dict)
    runs: dict[Path, list[tuple[int, Span]]] = field(default_factory=dict)
    kept: dict[Path, Span] = field(default_factory=dict)
    _lines: dict[Span, array[int]] = field(default_factory=dict)

    __repr__ = short_repr

    def add(self, path: Path, span: Span | None, names: Iterable[str | int] = (), fields: Iterable[Field] = ()) -> None:
        """Add the span of a value, if it has one, and its fields by their names in it."""
        if span:
            self.spans[path] = span
        for name, field_ in zip(names, fields, strict=False):
            self.spans[*path, name] = field_.span

    @property
    def kept_starts(self) -> frozenset[int]:
        """Offsets of the lines that are passed through unchanged."""
        return frozenset(span.start for span in self.kept.values())

    def find(self, path: Path) -> Span:
        """Return the span of a value; for a value that was left out, the span of the nearest enclosing object."""
        for length in range(len(path), 0, -1):
            inner = path[:length]
            if inner in self.spans:
                return self.spans[inner]
            if inner in self.runs:
                return self._cell(self.runs[inner], path[length:])
            if inner in self.kept:
                return piece_of(self.text, self.kept[inner], path[length + 1 :])  # behind "text"
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
        kept = {path: span.moved(by) for path, span in self.kept.items()}
        return Places(text, self.block.moved(by), spans, runs, kept)

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


def piece_of(text: str, line: Span, ends: Path) -> Span:
    """Return the span of an unread line without outer blanks, or of a piece of it by its first and last offset."""
    if ends:
        return Span(line.start + int(ends[0]), line.start + int(ends[1]))
    return trimmed(text, *line)


class Between(NamedTuple):
    """Comment or `kept` line between other lines; `text` is that of a comment without its C."""

    position: int
    text: str
    span: Span
    kept: bool = False


def attach(comments: Sequence[Between], kept: Sequence[Between], block: ParsedRecord, places: Places) -> list[str]:
    """Add each comment to the innermost record with lines on both sides of it, before the item that follows.

    A kept line is added to the innermost record that can keep it and begins before it; so is a comment that follows a
    kept line there. The spans of kept lines are added to `places`. Returns the texts of the comments behind the last
    line of the block: they belong to the next block.
    """
    trailing: list[str] = []
    held: dict[int, tuple[ParsedRecord, list[Between]]] = {}
    for line in sorted(kept):
        path = _path(block, line.position, within=False)
        while len(path) > 1 and "unread" not in path[-1].part.model_fields:
            path.pop()
        held.setdefault(id(path[-1]), (path[-1], []))[1].append(line)
        for record in path:
            record.reach(line.position)
    for comment in comments:
        if block.last is not None and comment.position < block.last:
            owner = _path(block, comment.position, within=True)[-1]
            held.setdefault(id(owner), (owner, []))[1].append(comment)
        else:
            trailing.append(comment.text)
    for record, lines in held.values():
        _write(record, lines, places)
    return trailing


def _path(block: ParsedRecord, position: int, *, within: bool) -> list[ParsedRecord]:
    """Return a block and its inner records that begin before a position and, if `within`, end behind it."""
    path = [block]
    while True:
        inner = path[-1].inner
        at = bisect_left(inner, position, key=attrgetter("first")) - 1
        if at < 0 or (within and (inner[at].last or 0) <= position):
            return path
        path.append(inner[at])


def _write(record: ParsedRecord, lines: list[Between], places: Places) -> None:
    """Add lines to the values of a record, each before the item that follows it in the text.

    Settings may be written in another order than read. Comments come first, then all lines from the first kept one on.
    """
    indices: dict[Item, int] = {}
    count = 0
    for item in sorted(record.items):
        indices[item] = count
        count += item.size
    following = (bisect_right(record.items, line.position, key=attrgetter("position")) for line in lines)
    placed = (indices[record.items[at]] if at < len(record.items) else count for at in following)
    kept_before = -1
    for before, line in sorted(zip(placed, lines, strict=True)):
        kept_before = before if line.kept else kept_before
        if kept_before == before:
            unread = record.values.setdefault("unread", [])
            start = line.span.start
            for written in line.text.removesuffix("\n").split("\n") if line.kept else [f"C{line.text}"]:
                text = written.removesuffix("\r")
                if line.kept:
                    places.kept[*record.path, "unread", len(unread)] = Span(start, start + len(text))
                unread.append({"before": before, "text": text})
                start += len(written) + 1
        else:
            record.values.setdefault("comments", []).append({"before": before, "text": line.text})


_OF_OTHER_FORMS = frozenset({SYN001, SYN002, SYN003, SYN004, SYN005})
"""Faults that a line of an unknown form may cause."""


def of_other_form(
    text: str, problems: Sequence[Problem], contents: Sequence[Content], *, tabular: bool
) -> set[Content]:
    """Return the lines of an open block that have an unknown form; lines with a certain fault are not among them.

    Certain faults are a number with a wrong letter, too few or too many numbers, an empty value, and any fault of a
    table.
    """
    starts = [content.span.start for content in contents]
    possible: set[Content] = set()
    certain: set[Content] = set()
    for problem in problems:
        at = bisect_right(starts, problem.span.start) - 1 if problem.span else -1
        if at < 0 or (tabular and contents[at].type == ROW):
            continue
        if problem.code is SYN015:
            certain.add(contents[at])
        elif problem.weight is Severity.ERROR and _may_be(problem, text, contents[at]):
            possible.add(contents[at])
    return possible - certain


def _may_be(problem: Problem, text: str, content: Content) -> bool:
    span = problem.span
    if problem.code not in _OF_OTHER_FORMS or span is None or span.start >= content.span.end:
        return False
    written = text[slice(*span)]
    if problem.code is SYN002:
        return written[:1].isalpha() and reads_as_name(written)
    if problem.code is SYN003 and content.type == ROW:
        return any(reads_as_name(field.strip()) for field in written.split(","))
    return problem.code is not SYN003 or bool(written.partition("=")[2].strip()) or "=" not in written


def doubtful(problems: Sequence[Problem]) -> list[Problem]:
    """Return the problems of unknown words in kept lines: a warning for a word that may be misspelt, else an info."""
    words = [each for each in problems if each.code is SYN005 or (each.code is SYN004 and each.repair)]
    for index, problem in enumerate(words):
        if problem.weight is Severity.ERROR:
            severity = Severity.WARNING if problem.repair else Severity.INFO
            message = f"{problem.message}; the line is passed through unchanged"
            words[index] = replace(problem, message=message, severity=severity)
    return words
