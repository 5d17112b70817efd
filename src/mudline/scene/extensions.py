"""The extension keywords: which block of each of them an element follows; a later block wins, taken whole."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from mudline.diagnostics import Where
from mudline.scene.context import Context
from mudline.scene.numbering import Indices, Mask
from mudline.scene.sets import NamedSet, Sets, later_wins
from mudline.short_repr import short_repr

if TYPE_CHECKING:
    from mudline.keywords.model import Record

BY_SET = ("SEABED CONTACT", "SEABED SUCTION", "SEABED UNLOADING", "SEABED FRICTION", "SEABED TRENCH")


@dataclass(frozen=True, slots=True)
class Extension:
    """The blocks of one keyword in the order of the file; `of_element` (m,) is the one each element follows, or -1."""

    entries: list[Record]
    places: list[Where]
    sets: list[NamedSet | None]
    of_element: Indices

    __repr__ = short_repr


def read_extensions(context: Context, sets: Sets, count: int) -> dict[str, Extension]:
    """What the deck gives, by keyword; keywords that it has not are left out."""
    present = context.deck.keywords()
    return {keyword: _read(context, sets, keyword, count) for keyword in BY_SET if keyword in present}


def with_nodal_stiffness(contact: Extension) -> Mask:
    """Elements (m,) whose block of `*SEABED CONTACT` gives their nodes a stiffness."""
    given = (getattr(entry, "nodal_stiffness", None) for entry in contact.entries)
    flags = [isinstance(value, float | int) and value >= 0.0 for value in given]
    found: Mask = np.array([*flags, False])[contact.of_element]
    return found


def _read(context: Context, sets: Sets, keyword: str, count: int) -> Extension:
    found = list(_entries(context, keyword))
    holders = [_holder(context, sets, entry, where) for entry, where in found]
    return Extension([entry for entry, _ in found], [where for _, where in found], holders, later_wins(holders, count))


def _entries(context: Context, keyword: str) -> Iterator[tuple[Record, Where]]:
    for where, block in context.deck.blocks(keyword):
        for index, entry in enumerate(cast("Any", block).sets):
            yield entry, where._replace(path=("sets", index))


def _holder(context: Context, sets: Sets, entry: Record, where: Where) -> NamedSet | None:
    name = getattr(entry, "set_name", None)
    if name is None:
        context.unread.add("SEABED PROPERTIES")
        return None
    return sets.find(name, where._replace(path=(*where.path, "set")))
