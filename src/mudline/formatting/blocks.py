"""The lines of a block that has a model, in canonical layout."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from mudline.diagnostics import Span
from mudline.formatting.rows import RowKind, Rows, Run, Single, cut
from mudline.keywords.model import Block, Record, Row, Slot, layout
from mudline.keywords.places import Path, Places
from mudline.keywords.reader import ReadBlock, all_keys
from mudline.keywords.table import Table
from mudline.keywords.values import Kind as FieldKind
from mudline.syntax.fields import Group, first_key, read_line, split
from mudline.syntax.rows import blank_separated, line_spans
from mudline.syntax.tree import Kind, Leaf, RawBlock

_BLANKS = re.compile(r"[ \t]*")


@dataclass(slots=True)
class Reading:
    """By offset: the kind of the row, or of the values of the KEY=, that begins there; the choice written there."""

    text: str
    kinds: dict[int, RowKind] = field(default_factory=dict)
    choices: dict[int, str] = field(default_factory=dict)

    def kind_at(self, start: int) -> RowKind | None:
        """The kind of the row that begins at an offset or after the blanks there."""
        return self.kinds.get(self._begin(start))

    def put(self, start: int, kind: RowKind) -> None:
        """Note the kind of a row."""
        self.kinds[self._begin(start)] = kind

    def _begin(self, start: int) -> int:
        match = _BLANKS.match(self.text, start)
        return match.end() if match else start


def reading_of(block: Block, places: Places) -> Reading:
    """The kinds of rows and the choices of a block that was read without a fault."""
    found = Reading(places.text)
    _record(block, (), places, found)
    return found


def _record(record: Record, path: Path, places: Places, found: Reading) -> None:
    declared = layout(type(record))
    plain = [slot for slot in declared.columns if not slot.row and not slot.many]
    if plain and len(plain) == len(declared.columns) and (span := places.spans.get((*path, plain[0].json))):
        found.put(span.start, RowKind(plain[0], tuple(plain)))
        plain = []
    for slot in declared.slots:
        inner = (*path, slot.json)
        value = getattr(record, slot.name)
        if slot.record:
            for index, child in enumerate(value):
                _record(child, (*inner, index), places, found)
        elif value is not None:
            _value(slot, value, inner, places, found)
        if slot in plain and (span := places.spans.get(inner)):
            found.put(span.start, RowKind(slot, (slot,)))


def _value(slot: Slot, value: object, path: Path, places: Places, found: Reading) -> None:
    """The value of one field that is not a record."""
    span = places.spans.get(path)
    if isinstance(value, Table) and slot.row:
        kind = RowKind(slot, tuple(layout(slot.row).columns), table=True)
        for _, run in places.runs.get(path, ()):
            found.put(run.start, kind)
    elif isinstance(value, list):
        if first := places.spans.get((*path, 0)):
            found.put(first.start, RowKind(slot, (slot,), many=True))
    elif span and isinstance(value, Row):
        columns = layout(type(value)).columns
        found.put(span.start, RowKind(slot, tuple(columns)))
        for column in columns:
            _value(column, getattr(value, column.name), (*path, column.json), places, found)
    elif span and slot.kind is not FieldKind.NAME and value in slot.choices:
        found.choices[span.start] = str(value)


Laid = tuple[Span, str]
"""Lines, each with a LF, and the span that they replace."""


def comment_line(text: str, span: Span) -> str:
    """A comment without blanks at its end."""
    return text[slice(*span)].rstrip(" \t\r\n") + "\n"


def block_lines(text: str, raw: RawBlock, read: ReadBlock) -> Iterator[Laid]:
    """The lines of a block except its head and its blank lines."""
    block = _Block(text, read)
    for leaf in raw.leaves:
        yield from block.lines(leaf)
    yield from block.flush()


class _Block:
    def __init__(self, text: str, read: ReadBlock) -> None:
        self.text = text
        self.declared = type(read.model)
        self.keys = all_keys(self.declared)
        self.reading = reading_of(read.model, read.places)
        self.rows: Rows | None = None

    def lines(self, leaf: Leaf) -> Iterator[Laid]:
        """The lines that are complete when this leaf is reached: rows are collected until their table ends."""
        if leaf.kind in (Kind.RUN, Kind.TEXT):
            for span in self._row_spans(leaf.span):
                yield from self._row(span)
        elif leaf.kind is Kind.SETTING or (
            leaf.kind is Kind.UNDECIDED and first_key(self.text, leaf.span) in self.keys
        ):
            yield from self.flush()
            yield leaf.span, self._setting(leaf.span)
        elif leaf.kind is not Kind.BLANK:
            yield leaf.span, comment_line(self.text, leaf.span)

    def flush(self) -> Iterator[Laid]:
        """The rows collected so far."""
        if self.rows:
            yield from self.rows.laid_out()
        self.rows = None

    def _row_spans(self, run: Span) -> Iterator[Span]:
        """The whole run where it belongs to a table, else its lines with their ends."""
        if self.declared.tabular:
            yield run
            return
        for line in line_spans(self.text, run):
            yield Span(line.start, min(line.end + 1, run.end))

    def _row(self, span: Span) -> Iterator[Laid]:
        """Add a row, or a run of them, to those collected if it is of their kind; else start a new table."""
        kind = self.reading.kind_at(span.start)
        if kind is None:  # not part of the model: left unchanged
            return
        if self.rows is None or self.rows.kind.slot is not kind.slot:
            yield from self.flush()
            self.rows = Rows(kind)
        self.rows.members.append(Run(self.text, span) if kind.table else Single(self._fields(span), span))

    def _fields(self, span: Span) -> list[str]:
        """The fields of a row outside a table."""
        fields, _ = split(self.text, span, slashes=self.declared.slashes)
        texts = [self.reading.choices.get(given.span.start, given.text) for given in fields]
        return cut(split_blanks(texts))

    def _setting(self, span: Span) -> str:
        line = read_line(self.text, span, slashes=self.declared.slashes)
        texts = [text for group in line.groups for text in self._group(group)]
        return " " + ", ".join(texts).rstrip(" ") + "\n"

    def _group(self, group: Group) -> list[str]:
        """`KEY=` with its first value, then the others.

        A value that begins with a bracket keeps a blank before it: without that it would be an equation.
        """
        texts = [self.reading.choices.get(given.span.start, given.text) for given in group.fields]
        kind = self.reading.kinds.get(group.span.start)
        texts = cut(split_blanks(texts) if kind and len(kind.columns) > 1 else texts)
        first = group.fields[0].span.start
        blank = " " if texts[0].startswith("[") and self.text[first - 1] != "=" else ""
        return [f"{group.key}={blank}{texts[0]}", *texts[1:]]


def split_blanks(texts: list[str]) -> list[str]:
    """Numbers that are separated only by blanks, each a field."""
    return texts[0].split() if len(texts) == 1 and blank_separated(texts[0]) else texts
