"""The lines of a record as plain values, before they become a model, and the order in which they are written."""

from __future__ import annotations

from bisect import bisect_left, bisect_right, insort
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from mudline.keywords.layout import Slot
from mudline.keywords.model import Block, Comment, Part, Record, Row, layout
from mudline.keywords.places import Path
from mudline.keywords.tables import TableBuilder


@dataclass(frozen=True, slots=True)
class Item:
    """A line, a run of rows or a record among the contents of a record.

    `order` is where it is written, `position` where it stood; it counts for `count` items, the rows of a run each.
    """

    order: int
    position: int
    count: int
    setting: bool


class Spot(NamedTuple):
    """Where a comment belongs: before which item of a record."""

    record: Built
    before: int


@dataclass(slots=True)
class Built:
    """A record as plain values, at its path in the block. Its items are in the order of the file."""

    part: type[Record]
    path: Path = ()
    values: dict[str, Any] = field(default_factory=dict)
    children: dict[str, list[Built]] = field(default_factory=dict)
    tables: dict[str, TableBuilder] = field(default_factory=dict)
    rows: int = 0
    items: list[Item] = field(default_factory=list)
    starts: list[int | None] = field(default_factory=list)
    last: int = -1

    @property
    def first(self) -> int:
        """Position of its first line."""
        return self.items[0].position

    def add(self, slot: Slot, position: int, count: int = 1) -> None:
        """Take note of a line or a run of rows."""
        self.items.append(Item(slot.order, position, count, setting=bool(slot.key)))
        self.last = position

    def add_child(self, slot: Slot, child: Built) -> None:
        """Take in a record."""
        self.values.setdefault(slot.json, []).append(child.values)
        self.children.setdefault(slot.json, []).append(child)
        self.add(slot, child.first)
        self.last = child.last

    def spot(self, position: int) -> Spot | None:
        """Where a comment at a position belongs: in the innermost record with lines on both sides, before an item.

        None when it belongs before this record, as it stands before the line that is written first.
        """
        for records in self.children.values():
            index = bisect_left(records, position, key=lambda record: record.first) - 1
            inner = records[index] if index >= 0 else None
            if inner and position < inner.last:
                return inner.spot(position) or self._before(bisect_left(self.items, inner.first, key=_position))
        return self._before(bisect_right(self.items, position, key=_position))

    def _before(self, index: int) -> Spot | None:
        """Before the item at an index."""
        if not self.starts:
            self._number()
        start = self.starts[index]
        return None if start is None else Spot(self, start)

    def _number(self) -> None:
        """Number the items in the order in which they are written; a record's opening setting is none of them."""
        written = sorted(range(len(self.items)), key=lambda index: self.items[index].order)
        self.starts = [None] * len(self.items)
        opens = self.items[written[0]].setting and not issubclass(self.part, Block)
        total = 0
        for index in written[1:] if opens else written:
            self.starts[index] = total
            total += self.items[index].count
        self.starts.append(total)


def _position(item: Item) -> int:
    return item.position


def attach(position: int, text: str, block: Built) -> bool:
    """Put a comment into the record that it stands in; False when it stands behind the last line of the block."""
    if position > block.last:
        return False
    record, before = block.spot(position) or Spot(block, 0)
    comments = record.values.setdefault("comments", [])
    insort(comments, {"before": before, "text": text}, key=lambda comment: comment["before"])
    return True


def construct(built: Built) -> Part:
    """A model without validation, for a block in which something could not be read: what is missing is None."""
    ready: dict[str, Any] = {"comments": [Comment(**comment) for comment in built.values.get("comments", [])]}
    given = {"keyword", "comments"} & set(built.values)
    if "keyword" in given:
        ready["keyword"] = built.values["keyword"]
    for slot in layout(built.part).slots:
        value = built.values.get(slot.json)
        given |= {slot.name} if value is not None else set()
        if slot.record:
            ready[slot.name] = [construct(child) for child in built.children.get(slot.json, [])]
        elif slot.row and not slot.table and value is not None:
            ready[slot.name] = _row(slot.row, value)
        else:
            ready[slot.name] = value
    return built.part.model_construct(given, **ready)


def _row(row: type[Row], values: list[Any] | dict[str, Any]) -> Row:
    """A row as it was read."""
    slots = layout(row).columns
    if isinstance(values, list):
        values = {slot.json: value for slot, value in zip(slots, values, strict=False)}
    given = {slot.name for slot in slots if slot.json in values}
    return row.model_construct(given, **{slot.name: values.get(slot.json) for slot in slots})
