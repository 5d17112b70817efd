"""A model to the lines of its keyword, comments where they stood."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import cast

from pydantic_core import to_json

from mudline.keywords.layout import Slot
from mudline.keywords.model import Block, Record, Row, given_values, layout
from mudline.keywords.table import Column, Table


def block_lines(block: Block) -> Iterator[str]:
    """The lines of a block, from its `*KEYWORD` on; a piece may be several lines, parted by LF."""
    yield f"*{block.keyword}"
    yield from _with_comments(block, list(_items(block)))


def table_text(table: Table, columns: Sequence[Column]) -> str:
    """The rows of a table, a line each, fields parted by commas."""
    rows = table.rows(columns)
    numbers = to_json(rows)
    if b'"' in numbers or b"null" in numbers or b"[]" in numbers:
        return "\n".join(joined(row) for row in rows)
    return numbers[2:-2].decode().replace("],[", "\n").replace(",", ", ")


def joined(values: Sequence[object]) -> str:
    """Fields of a line; a line of one empty field is a comma, as an empty line would be no line."""
    return ", ".join(field_text(value) for value in values).rstrip(" ") or ","


def field_text(value: object) -> str:
    """A field: the shortest number that reads back to the same double, text as it is, nothing for an empty field."""
    if value is None:
        return ""
    return to_json(value).decode() if isinstance(value, float | int) else str(value)


def _record_lines(record: Record) -> Iterator[str]:
    """The opening setting of a record, if its first field is one, then its items."""
    items = list(_items(record))
    given = (slot for slot in layout(type(record)).slots if getattr(record, slot.name) is not None)
    if next(given).key:
        yield items.pop(0)
    yield from _with_comments(record, items)


def _with_comments(record: Record, items: Sequence[str]) -> Iterator[str]:
    comments = sorted(record.comments, key=lambda comment: comment.before)
    at = 0
    for index, item in enumerate(items):
        while at < len(comments) and comments[at].before <= index:
            yield f"C{comments[at].text}"
            at += 1
        yield item
    yield from (f"C{comment.text}" for comment in comments[at:])


def _items(record: Record) -> Iterator[str]:
    """The items of a record in the order of its fields: a line each, or the lines of a record below it."""
    found = layout(type(record))
    if found.plain_row:
        yield " " + joined(given_values(record, found.columns))
    pending = ""
    for slot in found.slots:
        value = getattr(record, slot.name)
        if pending and not slot.inline:
            yield pending
            pending = ""
        if value is None or (found.plain_row and slot in found.columns):
            continue
        if slot.key:
            text = f"{slot.key}={_value(value)}"
            pending = f"{pending}, {text}" if pending else f" {text}"
        else:
            yield from _contents(value, slot, whole=not record.comments)
    if pending:
        yield pending


def _contents(value: object, slot: Slot, *, whole: bool) -> Iterator[str]:
    """A table (one item if it is `whole`, as no comment stands in it), records, or a row of its own."""
    if isinstance(value, Table):
        if len(value):
            text = " " + table_text(value, cast("type[Row]", slot.row).table_columns()).replace("\n", "\n ")
            yield from [text] if whole else text.split("\n")
    elif slot.record:
        yield from ("\n".join(_record_lines(record)) for record in cast("list[Record]", value))
    else:
        yield f" {_value(value)}"


def _value(value: object) -> str:
    if isinstance(value, Row):
        return joined(given_values(value, layout(type(value)).columns))
    return joined(value) if isinstance(value, list) else field_text(value)
