"""What the reader took the lines of a block for: the kind of each row, and which words are choices."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import NamedTuple

from mudline.keywords.model import Block, Record, Row, Slot, layout
from mudline.keywords.places import Path, Places
from mudline.keywords.table import Table
from mudline.keywords.values import Kind

_BLANKS = re.compile(r"[ \t]*")


class RowKind(NamedTuple):
    """Rows that fill the same field of a model: that field, and the fields on a row.

    `many`: any number of values of the one field; `table`: rows that are read as arrays.
    """

    slot: Slot
    columns: tuple[Slot, ...]
    many: bool = False
    table: bool = False

    def is_text(self, column: int) -> bool:
        """Whether a column holds names or text; others hold numbers, with an equation or a label here and there."""
        slot = self.columns[0] if self.many else self.columns[min(column, len(self.columns) - 1)]
        return bool(slot.choices) or slot.kind in (Kind.NAME, Kind.REAL_OR_NAME)


@dataclass(slots=True)
class Reading:
    """By offset: the kind of the row, or of the values of the KEY=, that begins there; the choice that stands there."""

    text: str
    kinds: dict[int, RowKind] = field(default_factory=dict)
    choices: dict[int, str] = field(default_factory=dict)

    def kind_at(self, start: int) -> RowKind | None:
        """The kind of the row that begins at or behind the blanks at an offset."""
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
    """The value of one field that is no record."""
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
    elif span and slot.kind is not Kind.NAME and value in slot.choices:
        found.choices[span.start] = str(value)
