"""Inputs of a deck next to its lines of pipe, with units: water, conditions, waves, current, vessels, times, and laws.

It also lists deductions in the declarations of a deck's keywords: statements that no public page makes.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import Any

import numpy as np

from mudline.basics.quantities import finite, labelled, shown
from mudline.basics.units import UNITS
from mudline.language.deck.model import Deck, Opaque
from mudline.language.diagnostics import Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.model import Block, FieldSpec, ListRow, Part, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.writer import field_text
from mudline.language.syntax.tree import data_lines
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Mask

_MODEL = ("OCEAN", "MASS", "DRAG CHAIN", "NODE SPRING")
"""Keywords of `$MODEL` that are inputs, in addition to those of vessels."""
_MOST = 12
"""Rows of a table, and parts of a block, that are written out."""


def inputs_of(scene: Scene) -> list[dict[str, Any]]:
    """Return a row for each input: its section or load case, keyword, values as a text, and place in its file."""
    rows = []
    cases = [index for index, section in enumerate(scene.deck.sections) if section.name == "LOAD CASE"]
    for where, section, block in scene.deck.every_block():
        subjects = (entry.subject for entry in catalogue.entries(block.keyword) if section in entry.sections)
        of_model = section == "MODEL" and (block.keyword in _MODEL or "vessels" in subjects)
        if of_model or where.section in cases:
            number = f" {cases.index(where.section) + 1}" if len(cases) > 1 and not of_model else ""
            values = "; ".join(filter(None, values_in_words(block, scene.units)))
            row = {"section": f"${section}{number}", "keyword": block.keyword, "values": values}
            rows.append(row | _place(scene, where))
    return rows


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
    if data := data_lines(lines):
        yield f"not read: {' / '.join(data[:_MOST])}" + (f", {len(data) - _MOST} more" if len(data) > _MOST else "")


def _value(value: object, unit: str) -> str:
    text = shown(value) if isinstance(value, float) else str(value)
    return f"{text} {unit}" if unit and isinstance(value, float | int) else text


def _unit(slot: FieldSpec, units: str, part: Part | None = None) -> str:
    """Return the unit of a field in a part, or of a column."""
    rotates = getattr(part, "dof", 0) in (4, 5, 6) or getattr(part, "type_", None) == "ROTARY INERTIA"
    dimension = (slot.about.written_in or (slot.about.unit,))[-1 if rotates else 0]
    return UNITS[units].unit(dimension)


def _table(slot: FieldSpec, table: Table, units: str) -> str:
    """Return the columns of a table with their units, and its first rows."""
    columns = record_schema(slot.row).slots if slot.row else ()
    heads = ", ".join(labelled(column.label, _unit(column, units)) for column in columns[: table.values.shape[1]])
    rows = [", ".join(shown(value) for value in row) for row in table.values[:_MOST].tolist()]
    more = f", {len(table) - _MOST} more" if len(table) > _MOST else ""
    return f"{heads}: {' / '.join(rows)}{more}"


# ----------------------------------------------------------------------------------------------------------------- laws


def laws_of(scene: Scene) -> Iterator[dict[str, Any]]:
    """Yield the law of each set of elements, resistances and laws of extension keywords, with values in words."""
    keeps_it = scene.replacing < 0  # other elements have nodal springs or soil
    stiffness_unit = UNITS[scene.units].behind("F/L2")
    for index, grant in enumerate(scene.laws.set_laws):
        values: dict[str, Any] = {} if np.isnan(grant.stiffness) else {"stiffness": finite(grant.stiffness)}
        words = f"stiffness {shown(grant.stiffness)}{stiffness_unit}" if values else ""
        follow = (scene.laws.of_element == index) & keeps_it
        law = _law(scene, scene.law_name(grant), grant.set_.name, follow, grant.where)
        yield law | {"values": values, "words": words}
    for index, (resistance, where) in enumerate(zip(scene.resistance.values, scene.resistance.places, strict=True)):
        values = {key.replace("_", " "): read for key, value in resistance._asdict().items() if (read := _given(value))}
        part = scene.deck.at(where)
        if values:
            words = "; ".join(values_in_words(part, scene.units, ("set", "stiffness")))
            name: str | None = getattr(part, "set_name", None)
            law = _law(scene, "resistance", name, scene.resistance.of_element == index, where)
            yield law | {"values": values, "words": words}
    for keyword, extension in scene.extensions.items():
        for index, (record, where) in enumerate(zip(extension.entries, extension.places, strict=True)):
            values = record.model_dump(mode="json", by_alias=True, exclude_none=True, exclude_defaults=True)
            of_set = values.pop("set", None)
            words = "; ".join(values_in_words(record, scene.units, ("set",)))
            law = _law(scene, f"*{keyword}", of_set, extension.of_element == index, where)
            yield law | {"values": values, "words": words}


def _law(scene: Scene, law: str, set_name: str | None, follow: Mask, where: Where) -> dict[str, Any]:
    name = set_name or "ALL"
    known = scene.set_table.find(name)
    counts = {"elements": int(follow.sum()), "open": known is not None and known.open}
    return {"law": law, "set": name} | counts | _place(scene, where)


def _place(scene: Scene, where: Where) -> dict[str, Any]:
    """Return the file and the line of a block or a record."""
    base = scene.deck.base_of(where)
    return {"file": base[0].file if base else scene.deck.file, "line": scene.line_of(where)}


def _given(value: Any) -> Any:  # noqa: ANN401 - a number, or one for each direction
    """Return the value that the deck gives, or None."""
    if isinstance(value, tuple):
        numbers = [finite(float(component)) for component in value]
        return None if all(number is None for number in numbers) else numbers
    return finite(float(value))


# ----------------------------------------------------------------------------------------------------------- deductions


def inferences(deck: Deck) -> list[dict[str, Any]]:
    """Return each deduction once, with its keyword, its fields, and the number of blocks with these fields."""
    deductions: dict[tuple[str, str], tuple[list[str], int]] = {}
    for _, section, block in deck.alone.every_block():
        touched: dict[str, list[str]] = {}
        for label, text in _of_block(section, block):
            touched.setdefault(text, []).append(label)
        for text, labels in touched.items():
            known, count = deductions.get((block.keyword, text), ([], 0))
            deductions[block.keyword, text] = list(dict.fromkeys([*known, *labels])), count + 1
    return [
        {"keyword": keyword, "fields": [label for label in labels if label], "inferred": text, "blocks": count}
        for (keyword, text), (labels, count) in deductions.items()
    ]


def _of_block(section: str, block: Part | Opaque) -> Iterator[tuple[str, str]]:
    """Yield the name of each field with a deduction, and the deduction."""
    if isinstance(block, Opaque):
        kept = catalogue.opaque_keyword(section, block.keyword)
        if kept is not None and kept.inferred:
            yield "", kept.inferred
        return
    for _, slot, value in block.walk():
        if slot.about.inferred:
            yield slot.label, slot.about.inferred
        if isinstance(value, Table):  # rows of a table are alike: its columns are enough
            columns = record_schema(slot.row).slots if slot.row else ()
            yield from ((column.label, column.about.inferred) for column in columns if column.about.inferred)
