"""`mudline evaluate --against`: beside the results of another program."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from mudline.model.contact import numpy_driver
from mudline.model.contact.result import ResultPart
from mudline.model.results.against import ResultComparison
from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, assert_fits, run
from tests.cli.test_evaluate_files import STEPS
from tests.helpers.builders.decks import STEPS_WARNING

THEIRS = "element,force,stiffness\n1,1400.0,10000.0\n2,,0.0\n7,1,1\n"


def test_json_and_csv(place: Place, folder: Path) -> None:
    options = ("--against", place("Element, Ratio ,remark\n1,0.25,a\n", "other.csv"))
    outcome = run("evaluate", place(), *options, "--output-format", "json")
    found = outcome.json()
    assert_fits(found, "evaluate")
    assert [row["ratio_against"] for row in found["elements"]] == [0.25, None]
    assert found["against"] == {
        "file": "other.csv",
        "columns": [
            {
                "column": "ratio",
                "compared": 1,
                "largest_difference": {"difference": pytest.approx(-0.05), "element": 1, "time": None},
                "largest_relative": {"relative": pytest.approx(-0.2), "element": 1, "time": None},
                "rms": pytest.approx(0.05),
            }
        ],
        "elements_not_in_deck": [],
        "elements_not_in_file": [2],
        "times_not_evaluated": [],
        "times_not_in_file": [],
    }
    rows = list(csv.DictReader(run("evaluate", place(), *options, "--output-format", "csv").out.splitlines()))
    assert [row["ratio_against"] for row in rows] == ["0.25", ""]
    written = run("evaluate", place(), *options, "-o", "out.npz")
    assert "Compared with other.csv" in written.out
    with np.load(folder / "out.npz") as archive:
        assert archive["ratio_against"][0] == 0.25


def test_own_results_differ_by_nothing(place: Place) -> None:
    options = (place(), "--positions", place(STEPS, "steps.csv"))
    assert run("evaluate", *options, "-o", "own.csv").code == 0
    found = run("evaluate", *options, "--against", "own.csv", "--output-format", "json").json()["against"]
    assert [(row["column"], row["compared"], row["rms"]) for row in found["columns"]] == [
        ("force", 4, 0.0),
        ("stiffness", 4, 0.0),
        ("ratio", 4, 0.0),
    ]
    assert found["elements_not_in_file"] == found["times_not_in_file"] == []


def test_times_are_met_and_told(place: Place) -> None:
    other = place("time,element,force\n2.50001,1,900\n2.50001,2,1300\n9,1,1\n", "other.csv")
    options = (place(), "--positions", place(STEPS, "steps.csv"), "--against", other)
    outcome = run("evaluate", *options)
    assert outcome.err == (
        "mudline: 1 time of other.csv not evaluated: 9.0\nmudline: 1 evaluated time not in other.csv: 0.0\n"
        f"{STEPS_WARNING}"
    )
    assert outcome.out.splitlines()[-2].split() == ["force", "2", "-300", "2", "2.5", "-0.2308", "2", "2.5", "223.6"]
    found = run("evaluate", *options, "--output-format", "json").json()
    assert_fits(found, "evaluate")
    assert found["steps"][0]["elements"][0]["force_against"] is None
    assert found["steps"][1]["elements"][0]["force_against"] == 900.0
    assert found["against"]["times_not_evaluated"] == [9.0]


def test_the_time_of_the_largest_difference_in_a_series_of_several_parts(
    place: Place, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Steps count from the beginning of the series, not of the part that they are evaluated in."""
    monkeypatch.setattr(numpy_driver, "BLOCK", 1)
    times = (0.0, 2.5, 4.0, 7.0)
    nodes = [(node, 10.0 * (node - 1)) for node in (1, 2, 3)]
    rows = [f"{time},{node},-0.1,{y},0.0\n" for time in times for node, y in nodes]
    ours = [f"{time},1,{force}\n" for time, force in zip(times, (1500, 1500, 9000, 1500), strict=True)]
    positions = place("".join(["time,node,x,y,z\n", *rows]), "steps.csv")
    other = place("".join(["time,element,force\n", *ours]), "other.csv")
    counted: list[int] = []
    take = ResultComparison.take

    def counting(self: ResultComparison, part: ResultPart) -> None:
        counted.append(part.count)
        take(self, part)

    monkeypatch.setattr(ResultComparison, "take", counting)
    options = (place(), "--positions", positions, "--against", other, "--output-format", "json")
    [column] = run("evaluate", *options).json()["against"]["columns"]
    assert counted == [1, 1, 1, 1]
    assert column["largest_difference"]["time"] == column["largest_relative"]["time"] == 4.0


def test_elements_without_positions_are_not_compared() -> None:
    other = "o.csv"
    Path(other).write_text("time,element,force\n" + "".join(f"0,{n},1\n" for n in range(1, 201)), encoding="utf-8")
    options = ("--positions", SAMPLES / "positions.csv", "--against", other, "--output-format", "json")
    found = run("evaluate", SAMPLES / "scr-touchdown.keyxm", *options, "-q").json()["against"]
    assert found["columns"][0]["compared"] == 60
    assert len(found["times_not_in_file"]) == 7


@pytest.mark.parametrize(
    ("text", "place_", "message"),
    [
        ("", "1:1", "the header lacks element"),
        ("element,depth\n1,2\n", "1:1", "the header has none of force, stiffness, ratio"),
        ("element,force\n", "2:1", "no row below the header"),
        ("element,force\n1,2\n2, abc\n", "3:4", "force: 'abc' is not a number"),
        ("element,force\n1.5,2\n", "2:1", "element: 1.5 is not a whole number"),
        ("element,force\n1,2\n2,3\n1,4\n", "4:1", "element 1 is given twice"),
        ("time,element,force\n0,1,2\n0,1,3\n", "3:3", "element 1 is given twice at time 0"),
        ("time,element,force\n0,1,2\n1,1,3\n", "1:1", "several times, to compare with one state"),
        ("element,force\n1,2,3\n", "2:1", "3 fields, the header has 2"),
    ],
)
def test_fault_in_the_file(place: Place, text: str, place_: str, message: str) -> None:
    outcome = run("evaluate", place(), "--against", place(text, "o.csv"))
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.err.startswith(f"o.csv:{place_}: error: DAT001 {message}")


def test_series_need_times(place: Place) -> None:
    options = (place(), "--positions", place(STEPS, "steps.csv"), "--against")
    outcome = run("evaluate", *options, place(THEIRS, "o.csv"))
    assert (outcome.code, "no column time, to compare with 2 time steps" in outcome.err) == (1, True)
    outcome = run("evaluate", *options, place("time,element,force\n7,1,2\n", "o.csv"))
    assert (outcome.code, "none of its times is evaluated: these are from 0.0 to 2.5" in outcome.err) == (1, True)
