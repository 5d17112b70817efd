"""Section properties: which `*GEOMETRIC SETS` entry an element has, and its external diameter."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.diagnostics import Where
from mudline.scene.context import Context
from mudline.scene.numbering import Floats, Indices, Mask, Numbered, looked_up
from mudline.scene.sets import NamedSet, Sets, later_wins
from mudline.short_repr import short_repr

if TYPE_CHECKING:
    from mudline.keywords.library.geometric_sets import GeometricSet, GeometricSets
    from mudline.scene.external_elements import ExternalElements


@dataclass(frozen=True, slots=True)
class Section:
    """An entry of `*GEOMETRIC SETS`. `diameter` is NaN where there is none, or none that can be used.

    `source` is "Do" or "Dd"; `faulty` says that the diameter could not be read or is out of range, which is reported.
    """

    name: str
    diameter: float
    source: str
    where: Where
    faulty: bool


@dataclass(frozen=True, slots=True)
class SectionTable:
    """Sections in the order of the file; `of_element` (m,) is the one that each element has, -1 for none.

    `diameter` (m,) is the external diameter, NaN where there is none; `faulty` (m,) marks elements whose section could
    not be read: nothing more is said about them. `open` says that a section belongs to a set whose elements the deck
    does not show, so that any element may have it.
    """

    sections: tuple[Section, ...]
    of_element: Indices
    diameter: Floats
    faulty: Mask
    open: bool

    __repr__ = short_repr


def read_sections(
    context: Context, sets: Sets, elements: Numbered, external: ExternalElements | None = None
) -> SectionTable:
    """The sections, and the one of each element: the later entry wins, a diameter from a file over all."""
    sections: list[Section] = []
    holders: list[NamedSet | None] = []
    for where, block in context.deck.blocks("GEOMETRIC SETS"):
        for index, entry in enumerate(cast("GeometricSets", block).sets):
            place = where.inside("sets", index)
            name = cast("str | None", entry.set_name)
            holders.append(None if name is None else sets.find(name))
            sections.append(_section(context, entry, place))
    of_element = later_wins(holders, len(elements))
    diameter = looked_up(np.array([*(section.diameter for section in sections), math.nan]), of_element)
    unread = None in holders or "GEOMETRIC SETS" in context.unread
    faulty = looked_up(np.array([*(section.faulty for section in sections), unread]), of_element)
    if external is not None:
        diameter, faulty = diameter.copy(), faulty.copy()
        at = elements.indices(external.ids)
        given = ~np.isnan(external.diameter)
        diameter[at[given]] = external.diameter[given]
        faulty[at[given]] = False
    is_open = any(holder.open for holder in holders if holder)
    return SectionTable(tuple(sections), of_element, diameter, faulty, is_open)


def _section(context: Context, entry: GeometricSet, where: Where) -> Section:
    source, value = entry.diameter
    diameter = float(value) if isinstance(value, int | float) else math.nan
    option = next((name for name in ("flexible", "rigid", "mooring", "truss") if getattr(entry, name) is not None), "")
    unread = context.has_read_errors(where) or context.has_read_errors(where.inside(option))
    bad = diameter < 0 or math.isnan(diameter) or (source == "Do" and diameter == 0)
    name = str(entry.set_name or "")
    return Section(name, diameter if diameter > 0 else math.nan, source, where, unread or bad)
