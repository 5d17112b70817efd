"""How the lines of a keyword look, in words: for messages, help and pages."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import cache

from mudline.keywords.grammar import ROW, terminal_of
from mudline.keywords.layout import Layout
from mudline.keywords.model import Record, layout
from mudline.keywords.text import either


@cache
def all_keys(part: type[Record]) -> tuple[str, ...]:
    """Every KEY that the lines of a keyword may begin with or hold."""
    return tuple(dict.fromkeys(key for found in _layouts(part) for key in found.keys))


@cache
def row_formats(part: type[Record]) -> tuple[str, ...]:
    """How the rows of a keyword look, such as `node, x, y [, z]`."""
    return tuple(dict.fromkeys(shape for found in _layouts(part) for shape in _shapes(found)))


def lines_of(part: type[Record], terminals: Collection[str]) -> str:
    """The lines that terminals of the grammar stand for, in words; "" for none."""
    keys = {terminal_of(key): key for key in all_keys(part)}
    rows = [f"a row `{shape}`" for shape in row_formats(part)] if ROW in terminals else []
    words = [*rows, *(f"{keys[terminal]}=" for terminal in terminals if terminal in keys)]
    return either(words) if words else ""


@cache
def every_line(part: type[Record]) -> str:
    """All kinds of line that a keyword has, in words."""
    return lines_of(part, [ROW, *map(terminal_of, all_keys(part))])


def _shapes(found: Layout) -> Iterator[str]:
    if found.plain_row:
        yield found.wanted
    else:
        for slot in found.columns:
            yield layout(slot.row).wanted if slot.row else f"{slot.label}, ..." if slot.many else slot.label
    if found.table and found.table.row:
        yield layout(found.table.row).wanted


def _layouts(part: type[Record]) -> Iterator[Layout]:
    own = layout(part)
    yield own
    for slot in own.children.values():
        for record in slot.record.values():
            yield from _layouts(record)
