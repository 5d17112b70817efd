"""Inputs of a deck next to its lines of pipe: water, conditions, waves, current, vessels and times, with units."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import Any

from mudline.basics.quantities import labelled, shown
from mudline.language.codes.contact import SBD025
from mudline.language.deck.model import Opaque
from mudline.language.diagnostics import Problem, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.format import unit_text
from mudline.language.keywords.model import Block, FieldSpec, ListRow, Part, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.writer import field_text
from mudline.model.scene.model import Scene

_MODEL = ("OCEAN", "MASS", "DRAG CHAIN", "NODE SPRING")
"""Keywords of `$MODEL` that are inputs, in addition to those of vessels."""
_MOST = 12
"""Rows of a table, and parts of a block, that are written out."""


def inputs_of(scene: Scene) -> list[dict[str, Any]]:
    """Return a row for each input: its section or load case, keyword, values as a text, and place in its file."""
    rows = []
    cases = [index for index, section in enumerate(scene.deck.sections) if section.name == "LOAD CASE"]
    for index, section in enumerate(scene.deck.sections):
        if section.name not in ("MODEL", "LOAD CASE"):
            continue
        name = "$MODEL" if section.name == "MODEL" else "$LOAD CASE"
        name += f" {cases.index(index) + 1}" if index in cases and len(cases) > 1 else ""
        for number, block in enumerate(section.blocks):
            if section.name == "LOAD CASE" or block.keyword in _MODEL or _is_of_vessel(section.name, block.keyword):
                (place,) = scene.deck.diagnose([Problem(SBD025, "", where=Where(index, number))])
                values = "; ".join(filter(None, values_in_words(block, scene.units)))
                row = {"section": name, "keyword": block.keyword, "values": values}
                rows.append(row | {"file": place.file, "line": place.line})
    return rows


def _is_of_vessel(section: str, keyword: str) -> bool:
    return any(entry.subject == "vessels" for entry in catalogue.entries(keyword) if section in entry.sections)


def values_in_words(part: Part, units: str, without: Collection[str] = ()) -> Iterator[str]:
    """Yield the values of a block or part in words, with labels and units; unread lines are unchanged.

    `without` are fields that are left out, by their names in JSON.
    """
    if isinstance(part, Opaque):
        yield from _not_read(part.lines)
        return
    for slot in record_schema(type(part)).slots:
        value = None if slot.json in without else getattr(part, slot.name)
        if isinstance(value, Table):
            yield f"{slot.label}: {_table(slot, value, units)}"
        elif isinstance(value, ListRow):  # its values mean different things, as the deck writes them
            given = [getattr(value, own.name) for own in record_schema(type(value)).slots]
            yield slot.label + ", ".join(field_text(each) for each in given if each is not None)
        elif isinstance(value, Part):
            yield (slot.label if slot.key else "") + ", ".join(values_in_words(value, units))
        elif isinstance(value, list):
            texts = [", ".join(values_in_words(each, units)) for each in value[:_MOST] if isinstance(each, Part)]
            yield from texts if isinstance(part, Block) else (f"({text})" for text in texts)
            yield from [f"{len(value) - _MOST} more"] if len(value) > _MOST else []
        elif value is not None:
            yield f"{slot.label}{'' if slot.key else ' '}{_value(value, _unit(slot, units, part))}"
    yield from _not_read([line.text for line in getattr(part, "unread", ())])


def _not_read(lines: Sequence[str]) -> Iterator[str]:
    data = [line.strip() for line in lines if line.strip() and not line.startswith("C ")]
    if data:
        yield f"not read: {' / '.join(data[:_MOST])}" + (f", {len(data) - _MOST} more" if len(data) > _MOST else "")


def _value(value: object, unit: str) -> str:
    text = shown(value) if isinstance(value, float) else str(value)
    return f"{text} {unit}" if unit and isinstance(value, float | int) else text


def _unit(slot: FieldSpec, units: str, part: Part | None = None) -> str:
    """Return the unit of a field in a part, or of a column."""
    rotates = getattr(part, "dof", 0) in (4, 5, 6) or getattr(part, "type_", None) == "ROTARY INERTIA"
    dimension = (slot.about.written_in or (slot.about.unit,))[-1 if rotates else 0].strip("-")
    return unit_text(dimension, units) if dimension and units != "user" else ""


def _table(slot: FieldSpec, table: Table, units: str) -> str:
    """Return the columns of a table with their units, and its first rows."""
    columns = record_schema(slot.row).slots if slot.row else ()
    heads = ", ".join(labelled(column.label, _unit(column, units)) for column in columns[: table.values.shape[1]])
    rows = [", ".join(shown(value) for value in row) for row in table.values[:_MOST].tolist()]
    more = f", {len(table) - _MOST} more" if len(table) > _MOST else ""
    return f"{heads}: {' / '.join(rows)}{more}"
