"""`mudline study`: its screen, JSON, CSV, picture and options, and `mudline.study`."""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path

import pytest

import mudline
from tests.cli.runner import ROOT, SAMPLES, run
from tests.tools.touchdown_study.decks import WAVES, Riser

jsonschema = pytest.importorskip("jsonschema")


SCHEMA = ROOT / "docs" / "schemas" / "study.json"


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    path = tmp_path / "riser.keyxm"
    path.write_text(Riser(elements=100, loads=WAVES.replace("0.2, 20.0", "0.5, 20.0")).text(), encoding="utf-8")
    return path


def test_the_screen_the_json_and_the_picture_of_a_deck(deck: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    outcome = run("study", deck, "-o", tmp_path / "s.json", "--plot", tmp_path / "s.svg")
    assert outcome.code == 0
    lines = outcome.out.splitlines()
    assert lines[0].startswith("The deck's own step, 500 ms (line ")
    assert max(map(len, lines)) <= 110
    assert len(lines) <= 55
    for words in (
        "Touchdown zone laid down and lifted: ",
        "Errors of the time step",
        "Stiff and extreme: 500 ms",
        "What the deck needs",
    ):
        assert words in outcome.out
    found = json.loads((tmp_path / "s.json").read_text(encoding="utf-8"))
    jsonschema.validate(found, json.loads(SCHEMA.read_text(encoding="utf-8")))
    assert found["advice"]["own_step"] == 0.5
    assert (tmp_path / "s.svg").read_bytes().startswith(b"<?xml")


@pytest.mark.parametrize("name", ["flowline-gen.keyxm", "scr-soil.keyxm"])
def test_json_of_a_deck_without_a_touchdown_zone_keeps_to_its_schema(name: str) -> None:
    found = run("study", SAMPLES / name, "--output-format", "json").json()
    jsonschema.validate(found, json.loads(SCHEMA.read_text(encoding="utf-8")))
    assert (found["format"], found["model"]) == ("mudline-study/2", None)


def test_csv_has_a_table_for_each_part(deck: Path) -> None:
    outcome = run("study", deck, "--output-format", "csv")
    tables = [list(csv.DictReader(io.StringIO(part))) for part in outcome.out.split("\n\n")]
    assert [next(iter(rows[0])) for rows in tables] == ["step", "case", "stage"]
    assert [row["own"] for row in tables[0]] == ["true", "false", "false", "false"]
    assert float(tables[0][0]["touchdown_from"]) < float(tables[0][0]["touchdown_to"])


def test_the_motion_of_the_top_may_be_given(deck: Path) -> None:
    outcome = run("study", deck, "--only", "accuracy", "--heave", "2.5", "--period", "9", "--output-format", "json")
    model = outcome.json()["model"]
    assert (model["heave"], model["surge"], model["period"]) == (2.5, 0.0, 9.0)


def test_the_empty_weight_stands_beside_that_with_contents(tmp_path: Path) -> None:
    masses = "*MASS\n 20, 500.0\n"
    (tmp_path / "riser.keyxm").write_text(
        Riser(elements=50, loads=f"*INTERNAL FLUID\n SET=ALL\n 800.0, 820.0, 0.0\n{WAVES}", model=masses).text(),
        "utf-8",
    )
    steel, inside, outside = (math.pi / 4.0 * area for area in (0.3239**2 - 0.2827**2, 0.2827**2, 0.3239**2))
    empty = 9.81 * (7850.0 * steel - 1025.0 * outside)
    filled = empty + 9.81 * 820.0 * inside
    outcome = run("study", tmp_path / "riser.keyxm", "--only", "accuracy", "-o", tmp_path / "study.json")
    text = " ".join(outcome.out.split())
    assert f"Submerged weight {filled:.4g} N/m with contents, {empty:.4g} N/m empty (weights without *MASS)." in text
    found = json.loads((tmp_path / "study.json").read_text(encoding="utf-8"))
    weights = {"with_contents": pytest.approx(filled), "empty": pytest.approx(empty), "without": ["*MASS"]}
    assert found["submerged_weight"] == weights
    assert found["model"]["weight"] == pytest.approx(filled)


def test_a_refused_deck_names_the_cause_as_evaluate_does(deck: Path) -> None:
    text = deck.read_text(encoding="utf-8")
    assert "*SEABED STIFFNESS" in text
    deck.write_text(text.replace("*SEABED STIFFNESS", "*SEABED STIFNESS"), encoding="utf-8")
    outcome = run("study", deck)
    assert (outcome.code, outcome.out) == (1, "")
    assert "SYN009 keyword *SEABED STIFNESS is not known" in outcome.err
    assert outcome.err == run("evaluate", deck).err


def test_the_function_has_arrays_and_a_plot(deck: Path) -> None:
    plt = pytest.importorskip("matplotlib.pyplot")
    found = mudline.study(mudline.read(deck), only=["accuracy"])
    assert found.time_steps.tolist() == [0.5, 0.25, 0.125]
    assert found.errors.shape == (3, 3)
    _, axes = plt.subplots()
    assert found.plot(axes) is axes
    plt.close("all")


def test_evaluate_at_rest(deck: Path) -> None:
    outcome = run("evaluate", deck, "--rest-shape", "--output-format", "json")
    assert outcome.json()["positions"] == "rest shape"
    assert outcome.err.startswith("mudline: resting shape of line 1: horizontal tension ")
    both = run("evaluate", deck, "--rest-shape", "--positions", "x.csv")
    assert both.code == 2


def test_evaluate_names_the_resting_shape_where_the_deck_is_far_from_one(deck: Path) -> None:
    first = run("evaluate", deck).err.splitlines()[0]
    assert "--rest-shape" in first
    near = run("evaluate", SAMPLES / "scr-touchdown.keyxm").err
    assert "--rest-shape" not in near


def test_batch_at_rest(deck: Path, tmp_path: Path) -> None:
    outcome = run("batch", deck, SAMPLES / "scr-soil.keyxm", "--rest-shape", "-o", tmp_path / "out", "--form", "csv")
    assert outcome.code == 1
    assert "no resting shape: no held end" in outcome.out
    assert (tmp_path / "out").is_dir()
