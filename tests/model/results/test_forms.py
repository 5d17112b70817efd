"""Results written in every form, as the libraries of users read them: the same values to the last bit."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias, get_args

import numpy as np
import openpyxl
import pytest
from numpy.typing import NDArray

from mudline.basics.quantities import ELEMENTS, LINES, NODES, RESULT_FORMAT, Quantity
from mudline.cli.result_files import beside
from mudline.model.contact.arrays import Positions
from mudline.model.contact.frames import array_name
from mudline.model.contact.result import TableName
from mudline.model.results.evaluation import Evaluation, evaluate_scene
from mudline.model.results.forms import FORMS
from mudline.model.scene.model import Scene, resolve
from tests.helpers.builders.decks import CLEAN, PULLING
from tests.helpers.builders.scenes import scene_of
from tests.helpers.samples import sample
from tests.model.results.written import write

pq = pytest.importorskip("pyarrow.parquet")
pytest.importorskip("pandas")

EXTENSIONS = (
    "*SEABED FRICTION\n SET=Pipe\n COEFFICIENTS=0.5, 0.5\n STIFFNESS=1.0E5\n"
    "*SEABED SUCTION\n SET=Pipe\n COHESION=4000.0\n"
)
RIGID = CLEAN.partition("*SEABED PROPERTIES")[0] + "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"
HOSTILE = CLEAN.replace("SET=Pipe", 'SET=@1+1 "x"').replace("Clay", "+Löss <b>")

Value: TypeAlias = Any
Rows = dict[str, list[Value]]
"""The values of columns by name; None for no value."""
QUANTITIES: dict[str, dict[str, Quantity]] = {"elements": ELEMENTS, "nodes": NODES, "summary": LINES}


def moved(scene: Scene, steps: int, present: tuple[int, ...] | None = None) -> Positions:
    """A line that goes up and down by odd amounts; `present` are the indices of the nodes that have positions."""
    values = np.repeat(scene.coordinates[np.newaxis], steps, axis=0)
    values[:, :, 0] += 0.1 * np.sin(1.7 * np.arange(steps))[:, np.newaxis] / 3.0
    mask = np.ones(len(scene.node_ids), np.bool_)
    if present is not None:
        mask[:] = False
        mask[list(present)] = True
        values[:, ~mask] = np.nan
    return Positions(values, mask, np.cumsum(np.linspace(0.1, 0.7, steps)))


# ----------------------------------------------------------------------------------------------- as libraries read them


def from_csv(path: Path, table: str) -> Rows:
    file = {"elements": path, **beside(path)}[table]
    with file.open(encoding="utf-8", newline="") as stream:
        names, *rows = csv.reader(stream)
    found: Rows = {name: [row[place] for row in rows] for place, name in enumerate(names)}
    assert set(found.pop("units")) <= {"metric", "imperial"}
    return {name: [_value(text) for text in texts] for name, texts in found.items()}


def _value(text: str) -> Value:
    if text in {"", "true", "false"}:
        return {"": None, "true": True, "false": False}[text]
    try:
        return float(text)
    except ValueError:
        return text


def from_json(path: Path, table: str) -> Rows:
    held = json.loads(path.read_text(encoding="utf-8"))
    assert held["format"] == RESULT_FORMAT
    found: Rows = {}
    for step in held.get("steps", [held]):
        for row in step[table]:
            for name, value in ({"time": step["time"], **row} if "steps" in held else row).items():
                split = zip(("_x", "_y", "_z"), value, strict=True) if isinstance(value, list) else [("", value)]
                for axis, each in split:
                    found.setdefault(name + axis, []).append(each)
    return found


def from_npz(path: Path, table: str) -> Rows:
    with np.load(path, allow_pickle=False) as archive:
        arrays = dict(archive)
    assert str(arrays["format"]) == RESULT_FORMAT
    rows = len(arrays[array_name(table, next(iter(QUANTITIES[table])))])
    time = arrays.get("time")
    found: Rows = {} if time is None else {"time": np.repeat(time, rows).tolist()}
    for quantity in QUANTITIES[table].values():
        values = arrays[array_name(table, quantity.name)]
        if time is not None and not quantity.over_steps:
            values = np.broadcast_to(values, (len(time), *values.shape))
        split = {f"{quantity.name}_{axis}": values[..., i] for i, axis in enumerate("xyz")} if quantity.vector else {}
        for name, column in (split or {quantity.name: values}).items():
            found[name] = [_of_array(value, quantity) for value in column.ravel().tolist()]
    return found


def _of_array(value: Value, quantity: Quantity) -> Value:
    missing = value == "" or (isinstance(value, float) and math.isnan(value))
    return None if missing or (quantity.name.endswith("_element") and value == -1) else value


def from_parquet(path: Path, table: str) -> Rows:
    held = pq.read_table({"elements": path, **beside(path)}[table])
    assert held.schema.metadata[b"mudline.format"] == RESULT_FORMAT.encode()
    found: Rows = held.to_pydict()
    return found


def from_xlsx(path: Path, table: str) -> Rows:
    names, units, *rows = openpyxl.load_workbook(path)[table].iter_rows(values_only=True)
    assert len(units) == len(names)
    return {str(name): [row[place] for row in rows] for place, name in enumerate(names)}


READERS: dict[str, Callable[[Path, str], Rows]] = {
    "csv": from_csv,
    "json": from_json,
    "npz": from_npz,
    "parquet": from_parquet,
    "xlsx": from_xlsx,
}


def expected(evaluation: Evaluation, table: TableName) -> Rows:
    """The rows of the whole result, in one piece."""
    (part,) = evaluation.parts()
    frame = (part.result if evaluation.time is not None else part.result.step(0)).to_dataframe(table)
    return {name: [_plain(value) for value in frame[name].tolist()] for name in frame}


def _plain(value: Value) -> Value:
    return None if value is None or str(value) in {"nan", "<NA>"} else value


def bits(values: list[Any]) -> list[Any]:
    """Values as they are compared: numbers by their bits, as a form may write 1.0 as 1."""
    return [
        np.float64(value).tobytes() if isinstance(value, int | float) and not isinstance(value, bool) else value
        for value in values
    ]


def series(text: str, steps: int, present: tuple[int, ...] | None = None) -> Evaluation:
    scene = scene_of(text)
    return evaluate_scene(scene, moved(scene, steps, present), "cut" if text is PULLING else "keep")


CASES: dict[str, Callable[[], Evaluation]] = {
    "state": lambda: evaluate_scene(scene_of(CLEAN)),
    "series": lambda: series(CLEAN + EXTENSIONS, 5),
    "cut": lambda: series(PULLING, 3),
    "rigid": lambda: evaluate_scene(scene_of(RIGID)),
    "names": lambda: evaluate_scene(scene_of(HOSTILE)),
    "part": lambda: series(CLEAN, 2, (1, 2)),
    "no elements": lambda: series(CLEAN, 2, (1,)),
    "slope": lambda: evaluate_scene(resolve(sample("slope-friction.keyxm"))),
    "imperial": lambda: evaluate_scene(resolve(sample("imperial-riser.keyxi"))),
}


@pytest.mark.parametrize("case", CASES)
def test_every_form_holds_the_results(case: str, tmp_path: Path) -> None:
    evaluation = CASES[case]()
    whole = {table: expected(evaluation, table) for table in get_args(TableName)}
    assert READERS.keys() == FORMS.keys()
    for form, read in READERS.items():
        path = write(evaluation, tmp_path / f"out.{form}")
        for table, columns in whole.items():
            if form == "json" and (table == "summary" or not next(iter(columns.values()))):
                continue
            found = read(path, table)
            assert list(found) == list(columns), (form, table)
            for name, values in columns.items():
                assert bits(found[name]) == bits(values), (form, table, name)


def test_numbers_have_all_their_digits(tmp_path: Path) -> None:
    """Also in a workbook, whose library writes 16 digits."""
    odd: NDArray[np.float64] = np.array([0.1 + 0.2, 1.0 / 3.0, 1e22, 5e-324, -0.0, 123456789012345.67])
    scene = scene_of(CLEAN)
    places = np.repeat(scene.coordinates[np.newaxis], len(odd), axis=0)
    places[:, :, 1] = odd[:, np.newaxis]
    evaluation = evaluate_scene(scene, Positions(places, np.ones(3, np.bool_), np.arange(6.0)))
    for form, read in READERS.items():
        found = read(write(evaluation, tmp_path / f"out.{form}"), "nodes")["y"]
        assert bits(found) == bits(np.repeat(odd, 3).tolist()), form


@pytest.mark.parametrize("form", FORMS)
def test_the_same_results_are_the_same_bytes(form: str, tmp_path: Path) -> None:
    first, second = (write(series(CLEAN, 3), tmp_path / f"{name}.{form}").read_bytes() for name in "ab")
    assert first == second
