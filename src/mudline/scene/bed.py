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
from mudline.scene.numbering import Floats, Indices, looked_up, one_index
from mudline.scene.surfaces import surfaces
from mudline.short_repr import short_repr

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

    def __repr__(self) -> str:
        return short_repr(self)


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

    __repr__ = short_repr

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
    position_of = np.full(len(laws.grants) + 1, len(surfaces) - 1, dtype=np.intp)
    for index in _present(laws.covered):
        where = laws.grants[index].where
        block = cast("SeabedProperties", context.deck.sections[where.section].blocks[where.block])
        position = cast("int", where.path[1])
        position_of[index] = len(values)
        values.append(_of_set(block.sets[position]))
        places.append(where._replace(path=("sets", position)))
    return Bed(values, places, looked_up(position_of, laws.covered))


def _present(covered: Indices) -> list[int]:
    """The indices that there are, without -1, in ascending order."""
    index = one_index(covered)
    if index is not None:
        return [index] * (index >= 0)
    found: list[int] = np.flatnonzero(np.bincount(covered[covered >= 0])).tolist()
    return found


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
