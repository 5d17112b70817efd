"""Every place where a deck gives the number of a node or an element, alone or within a range."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import islice
from typing import NamedTuple, cast

import numpy as np

from mudline.deck.model import Deck, Opaque
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Span
from mudline.keywords.model import Block, FieldSpec, ListRow, Part, Rows, record_schema
from mudline.keywords.places import Path
from mudline.keywords.table import Table
from mudline.keywords.values import Names

KINDS = {Names.NODE: "node", Names.ELEMENT: "element"}
_MOST = 10_000
"""Places that are given of one number."""


class Use(NamedTuple):
    """A place where a number is given; `defines` says that the node or element is made there."""

    span: Span
    defines: bool


def uses(deck: Deck, kind: Names, number: int) -> list[Use]:
    """The first places in a deck of its own, in the order of the text; none in a deck that is no keyword text."""
    origin = deck.origin
    if not isinstance(origin, TextOrigin):
        return []
    found: list[Use] = []
    for (i, j), read in origin.read.items():
        block = deck.sections[i].blocks[j]
        if type(block) is Opaque or not _leads(type(cast("Block", block)), kind):
            continue
        makes = cast("Block", block).facts.defines == f"{KINDS[kind]}s"
        paths = islice(_paths(cast("Block", block), kind, number, (), makes=makes), _MOST)
        found += [Use(read.places.find(path), defines) for path, defines in paths]
    return sorted(found)


@cache
def _leads(part: type[Part], kind: Names) -> bool:
    return any(_of(slot, kind) or any(_leads(inner, kind) for inner in _inner(slot)) for slot in _slots(part))


def _slots(part: type[Part]) -> list[FieldSpec]:
    return record_schema(part).slots


def _of(slot: FieldSpec, kind: Names) -> bool:
    return kind in (slot.about.names, slot.about.defines)


def _inner(slot: FieldSpec) -> list[type[Part]]:
    row = slot.about.row if isinstance(slot.about, Rows) else slot.row
    return [each for each in (row, *slot.record.values()) if each]


def _paths(part: Part, kind: Names, number: int, path: Path, *, makes: bool) -> Iterator[tuple[Path, bool]]:
    """The paths below a part that give the number, and whether it is defined there; `makes` is that of the block."""
    for slot in _slots(type(part)):
        value = getattr(part, slot.name, None)
        inner = (*path, slot.json)
        if isinstance(value, Table):
            yield from (((*inner, row, column), defines) for row, column, defines in _cells(slot, value, kind, number))
        elif isinstance(value, ListRow):
            if any(_of(each, kind) for each in _slots(type(value))) and _holds(value, number):
                yield inner, makes
        elif isinstance(value, list) and slot.record:
            for index, item in enumerate(value):
                yield from _paths(item, kind, number, (*inner, index), makes=makes)
        elif isinstance(value, list) and _of(slot, kind):
            yield from (((*inner, index), False) for index, item in enumerate(value) if item == number)
        elif _of(slot, kind) and value == number:
            yield inner, False


def _cells(slot: FieldSpec, table: Table, kind: Names, number: int) -> Iterator[tuple[int, int, bool]]:
    """Row and column of the cells of a table that give the number, and whether it is defined there."""
    for column, each in enumerate(_slots(_inner(slot)[0])):
        if _of(each, kind) and column < table.values.shape[1]:
            rows = np.flatnonzero(table.values[:, column] == number)[:_MOST].tolist()
            yield from ((row, column, each.about.defines is kind) for row in rows)


def _holds(row: ListRow, number: int) -> bool:
    """Whether a range holds a number: `start, end [, increment]`, or `master, count [, increment]`."""
    start = getattr(row, "start", getattr(row, "master", None))
    of_five = getattr(row, "third", None) if getattr(row, "fifth", None) is not None else None  # of *BOUNDARY
    step = getattr(row, "increment", of_five) or 1
    end = getattr(row, "end", None)
    if not isinstance(start, int) or not isinstance(step, int):
        return False
    if end is None and isinstance(count := getattr(row, "count", None), int):
        end = start + (count - 1) * step
    return isinstance(end, int) and step > 0 and start <= number <= end and (number - start) % step == 0
