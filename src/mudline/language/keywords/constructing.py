"""Models of blocks in which something could not be read: what was read, and `UNKNOWN` for the rest."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from itertools import chain
from typing import Any

from mudline.language.keywords.model import FieldSpec, ListRow, Part, record_schema
from mudline.language.keywords.parsed import ParsedRecord
from mudline.language.keywords.text import Value
from mudline.language.keywords.unknown import UNKNOWN, UNKNOWN_NAME, Partly, is_unknown


def lose(built: ParsedRecord, positions: Sequence[int]) -> None:
    """Take note that lines of a record, or of those inside it, could not be used."""
    built.unsure = True
    inner = sorted(chain.from_iterable(built.children.values()), key=lambda child: child.first)
    firsts = [child.first for child in inner]
    of_child: dict[int, list[int]] = {}
    for position in positions:
        of_child.setdefault(bisect_right(firsts, position) - 1, []).append(position)
    for child in inner[bisect_right(firsts, min(positions)) :]:  # a line above it may be that of its name
        for slot in record_schema(child.part).slots[:1]:
            if slot.key:
                child.values.setdefault(slot.json, UNKNOWN)
    for index, inside in of_child.items():
        if index >= 0:
            lose(inner[index], inside)


def construct(built: ParsedRecord) -> Part:
    """A model without validation, for a block in which something could not be read.

    What is missing is None; it is unknown where it must not be missing, or a line that could not be used may have it.
    """
    ready: dict[str, Any] = {}
    for slot in record_schema(built.part).slots:
        given = _known(slot, built.values.get(slot.json))
        if slot.record:
            inner = [construct(child) for child in built.children.get(slot.json, [])]
            ready[slot.name] = Partly(inner) if built.unsure else inner
        elif slot.json not in built.values:
            unknown = slot.required or (built.unsure and slot is not record_schema(built.part).table)
            ready[slot.name] = _known(slot, UNKNOWN) if unknown else None
        elif slot.row and isinstance(given, list):
            columns = record_schema(slot.row).columns
            ready[slot.name] = _bare(slot.row, {c.json: v for c, v in zip(columns, given, strict=False)})
        elif slot.row and isinstance(given, dict):
            ready[slot.name] = _bare(slot.row, given)
        else:
            ready[slot.name] = given
    ready["comments"] = []
    if "keyword" in built.values:
        ready["keyword"] = built.values["keyword"]
    return built.part.model_construct(_given(ready), **ready)


def _bare(row: type[Part], values: dict[str, Value]) -> Part:
    """A row as it was read."""
    ready = {slot.name: _known(slot, values.get(slot.json)) for slot in record_schema(row).columns}
    return row.model_construct(None if issubclass(row, ListRow) else _given(ready), **ready)


def _given(fields: dict[str, Any]) -> set[str]:
    """The names of the fields that are known: what is not is not written."""
    return {name for name, value in fields.items() if not is_unknown(value)}


def _known(slot: FieldSpec, value: object) -> Any:
    """A value of a field, or what stands for one that could not be read."""
    return UNKNOWN_NAME if value is UNKNOWN and slot.is_text else value
