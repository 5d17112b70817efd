"""Writing of a model as the lines of its keyword, with comments at their places."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from operator import itemgetter
from typing import Any

from pydantic_core import to_json

from mudline.language.keywords.contents import KeptLine
from mudline.language.keywords.fields import Comment, Setting
from mudline.language.keywords.model import Block, FieldSpec, Part, Record, Rows, record_schema
from mudline.language.keywords.table import Cell

Item = tuple[list[str], int]
"""Lines that comments can precede, and their number of items: one for each table row, else one in total."""


def block_lines(block: Block) -> Iterator[str]:
    """Yield the lines of a block without line ends, beginning with its `*KEYWORD`."""
    yield f"*{block.keyword}"
    yield from with_comments(block.comments, _items(block), getattr(block, "unread", ()))


def _record_lines(record: Record) -> Iterator[str]:
    """Yield the opening setting of a record, if its first field is one, then its items."""
    items = list(_items(record))
    given = (slot.about for slot in record_schema(type(record)).slots if getattr(record, slot.name) is not None)
    if items and isinstance(next(given, None), Setting):
        yield from items.pop(0)[0]
    yield from with_comments(record.comments, items, getattr(record, "unread", ()))


def with_comments(comments: list[Comment], items: Iterable[Item], kept: Iterable[KeptLine] = ()) -> Iterator[str]:
    """Yield the lines of items in order; before each item its comments and then its kept lines."""
    between = [*((comment.before, f"C{comment.text}") for comment in comments)]
    between += [(line.before, line.text) for line in kept]
    between.sort(key=itemgetter(0))
    at = index = 0
    for lines, count in items:
        done = 0
        while at < len(between) and between[at][0] < index + count:
            before = max(between[at][0] - index, done)
            yield from lines[done:before]
            yield between[at][1]
            done = before
            at += 1
        yield from lines[done:] if done else lines
        index += count
    yield from (line for _, line in between[at:])


def _items(record: Record) -> Iterator[Item]:
    """Yield the items of a record in the order of its fields: a line, an inner record, or rows of a table."""
    schema = record_schema(type(record))
    plain = [slot for slot in schema.columns if not slot.row]
    own_row = plain if len(plain) == len(schema.columns) else []
    pending: str = ""
    for slot in schema.slots:
        if slot in own_row[1:]:
            continue
        value = getattr(record, slot.name)
        if value is None and slot not in own_row:
            continue
        setting = slot.about if isinstance(slot.about, Setting) else None
        joins = pending != "" and setting is not None and setting.inline
        if joins and setting and setting.behind:
            joins = pending.startswith(f" {setting.behind}=")
        if pending and not joins:
            yield [pending], 1
            pending = ""
        if slot in own_row:
            has_row = any(own.required or own.name in record.model_fields_set for own in own_row)
            pending = " " + _row(record, own_row) if has_row else ""
        elif setting:
            text = f"{setting.key}={_value(value)}"
            pending = f"{pending}, {text}" if joins else f" {text}"
        elif isinstance(slot.about, Rows):
            for piece in value.lines(joined):
                lines = f" {piece}".replace("\n", "\n ").split("\n")
                yield lines, len(lines)
        elif slot.record:
            yield from ((list(_record_lines(child)), 1) for child in value)
        else:
            pending = f" {_value(value)}"
    if pending:
        yield [pending], 1


def _value(value: Any) -> str:
    if isinstance(value, Part):
        return _row(value, record_schema(type(value)).columns)
    if isinstance(value, list):
        return joined(value)
    return field_text(value)


def _row(part: Part, columns: list[FieldSpec]) -> str:
    present = [getattr(part, slot.name) is not None for slot in columns]
    length = max((index + 1 for index, here in enumerate(present) if here), default=1)
    values = [getattr(part, slot.name) for slot in columns[:length]]
    if len(values) == 1 and isinstance(values[0], list):
        values = values[0]
    return joined(values)


def joined(values: list[Cell]) -> str:
    """Return the fields of a line; a line of one empty field is a comma, since an empty line is not a line."""
    text = ", ".join(field_text(value) for value in values).rstrip(" ")
    return text or ","


def field_text(value: Cell) -> str:
    """Return the text of a field: the shortest number that reads back to the same double; "" for an empty field."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    return to_json(value).decode() if isinstance(value, float | int) else str(value)
