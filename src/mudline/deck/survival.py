"""What keyword text cannot say: a deck and what its text was read as are held against each other."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from mudline.deck.faults import DocumentPath, shown
from mudline.deck.model import Deck, Opaque, Section
from mudline.diagnostics import Where
from mudline.keywords.model import Block, Part, layout
from mudline.keywords.table import Table

_P = TypeVar("_P", bound=Part)
_FEW = 20
"""Rows of a table that are tried, beside one for every length and every word in it: numbers are safe."""

_NOTHING = object()


def lightened(deck: Deck) -> Deck:
    """The deck with few rows in its tables, enough to see whether they survive."""
    sections = [replace(section, blocks=[_light(block) for block in section.blocks]) for section in deck.sections]
    return replace(deck, sections=sections)


def lost(deck: Deck, again: Deck) -> tuple[Where, str] | None:
    """The first value of a deck that is another one in what was read from its text, and what it was read as."""
    if again.preamble != deck.preamble:
        return _told(Where(), ("preamble",), deck.preamble, again.preamble)
    for index, section in enumerate(deck.sections):
        if index == len(again.sections) or again.sections[index].name != section.name:
            return Where(index, -1, ("name",)), f"{shown(section.name)} would not be read as this section"
        if change := _lost_in(section, again.sections[index], index):
            return change
    if len(again.sections) > len(deck.sections):
        return Where(len(deck.sections) - 1), f"a line would be read as ${again.sections[-1].name}"
    return None


def _lost_in(section: Section, again: Section, index: int) -> tuple[Where, str] | None:
    if section.lines != again.lines:
        return _told(Where(index), ("lines",), section.lines, again.lines)
    for number, block in enumerate(section.blocks):
        found = again.blocks[number] if number < len(again.blocks) else None
        if found is None or (block != found and _bare(block) != _bare(found)):
            return _told(Where(index, number), (), _values(block), _values(found))
    if len(again.blocks) > len(section.blocks):
        return Where(index), f"a line of this section would be read as *{again.blocks[-1].keyword}"
    return None


def _light(part: _P) -> _P:
    changes: dict[str, Any] = {}
    for slot in layout(type(part)).slots:
        value = getattr(part, slot.name, None)
        if isinstance(value, Table) and len(value) > _FEW:
            changes[slot.name] = _some_rows(value)
        elif slot.record and value:
            changes[slot.name] = [_light(record) for record in value]
    return part.model_copy(update=changes) if changes else part


def _some_rows(table: Table) -> Table:
    firsts = np.unique(table.lengths, return_index=True)[1].tolist()
    first_of = {(column, word): row for (row, column), word in reversed(table.words.items())}
    rows = sorted({*range(_FEW), *firsts, *first_of.values()})
    kept = {row: number for number, row in enumerate(rows)}
    words = {(kept[row], column): word for (row, column), word in table.words.items() if row in kept}
    return Table(table.values[rows], table.lengths[rows], words)


def _bare(part: _P) -> _P:
    """A part without its comments, which may find another place."""
    changes: dict[str, Any] = {"comments": []} if getattr(part, "comments", None) else {}
    for slot in layout(type(part)).slots:
        value = getattr(part, slot.name, None)
        if slot.record and value:
            changes[slot.name] = [_bare(record) for record in value]
    return part.model_copy(update=changes) if changes else part


def _values(block: Block | Opaque | None) -> object:
    return _NOTHING if block is None else _bare(block).model_dump()


def _told(where: Where, path: DocumentPath, wanted: object, found: object) -> tuple[Where, str]:
    """The first difference between two values, in words."""
    inner, one, other = _difference(wanted, found)
    read = "nothing" if other is _NOTHING or other is None else shown(other)
    given = "nothing" if one is _NOTHING or one is None else shown(one)
    return where._replace(path=(*path, *inner)), f"{given} would be read as {read}"


def _difference(one: object, other: object) -> tuple[DocumentPath, object, object]:
    pairs: dict[str | int, tuple[object, object]] = {}
    if isinstance(one, dict) and isinstance(other, dict):
        pairs = {key: (one.get(key, _NOTHING), other.get(key, _NOTHING)) for key in one | other}
    elif isinstance(one, list) and isinstance(other, list):
        size = max(len(one), len(other))
        padded = ([*given, *[_NOTHING] * (size - len(given))] for given in (one, other))
        pairs = dict(enumerate(zip(*padded, strict=True)))
    for key, (left, right) in pairs.items():
        if left != right:
            path, *values = _difference(left, right)
            return (key, *path), values[0], values[1]
    return (), one, other
