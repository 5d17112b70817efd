"""What the seabed gives elements besides their normal law: friction, lateral resistance, suction; both families."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.diagnostics import Where
from mudline.scene.context import Context
from mudline.scene.given import number
from mudline.scene.laws import LawTable
from mudline.scene.numbering import Floats, Indices
from mudline.scene.surfaces import surfaces

if TYPE_CHECKING:
    from mudline.keywords.library.seabed_properties import SeabedProperties, SeabedSet
    from mudline.keywords.model import Part

_UNKNOWN = float("nan")


class BedValues(NamedTuple):
    """The values of one place of the deck, NaN for what it does not give.

    Friction coefficients, mobilisation lengths, largest characteristic lengths and friction stiffnesses are those of
    the longitudinal, then of the transverse direction.
    """

    friction: tuple[float, float] = (_UNKNOWN, _UNKNOWN)
    mobilisation: tuple[float, float] = (_UNKNOWN, _UNKNOWN)
    characteristic: tuple[float, float] = (_UNKNOWN, _UNKNOWN)
    constant: float = _UNKNOWN
    friction_stiffness: tuple[float, float] = (_UNKNOWN, _UNKNOWN)
    lateral: float = _UNKNOWN
    suction: float = _UNKNOWN
    extent: float = _UNKNOWN


NOTHING = BedValues()


@dataclass(frozen=True, slots=True)
class Bed:
    """The values of elements (m,) or (m, 2), NaN where the deck gives none, in the deck's units.

    `values` and `places` list what the deck gives and where; `of_element` (m,) is the index of each element in them,
    -1 for elements without any.
    """

    values: Sequence[BedValues]
    places: Sequence[Where]
    of_element: Indices

    def column(self, name: str) -> Floats:
        """One of the fields of `BedValues` for all elements: (m,), or (m, 2) for those of two directions."""
        table = np.array([getattr(entry, name) for entry in (*self.values, NOTHING)], dtype=np.float64)
        found: Floats = table[self.of_element]
        return found


def read_bed(context: Context, laws: LawTable) -> Bed:
    """The last block of `*SEABED PROPERTIES` that holds an element, taken whole; else the legacy surface."""
    surfaces = list(_surfaces(context))
    values = [entry for _, entry in surfaces]
    places = [where for where, _ in surfaces]
    of_element = np.full(len(laws.covered), len(surfaces) - 1, dtype=np.intp)
    for index in np.flatnonzero(np.bincount(laws.covered[laws.covered >= 0])).tolist():
        where = laws.grants[index].where
        block = cast("SeabedProperties", context.deck.sections[where.section].blocks[where.block])
        position = cast("int", where.path[1])
        of_element[laws.covered == index] = len(values)
        values.append(_of_set(block.sets[position]))
        places.append(where._replace(path=("sets", position)))
    return Bed(values, places, of_element)


def _two(part: Part | None, name: str) -> tuple[float, float]:
    return number(part, f"longitudinal{name}"), number(part, f"transverse{name}")


def _of_set(entry: SeabedSet) -> BedValues:
    return BedValues(
        friction=_two(entry.friction, ""),
        mobilisation=_two(entry.friction, "_mobilisation"),
        constant=number(entry.friction, "constant"),
        friction_stiffness=_two(entry.friction, "_stiffness"),
        lateral=number(entry, "lateral"),
        suction=number(entry.suction, "stiffness"),
        extent=number(entry.suction, "extent"),
    )


def _surfaces(context: Context) -> Iterator[tuple[Where, BedValues]]:
    for where, surface in surfaces(context.deck):
        properties = surface.properties
        yield (
            where._replace(path=("properties",)),
            BedValues(
                friction=_two(properties, ""),
                mobilisation=_two(properties, "_mobilisation"),
                characteristic=_two(properties, "_length"),
                constant=number(properties, "constant"),
                lateral=number(properties, "lateral"),
                suction=number(properties, "suction_stiffness"),
                extent=number(properties, "suction_extent"),
            ),
        )
