"""Values of a block that its model refuses: numbers out of the range of their field, curves of too few points.

Text is read as it is, so that a check reports such a value at its place; no document holds one.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

from pydantic import BaseModel

from mudline.keywords.model import FEWEST_POINTS, FieldSpec, ListRow, Part, Rows, record_schema
from mudline.keywords.naming import is_part
from mudline.keywords.table import Table

_Path = tuple[str | int, ...]


def range_fault(value: float, slot: FieldSpec) -> str:
    """What is wrong with a number, or nothing; NaN stands for one that could not be read."""
    fault = slot.about.fault(value)
    return f"{_in_words(slot)} is {value!r}: {fault}" if fault else ""


def _in_words(slot: FieldSpec) -> str:
    """The field in words: `FRICTION=`, `water depth`, `external diameter Do`, `area of the section (A)`."""
    meaning = slot.about.meaning.partition(";")[0]
    if slot.key:
        return slot.label
    if slot.label.islower():  # words of the meaning; a symbol has capitals
        return meaning
    return f"{meaning} ({slot.label})" if " of " in meaning else f"{meaning} {slot.label}"


def is_refused(part: Part) -> bool:
    """Whether no document can hold a block that was read from text."""
    return any(True for _ in range_faults(part)) or _has_short_curve(part)


def range_faults(part: Part) -> Iterator[tuple[_Path, str]]:
    """Path and message of each value that is out of range."""
    return iter(_faults(part))


def _faults(part: Part) -> list[tuple[_Path, str]]:
    found: list[tuple[_Path, str]] = []
    for slot in ranged_slots(type(part)):
        value: Any = getattr(part, slot.name)
        kind: type[BaseModel] = type(value)
        if isinstance(value, float | int):
            if slot.about.fault(value):
                found.append(((slot.json,), range_fault(value, slot)))
        elif isinstance(value, Table):
            found += [((slot.json, *path), fault) for path, fault in _table_faults(value, slot)]
        elif isinstance(value, list):
            for index, item in enumerate(value):
                inner: type[BaseModel] = type(item)
                if is_part(inner):
                    found += [((slot.json, index, *path), fault) for path, fault in _faults(item)]
        elif is_part(kind):
            found += [((slot.json, *path), fault) for path, fault in _faults(value)]
    return found


@cache
def ranged_slots(part: type[Part]) -> tuple[FieldSpec, ...]:
    """The fields with a range, and those with parts that have one."""
    return tuple(slot for slot in record_schema(part).slots if _ranged(slot))


def _ranged(slot: FieldSpec) -> bool:
    if slot.about.limits:
        return True
    parts = [slot.row, *slot.record.values()]
    return any(ranged_slots(part) for part in parts if part and not issubclass(part, ListRow))


@cache
def _ranged_columns(row: type[Part]) -> tuple[tuple[int, FieldSpec], ...]:
    return tuple((index, column) for index, column in enumerate(record_schema(row).columns) if _ranged(column))


def _table_faults(table: Table, slot: FieldSpec) -> Iterator[tuple[tuple[int, int], str]]:
    """Row, column and message of each value of a table that is out of range."""
    for index, column in _ranged_columns(slot.row) if isinstance(slot.about, Rows) and slot.row else ():
        for row, value in enumerate(table.column(index).tolist()):
            if fault := range_fault(value, column):
                yield (row, index), fault


def _has_short_curve(part: Part) -> bool:
    schema = record_schema(type(part))
    table = schema.table
    if table is not None and isinstance(table.about, Rows) and table.about.curve:
        points = getattr(part, table.name)
        if isinstance(points, Table) and len(points) < FEWEST_POINTS:
            return True
    inner = (getattr(part, slot.name) for slot in schema.slots if slot.record)
    return any(_has_short_curve(one) for records in inner if isinstance(records, list) for one in records)
