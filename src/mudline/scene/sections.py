"""Section properties: which `*GEOMETRIC SETS` entry an element has, and its external diameter."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from mudline.diagnostics import Where
from mudline.scene.context import Context
from mudline.scene.external import ExternalElements
from mudline.scene.numbering import Floats, Indices, Numbered
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
    """Sections in the order of the file; `of_element` (m,) is the one that each element has, -1 for none.

    `diameter` (m,) is the external diameter, NaN where there is none; `faulty` (m,) marks elements whose section could
    not be read: nothing more is said about them.
    """

    sections: tuple[Section, ...]
    of_element: Indices
    diameter: Floats
    faulty: NDArray[np.bool_]


def read_sections(
    context: Context, sets: Sets, elements: Numbered, external: ExternalElements | None = None
) -> SectionTable:
    """The sections, and the one of each element: the later entry wins, a diameter from a file over all."""
    sections: list[Section] = []
    of_element = np.full(len(elements), -1, dtype=np.intp)
    for where, block in context.deck.blocks("GEOMETRIC SETS"):
        for index, entry in enumerate(cast("GeometricSets", block).sets):
            place = where._replace(path=("sets", index))
            found = sets.find(entry.set_name, place) if isinstance(entry.set_name, str) else None
            if found is not None:
                of_element[found.elements] = len(sections)
            sections.append(_section(context, entry, place))
    diameter = np.array([*(section.diameter for section in sections), math.nan])[of_element]
    faulty = np.array([*(section.faulty for section in sections), False])[of_element]
    if external is not None:
        at = elements.indices(external.ids)
        given = ~np.isnan(external.diameter)
        diameter[at[given]] = external.diameter[given]
        faulty[at[given]] = False
    return SectionTable(tuple(sections), of_element, diameter, faulty)


def _section(context: Context, entry: GeometricSet, where: Where) -> Section:
    source, value = entry.diameter
    diameter = float(value) if isinstance(value, int | float) else math.nan
    origin = context.deck.origin
    option = next((name for name in ("flexible", "rigid", "mooring", "truss") if getattr(entry, name) is not None), "")
    unread = origin.damaged(where) or origin.damaged(where._replace(path=(*where.path, option)))
    faulty = unread or (value is not None and not diameter > 0)
    return Section(str(entry.set_name), diameter if diameter > 0 else math.nan, source, where, faulty)
