"""Values outside the range that the declaration of their field gives."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import TYPE_CHECKING, Any

from mudline.diagnostics import Code, Problem, Severity, Where
from mudline.keywords.model import Block, ListRow, Part, Rows, Slot, layout
from mudline.keywords.table import Table
from mudline.scene.checks.declaring import check

if TYPE_CHECKING:
    from mudline.scene.model import Scene

SBD010 = Code("SBD010", "negative-property", Severity.ERROR)

_GEOMETRY = "geometry"
"""A setting of `*SEABED TRENCH`, the third step of a path to its values; EXT003 says what is wrong with them."""


@check(SBD010)
def negative_property(scene: Scene) -> Iterator[Problem]:
    """A stiffness, a friction coefficient, a length or a diameter is negative, or zero where it divides.

    Such a value has no physical meaning: a sign was typed by mistake, or the value stands in the wrong field. The same
    holds for a share above 1, as the floor of CYCLIC= in *SEABED SUCTION. Correct it. Values of equations and of tables
    are looked at too. The geometry of a trench and the stiffness of unloading have rules of their own, EXT003 and
    EXT009.

    Example:
         $MODEL
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
        - FRICTION=-0.3, 0.6
        + FRICTION=0.3, 0.6

    Finds: 6:11
    """
    for i, section in enumerate(scene.deck.sections):
        if section.name != "MODEL":
            continue
        for j, block in enumerate(section.blocks):
            if isinstance(block, Block):
                for path, message in _faults(block):
                    if _GEOMETRY not in path[2:3] or block.keyword != "SEABED TRENCH":
                        yield Problem(SBD010, message, where=Where(i, j, path))


@cache
def _checked_slots(part: type[Part]) -> tuple[Slot, ...]:
    """The fields with a range, and those with parts that have one."""
    return tuple(slot for slot in layout(part).slots if _ranged(slot))


def _ranged(slot: Slot) -> bool:
    about = slot.about
    if any(limit is not None for limit in (about.at_least, about.above, about.at_most)):
        return True
    parts = [slot.row, *slot.record.values()]
    return any(_checked_slots(part) for part in parts if part and not issubclass(part, ListRow))


def _faults(part: Part) -> Iterator[tuple[tuple[str | int, ...], str]]:
    """Path and message of each value that is out of range."""
    for slot in _checked_slots(type(part)):
        value: Any = getattr(part, slot.name)
        if isinstance(value, float | int):
            if fault := _fault(value, slot):
                yield (slot.json,), fault
        elif isinstance(value, Part):
            yield from (((slot.json, *path), fault) for path, fault in _faults(value))
        elif isinstance(value, Table):
            yield from (((slot.json, *path), fault) for path, fault in _table_faults(value, slot))
        elif isinstance(value, list):
            for index, item in enumerate(value):
                if isinstance(item, Part):
                    yield from (((slot.json, index, *path), fault) for path, fault in _faults(item))


def _table_faults(table: Table, slot: Slot) -> Iterator[tuple[tuple[int, int], str]]:
    """Row, column and message of each value of a table that is out of range."""
    columns = layout(slot.row).columns if isinstance(slot.about, Rows) and slot.row else []
    for index, column in enumerate(columns):
        if not _ranged(column):
            continue
        for row, value in enumerate(table.column(index).tolist()):
            if fault := _fault(value, column):
                yield (row, index), fault


def _fault(value: float, slot: Slot) -> str:
    """What is wrong with a number, or nothing; NaN stands for one that could not be read."""
    low, above, most = slot.about.at_least, slot.about.above, slot.about.at_most
    if low is not None and value < low:
        return f"{_name(slot)} is {value!r}: it must not be less than {low:g}"
    if above is not None and value <= above:
        return f"{_name(slot)} is {value!r}: it must be greater than {above:g}"
    if most is not None and value > most:
        return f"{_name(slot)} is {value!r}: it must not be more than {most:g}"
    return ""


def _name(slot: Slot) -> str:
    """The field in words: `FRICTION=`, `water depth`, `external diameter Do`, `area of the section (A)`."""
    meaning = slot.about.meaning.partition(";")[0]
    if slot.key:
        return slot.label
    if slot.label.islower():  # words of the meaning; a symbol has capitals
        return meaning
    return f"{meaning} ({slot.label})" if " of " in meaning else f"{meaning} {slot.label}"
