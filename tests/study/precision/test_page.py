"""The page of the precision study: what it says for other decks, and its numbers computed again from the CSV files."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from statistics import linear_regression

import pytest

from mudline.study import SAMPLE_NAME, precision
from mudline.study.pages import Tables, command_of
from mudline.study.precision.page import advice, page
from mudline.study.report import StudyOptions, StudyReport
from mudline.study.schemes import SCHEMES
from tests.builders.scenes import legal_scene

DOCS = Path(__file__).parents[3] / "docs" / "studies"


def tables_of(report: StudyReport) -> Tables:
    return Tables({table.name: "".join(table.csv()) for table in report.tables})


def read(name: str) -> list[dict[str, str]]:
    with (DOCS / f"precision-{name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_the_page_of_the_sample_with_a_short_ladder(sample_report: StudyReport) -> None:
    assert sample_report.advice == (
        "On this deck, for errors of 1 % no step of the ladder is small enough, because of the mass dropped on Soft "
        "Clay (deck line 32); for errors of 0.1 % no step of the ladder is small enough."
    )
    assert "| drop-curve | dropped on Soft Clay | 32 |" in sample_report.page
    assert "64 runs meet the seabed" in sample_report.page


@pytest.mark.usefixtures("short")
def test_the_page_of_a_deck_without_a_law() -> None:
    text = "$MODEL\n*NODE\n 1, 0.0, 0.0, 0.0\n 2, 0.0, 1.0, 0.0\n*ELEMENT\n 1, 1, 2\n"
    report = precision.run(legal_scene(text), StudyOptions())
    assert report.advice == ""
    assert "The deck has no normal law with a stiffness" in report.page
    assert "The deck has no curve." in report.page
    assert "pull-drag.png" not in report.page


def test_the_advice_names_scheme_step_and_line() -> None:
    words = advice(Tables.read(DOCS, "precision"))
    first = read("advice")[0]
    assert words.startswith(f"On this deck, for errors of 1 % use {first['scheme']} with a step of ")
    assert f"(deck line {first['deck line']})" in words
    step = float(words.split("with a step of ")[1].split(" ms")[0]) / 1e3
    assert 0.99 * float(first["step [s]"]) < step <= float(first["step [s]"])


def test_no_advised_step_is_above_the_critical_one_of_the_stability_study() -> None:
    """Both pages of the documentation are on the same deck."""
    with (DOCS / "stability-contacts.csv").open(encoding="utf-8", newline="") as file:
        contacts = list(csv.DictReader(file))
    names = {"central-difference": "central difference", "velocity-verlet": "velocity Verlet", "rk4": "RK4"}
    rows = {(row["goal [relative]"], row["scheme"]): row for row in read("advice")}
    for scheme, title in names.items():
        critical = min(float(row[f"critical step, {scheme} [s]"]) for row in contacts)
        for goal in ("0.01", "0.001"):
            row = rows[goal, title]
            assert float(row["step [s]"]) <= critical * (1.0 + 1e-12)
            assert (row["limited by"], row["set by"]) == ("stability", "suction damping on Clay")
    words = advice(Tables.read(DOCS, "precision"))
    assert (
        "The best explicit scheme for 1 % and 0.1 % is central difference with a step of 309 us, because of suction "
        "damping on Clay (deck line 43)." in words
    )


def test_goals_are_those_of_the_steps() -> None:
    """The largest step up to which all errors are small, without the code of the study."""
    quantities = [name for name in read("steps")[0] if name.startswith("error of")]
    assert len(quantities) == 3
    steps = read("steps")
    for row in read("goals"):
        mine = [one for one in steps if (one["case"], SCHEMES[one["scheme"]].title) == (row["case"], row["scheme"])]
        mine.sort(key=lambda one: float(one["omega dt"]))
        for goal in ("0.01", "0.001", "0.0001"):
            good = [all(one[name] and float(one[name]) <= float(goal) for name in quantities) for one in mine]
            count = good.index(False) if False in good else len(good)
            assert row[f"omega dt for {goal}"] == (mine[count - 1]["omega dt"] if count else "")
        small = [one for one in mine if float(one["omega dt"]) <= 0.1 and one["failed runs"] == "0"]
        x = [math.log(float(one["omega dt"])) for one in small]
        y = [math.log(max(float(one[name]) for name in quantities)) for one in small]
        if len(small) > 1:
            assert float(row["order"]) == pytest.approx(linear_regression(x, y).slope)
        else:
            assert row["order"] == ""


def test_work_and_run_times_of_the_steps() -> None:
    omegas = {row["case"]: float(row["omega [1/s]"]) for row in read("cases")}
    for row in read("steps"):
        period = 2.0 * math.pi / omegas[row["case"]]
        work = float(row["force evaluations per period [-]"])
        assert work == pytest.approx(float(row["force evaluations [1/s]"]) * period)
        stages = {"rk4": 4.0}.get(row["scheme"], 1.0) if row["Newton iterations per step"] == "0.0" else None
        per_step = stages or 1.0 + float(row["Newton iterations per step"])
        if row["failed runs"] == "0":
            assert work == pytest.approx(per_step * 2.0 * math.pi / float(row["omega dt"]))
        quartiles = row["lower quartile of run time [s/s]"], row["upper quartile of run time [s/s]"]
        if int(row["repeats"]) >= 5:
            assert 0.0 < float(quartiles[0]) <= float(row["run time [s/s]"]) <= float(quartiles[1])
        else:
            assert quartiles == ("", "")
    assert page(Tables.read(DOCS, "precision"))


def test_a_page_shows_the_command_that_makes_it() -> None:
    assert command_of("precision", SAMPLE_NAME) == "mudline study precision -o docs/studies"
    assert command_of("stability", "steep riser.keyxm") == "mudline study stability 'steep riser.keyxm' -o DIR"
