"""Values outside the range that the declaration of their field gives."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

from mudline.codes import SBD010
from mudline.diagnostics import Where
from mudline.keywords.model import Block, ListRow, Part, Rows, Slot, layout
from mudline.keywords.table import Table
from mudline.scene.context import Context


def check_ranges(context: Context) -> None:
    """Every number of `$MODEL` against the range of its field."""
    for i, section in enumerate(context.deck.sections):
        if section.name != "MODEL":
            continue
        for j, block in enumerate(section.blocks):
            if isinstance(block, Block):
                for path, message in _faults(block):
                    context.tell(SBD010, message, Where(i, j, path))


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
