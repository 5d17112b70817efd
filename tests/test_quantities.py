"""The table of quantities is what all formats and the schema of JSON have."""

from __future__ import annotations

import json
from dataclasses import fields
from pathlib import Path

import pytest

import mudline
from mudline.quantities import CASES, ELEMENTS, LINES, NODES, Quantity
from mudline.results.cases import CaseSummary
from mudline.results.evaluation import Evaluation, evaluate_scene
from mudline.scene.model import resolve
from tests.results.written import arrays_of, csv_of, json_of
from tests.samples import SAMPLES

ROOT = Path(__file__).parents[1]


def evaluated() -> Evaluation:
    return evaluate_scene(resolve(mudline.read(SAMPLES / "slope-friction.keyxm")))


def flat_names(quantities: dict[str, Quantity]) -> list[str]:
    """Names of the columns, three for a vector."""
    return [name + axis for name, each in quantities.items() for axis in (("_x", "_y", "_z") if each.vector else ("",))]


def test_all_formats_have_the_quantities_in_their_order() -> None:
    evaluation = evaluated()
    written = json_of(evaluation)
    assert csv_of(evaluation, "summary").splitlines()[0].split(",") == [*LINES, "units"]
    for key, quantities in (("elements", ELEMENTS), ("nodes", NODES)):
        assert list(written[key][0]) == list(quantities)
        assert csv_of(evaluation, key).splitlines()[0].split(",") == [*flat_names(quantities), "units"]
    of_nodes = [f"node_{name}" if name in ELEMENTS else name for name in NODES]
    of_lines = [f"summary_{name}" for name in LINES]
    assert list(arrays_of(evaluation)) == [*ELEMENTS, *of_nodes, *of_lines, "units", "format"]


def test_the_schema_requires_the_quantities() -> None:
    schema = json.loads((ROOT / "docs/schemas/evaluate.json").read_text(encoding="utf-8"))
    for key, quantities in (("elements", ELEMENTS), ("nodes", NODES)):
        assert schema["$defs"][key]["items"]["required"] == list(quantities)


def test_rows_of_many_decks_have_the_quantities() -> None:
    schema = json.loads((ROOT / "docs/schemas/cases.json").read_text(encoding="utf-8"))
    assert [field.name for field in fields(CaseSummary)] == list(CASES)
    assert schema["items"]["required"] == list(schema["items"]["properties"]) == list(CASES)


def test_units_are_those_of_the_deck() -> None:
    assert [ELEMENTS["stiffness"].unit_name(units) for units in ("metric", "imperial", "user")] == [
        "N/m2",
        "lbf/ft2",
        "",
    ]
    assert ELEMENTS["depth"].axis("metric") == "embedment [m]"
    assert (ELEMENTS["slope"].axis("user"), NODES["gap"].axis("imperial")) == ("slope", "gap [ft]")


def test_a_new_row_is_enough_for_all_formats(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(ELEMENTS, "cut", Quantity("cut", "whether a pulling curve was cut"))
    evaluation = evaluated()
    assert json_of(evaluation)["elements"][0]["cut"] is False
    assert csv_of(evaluation, "elements").splitlines()[0].endswith(",cut,units")
    assert arrays_of(evaluation)["cut"].dtype == bool
