"""Values of a block that its model refuses: numbers out of the range of their field, curves of too few points.

They are read from text unchanged, so that a check reports them at their place; documents with them are refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache

from mudline.language.keywords.model import FEWEST_POINTS, FieldSpec, Part, Path, Rows, fields_of, record_schema
from mudline.language.keywords.table import Table


def range_fault(value: float, slot: FieldSpec) -> str:
    """Return the fault of a number that is out of range, or ""; NaN, which stands for an unreadable value, has none."""
    fault = slot.about.fault(value)
    return f"{in_words(slot)} is {value!r}: {fault}" if fault else ""


def in_words(slot: FieldSpec) -> str:
    """Return the field in words: `FRICTION=`, `water depth`, `external diameter Do`, `area of the section (A)`."""
    meaning = re.split("[;,]", slot.about.meaning)[0]
    if slot.key:
        return slot.label
    if slot.label.islower():  # a word; symbols have capitals
        return meaning
    return f"{meaning} ({slot.label})" if " of " in meaning else f"{meaning} {slot.label}"


def is_refused(part: Part) -> bool:
    """Return True if a block that was read from text cannot be written as a document."""
    return (
        any(True for _ in range_faults(part))
        or any(len(curve) < FEWEST_POINTS for _, _, curve in part.walk(_is_curve))
        or any(isinstance(value, int) and range_fault(value, slot) for _, slot, value in part.walk(_is_ranged_in_list))
    )


def range_faults(part: Part) -> Iterator[tuple[Path, str]]:
    """Yield path and message of each value that is out of range."""
    for path, slot, value in part.walk(_is_ranged):
        if isinstance(value, Table):
            yield from (((*path, *cell), fault) for cell, fault in _table_faults(value, slot))
        elif isinstance(value, float | int) and (fault := range_fault(value, slot)):
            yield path, fault


def _is_ranged(slot: FieldSpec) -> bool:
    """Return True for a field with a range, except those of GEN=, and for a table with a ranged column."""
    if isinstance(slot.about, Rows):
        return bool(_ranged_columns(slot.row))
    return bool(slot.about.limits) and not slot.of_list


def _is_ranged_in_list(slot: FieldSpec) -> bool:
    """Return True for a field of a GEN= that has a range."""
    return bool(slot.about.limits) and slot.of_list


@cache
def ranged_slots(part: type[Part]) -> tuple[FieldSpec, ...]:
    """Return the ranged fields of a part and of its inner parts."""
    return tuple(slot for slot in fields_of(part) if slot.about.limits and not slot.of_list)


@cache
def _ranged_columns(row: type[Part] | None) -> tuple[tuple[int, FieldSpec], ...]:
    columns = record_schema(row).columns if row else ()
    return tuple((index, column) for index, column in enumerate(columns) if column.about.limits)


def _table_faults(table: Table, slot: FieldSpec) -> Iterator[tuple[tuple[int, int], str]]:
    """Yield row, column and message of each value of a table that is out of range."""
    for index, column in _ranged_columns(slot.row):
        for row, value in enumerate(table.column(index).tolist()):
            if fault := range_fault(value, column):
                yield (row, index), fault


def _is_curve(slot: FieldSpec) -> bool:
    return isinstance(slot.about, Rows) and bool(slot.about.curve)
