"""The extension keywords: which block of each of them an element follows; a later block wins, taken whole."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.diagnostics import Where
from mudline.keywords import catalogue
from mudline.keywords.model import set_slots
from mudline.scene.context import Context
from mudline.scene.deck_values import number
from mudline.scene.numbering import Floats, Indices, Mask, picked
from mudline.scene.sets import NamedSet, Sets, later_wins
from mudline.short_repr import short_repr

if TYPE_CHECKING:
    from mudline.keywords.model import Block, Record


@dataclass(frozen=True, slots=True)
class Extension:
    """The blocks of one keyword in the order of the file; `of_element` (m,) is the one each element follows, or -1."""

    entries: list[Record]
    places: list[Where]
    sets: list[NamedSet | None]
    of_element: Indices

    __repr__ = short_repr

    def values(self, at: Indices, *names: str, default: float = math.nan) -> Floats:
        """A number of the block of each index, `default` where the block does not give it, NaN for -1.

        `names` lead to it: a field, or a field of a record and a field in it.
        """
        *outer, name = names
        parts: Iterable[object] = self.entries
        for step in outer:
            parts = [getattr(part, step, None) for part in parts]
        return picked((number(part, name, default) for part in parts), at)


def read_extensions(context: Context, sets: Sets, count: int) -> dict[str, Extension]:
    """What the deck gives, by keyword in the order of the catalogue; keywords that it has not are left out."""
    given = {block.keyword for _, block in context.deck.blocks_that(_goes_by_set)}
    return {keyword: _read(context, sets, keyword, count) for keyword in catalogue.in_order(given)}


def _goes_by_set(declared: type[Block]) -> bool:
    return declared.facts.extension and declared.facts.later_wins


def with_nodal_stiffness(contact: Extension) -> Mask:
    """Elements (m,) whose block of `*SEABED CONTACT` gives their nodes a stiffness."""
    given = (getattr(entry, "nodal_stiffness", None) for entry in contact.entries)
    flags = [isinstance(value, float | int) and value >= 0.0 for value in given]
    found: Mask = np.array([*flags, False])[contact.of_element]
    return found


def _read(context: Context, sets: Sets, keyword: str, count: int) -> Extension:
    entries: list[Record] = []
    places: list[Where] = []
    holders: list[NamedSet | None] = []
    for where, block in context.deck.blocks(keyword):
        for listed, named in set_slots(type(cast("Block", block))):
            for index, entry in enumerate(getattr(block, listed.name)):
                entries.append(entry)
                places.append(where.inside(listed.json, index))
                holders.append(_holder(context, sets, getattr(entry, named.name)))
    return Extension(entries, places, holders, later_wins(holders, count))


def _holder(context: Context, sets: Sets, name: str | None) -> NamedSet | None:
    if name is None:
        context.unread.add("SEABED PROPERTIES")
        return None
    return sets.find(name)
