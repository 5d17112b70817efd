"""The table of quantities is what all formats and the schema of JSON have."""

from __future__ import annotations

import json
from dataclasses import fields
from pathlib import Path

from mudline.basics.quantities import CASES, ELEMENTS, NODES
from mudline.model.results.cases import CaseSummary
from mudline.model.scene.sheet import AROUND, PIPE, RUN, WEIGHTS

ROOT = Path(__file__).parents[2]


def test_the_schema_requires_the_quantities() -> None:
    schema = json.loads((ROOT / "docs/schemas/evaluate.json").read_text(encoding="utf-8"))
    for key, quantities in (("elements", ELEMENTS), ("nodes", NODES)):
        assert schema["$defs"][key]["items"]["required"] == list(quantities)


def test_rows_of_many_decks_have_the_quantities() -> None:
    schema = json.loads((ROOT / "docs/schemas/cases.json").read_text(encoding="utf-8"))
    assert [field.name for field in fields(CaseSummary)] == list(CASES)
    assert schema["items"]["required"] == list(schema["items"]["properties"]) == list(CASES)


def test_the_schema_of_a_sheet_has_its_columns() -> None:
    schema = json.loads((ROOT / "docs/schemas/sheet.json").read_text(encoding="utf-8"))["properties"]
    columns = [column.key for column in (*RUN, *PIPE, *WEIGHTS, *AROUND)]
    for rows in (schema["unit_of"], schema["sheet"]["items"]):
        assert rows["required"] == list(rows["properties"]) == columns


def test_units_are_those_of_the_deck() -> None:
    assert [ELEMENTS["stiffness"].unit_name(units) for units in ("metric", "imperial", "user")] == [
        "N/m2",
        "lbf/ft2",
        "",
    ]
    assert ELEMENTS["depth"].axis("metric") == "embedment [m]"
    assert (ELEMENTS["slope"].axis("user"), NODES["gap"].axis("imperial")) == ("slope", "gap [ft]")
