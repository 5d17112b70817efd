"""Section properties: which `*GEOMETRIC SETS` entry an element has, and its external diameter."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from mudline.diagnostics import Where
from mudline.scene.context import Context
from mudline.scene.numbering import Floats, Indices
from mudline.scene.sets import Sets

if TYPE_CHECKING:
    from mudline.keywords.library.geometric_sets import GeometricSet, GeometricSets


@dataclass(frozen=True, slots=True)
class Section:
    """An entry of `*GEOMETRIC SETS`. `diameter` is NaN where there is none, or none that can be used.

    `source` is "Do" or "Dd"; `faulty` says that the entry could not be read, or its diameter is not positive.
    """

    name: str
    diameter: float
    source: str
    where: Where
    faulty: bool


@dataclass(frozen=True, slots=True)
class SectionTable:
    """Sections in the order of the file; `of_element` (m,) is the one that each element has, -1 for none."""

    sections: tuple[Section, ...]
    of_element: Indices

    @property
    def diameter(self) -> Floats:
        """External diameter of each element (m,), NaN where there is none."""
        return np.array([*(section.diameter for section in self.sections), math.nan])[self.of_element]

    @property
    def faulty(self) -> NDArray[np.bool_]:
        """Elements (m,) whose section could not be read: nothing more is said about it."""
        return np.array([*(section.faulty for section in self.sections), False])[self.of_element]


def read_sections(context: Context, sets: Sets, count: int) -> SectionTable:
    """The sections, and the one of each of `count` elements: the later entry wins."""
    sections: list[Section] = []
    of_element = np.full(count, -1, dtype=np.intp)
    for where, block in context.deck.blocks("GEOMETRIC SETS"):
        for index, entry in enumerate(cast("GeometricSets", block).sets):
            place = where._replace(path=("sets", index))
            found = sets.find(entry.set_name, place) if isinstance(entry.set_name, str) else None
            if found is not None:
                of_element[found.elements] = len(sections)
            sections.append(_section(context, entry, place))
    return SectionTable(tuple(sections), of_element)


def _section(context: Context, entry: GeometricSet, where: Where) -> Section:
    source, value = entry.diameter
    diameter = float(value) if isinstance(value, int | float) else math.nan
    origin = context.deck.origin
    option = next((name for name in ("flexible", "rigid", "mooring", "truss") if getattr(entry, name) is not None), "")
    unread = origin.damaged(where) or origin.damaged(where._replace(path=(*where.path, option)))
    faulty = unread or (value is not None and not diameter > 0)
    return Section(str(entry.set_name), diameter if diameter > 0 else math.nan, source, where, faulty)
