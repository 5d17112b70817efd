"""`mudline batch`: a row for each deck, worst first, and the options."""

from __future__ import annotations

import csv
import io
import json
import multiprocessing
import os
from pathlib import Path

import numpy as np
import pytest

from mudline.cli import batch_run, processes
from mudline.cli.cases import Done, Order, failed
from mudline.quantities import CASES
from tests.builders.decks import BAD_NUMBER, CLEAN, PULLING
from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, Json, assert_fits, run

DEEP = CLEAN.replace("-0.1,", "-0.2,")
"""Twice as deep as CLEAN: twice the force."""
HIGH = CLEAN.replace("-0.1,", "0.1,")
"""Nothing is in contact."""
STATE = "node,x,y,z\n1,-0.3,0,0\n2,-0.3,10,0\n3,0.3,20,0\n"


@pytest.fixture
def eager(monkeypatch: pytest.MonkeyPatch) -> None:
    """Processes are used behind the first deck, whatever there is to do."""
    monkeypatch.setattr(processes, "PAYS", dict.fromkeys(processes.PAYS, 0.0))
    monkeypatch.setattr(batch_run, "TRIED", 0.0)


@pytest.fixture
def four(place: Place) -> str:
    for name, text in {"a": HIGH, "b": CLEAN, "c": BAD_NUMBER, "d": DEEP}.items():
        place(text, f"decks/{name}.keyxm")
    return "decks"


def rows(*arguments: str | Path, code: int = 0) -> Json:
    """The rows of a run in JSON, by the names of the decks; their order is kept."""
    outcome = run("batch", *arguments, "-o", "out", "--output-format", "json")
    assert outcome.code == code, outcome.err
    found = outcome.json()
    assert_fits(found, "cases")
    return {Path(row["deck"]).stem: row for row in found}


# ----------------------------------------------------------------------------------------------------------- rows


def test_failed_decks_come_first_then_the_largest_force(four: str) -> None:
    outcome = run("batch", four, "-o", "out")
    assert outcome.code == 1
    lines = outcome.out.splitlines()
    assert lines[0] == "Contact of 4 decks in decks"
    table = lines[lines.index(next(line for line in lines if line.startswith("──"))) + 1 :]
    assert [line[:7] for line in table[:4]] == ["c.keyxm", "d.keyxm", "b.keyxm", "a.keyxm"]
    assert table[0].startswith("c.keyxm  failed: line 6: SYN002 'ten' is not a number: ")
    assert lines[-1] == "4 decks: 3 evaluated, 3 with warnings, 1 failed"
    assert "Traceback" not in outcome.err


def test_row_has_what_is_worst(four: str) -> None:
    found = rows(four, code=1)
    one = run("evaluate", "decks/d.keyxm", "--output-format", "json").json()
    element, line = one["elements"][0], one["summary"][0]
    row = found["d"]
    assert (row["deck"], row["verdict"], row["reason"]) == ("decks/d.keyxm", "evaluated", None)
    assert (row["steps"], row["elements"], row["in_contact"], row["positions"]) == (1, 2, 1, "deck")
    assert (row["largest_force"], row["largest_force_element"]) == (element["force"], element["element"])
    assert row["touchdown_from"] == row["touchdown_to"] == line["touchdown"][0]["arc_length"]
    assert [row[name] for name in ("contact_length", "reaction", "ratio")] == [
        line[name] for name in ("contact_length", "reaction", "ratio")
    ]
    assert row["warnings"] == len(one["warnings"])
    assert row["warning_codes"].split() == sorted({each["code"] for each in one["warnings"]})
    assert (found["a"]["largest_force"], found["a"]["touchdown_from"], found["a"]["in_contact"]) == (None, None, 0)
    failed = {name: value for name, value in found["c"].items() if value is not None}
    assert set(failed) == {"deck", "verdict", "reason"}


def test_csv_has_the_columns_of_json(four: str) -> None:
    outcome = run("batch", four, "--output-format", "csv", "-o", "out")
    table = list(csv.DictReader(io.StringIO(outcome.out)))
    assert list(table[0]) == list(CASES)
    assert [row["deck"][-7:-6] for row in table] == ["c", "d", "b", "a"]
    assert float(table[1]["largest_force"]) == rows(four, code=1)["d"]["largest_force"]


def test_series_and_pulls(place: Place, folder: Path) -> None:
    place(PULLING, "decks/pulling.keyxm")
    place(CLEAN, "decks/clean.keyxm")
    steps = np.array([[[-down, 0.0, 0.0], [-down, 10.0, 0.0], [0.3, 20.0, 0.0]] for down in (0.1, 0.3, 0.2)])
    np.savez(folder / "steps.npz", positions=steps, time=np.array([0.0, 0.5, 1.0]))
    found = rows("decks", "--positions", "steps.npz")
    pulled, pushed = found["pulling"], found["clean"]
    assert (pulled["steps"], pulled["positions"]) == (3, "file")
    assert (pushed["largest_force"], pushed["largest_force_time"], pushed["largest_uplift"]) == (3500.0, 0.5, None)
    assert pulled["largest_uplift"] < 0.0
    assert (pulled["largest_uplift_element"], pulled["largest_uplift_time"]) == (1, 0.0)
    assert pushed["touchdown_from"] < pushed["touchdown_to"]
    shown = run("batch", "decks", "--positions", "steps.npz", "-q", "-o", "out").out
    assert "steps" in shown
    assert "uplift" in shown


def test_units_that_differ_are_shown_and_compared() -> None:
    found = run("batch", SAMPLES / "imperial-riser.keyxi", SAMPLES / "scr-touchdown.keyxm", "-q", "-o", "out")
    lines = found.out.splitlines()
    assert [line.split()[:2] for line in lines[-4:-2]] == [
        ["scr-touchdown.keyxm", "metric"],
        ["imperial-riser.keyxi", "imperial"],
    ]
    assert "[" not in found.out


def test_decks_after_expand() -> None:
    assert run("expand", "-q", SAMPLES / "variations.keyxm", "-o", "waves").code == 0
    found = run("batch", "waves", "-o", "results", "--form", "npz", "--output-format", "json")
    assert found.code == 0
    assert len(found.json()) == 6
    expected = {f"{row['deck'].removeprefix('waves/').removesuffix('.keyxm')}.npz" for row in found.json()}
    assert {path.relative_to("results").as_posix() for path in Path("results").rglob("*.npz")} == expected
    assert "Near/Wave 08s.npz" in expected


def test_only_the_first_of_many_rows_are_listed(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.cli.cases.MOST_ROWS", 2)
    for name in "abc":
        place(CLEAN, f"decks/{name}.keyxm")
    assert "1 more deck: -v shows all\n" in run("batch", "decks", "-o", "out").out
    assert "more deck" not in run("batch", "decks", "-v", "-o", "out").out


def test_narrow_terminal_leaves_columns_out(four: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "70")
    outcome = run("batch", four, "--color", "never", "-o", "out", terminal=True)
    lines = outcome.out.splitlines()
    assert all(len(line) <= 70 for line in lines)
    assert "left out on a narrow terminal: in contact" in outcome.out


# ------------------------------------------------------------------------------------------------------- exit codes


def test_warnings_fail_only_when_that_is_asked_for(place: Place) -> None:
    arguments = ("batch", "-o", "out", place(CLEAN, "a.keyxm"), place(CLEAN, "b.keyxm"))
    assert run(*arguments).code == 0
    outcome = run(*arguments, "--fail-on", "warning")
    assert outcome.code == 1
    assert outcome.err.count("RUN003") == 1
    assert "(1 more deck)\n" in outcome.err


def test_path_that_is_missing_has_a_row(place: Place) -> None:
    found = run("batch", place(), "nowhere.keyxm", "--output-format", "json", "-o", "out")
    assert found.code == 2
    assert [(row["deck"], row["reason"]) for row in found.json()] == [
        ("nowhere.keyxm", "no such file or directory"),
        ("deck.keyxm", None),
    ]


def test_deck_that_is_given_twice_has_one_row(place: Place) -> None:
    found = run("batch", place(), "./deck.keyxm", ".", "--output-format", "json", "-o", "out", "--form", "json").json()
    assert [(row["deck"], row["result"]) for row in found] == [("deck.keyxm", "deck.json")]
    assert_fits(json.loads(Path("out/deck.json").read_bytes()), "evaluate")


def test_folder_without_a_deck(folder: Path) -> None:
    (folder / "empty").mkdir()
    outcome = run("batch", "empty", "-o", "results")
    assert (outcome.code, outcome.out) == (2, "")
    assert "no deck in this directory" in outcome.err
    assert not (folder / "results").exists()


def test_gitignore_hides_decks(four: str, folder: Path) -> None:
    (folder / ".git").mkdir()
    (folder / ".gitignore").write_text("c.keyxm\n", encoding="utf-8")
    assert set(rows(four)) == {"a", "b", "d"}
    assert set(rows(four, "--no-gitignore", code=1)) == {"a", "b", "c", "d"}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-"], "- is one deck, from standard input: use mudline evaluate"),
        (["--positions", "{case}.csv"], "--positions: {case} is unknown: use {name} or {folder}"),
        (["--positions", "{name.csv"], "--positions {name.csv: not a pattern: expected '}' before end of string"),
        (["--positions", "nowhere.csv"], "nowhere.csv: no such file or directory"),
        (["--time-step", "0"], "--time-step is 0.0: it must be greater than 0"),
        (["-o", "decks/a.keyxm"], "decks/a.keyxm: cannot be created: file exists"),
    ],
)
def test_options_that_do_not_fit_several_decks(four: str, arguments: list[str], message: str) -> None:
    outcome = run("batch", four, "-o", "out", *arguments)
    assert (outcome.code, outcome.out) == (2, "")
    assert f"mudline: {message}" in outcome.err


# -------------------------------------------------------------------------------------------------------- positions


def test_positions_from_one_file(place: Place, folder: Path) -> None:
    (folder / "all.csv").write_text(STATE, encoding="utf-8")
    for name in "ab":
        place(CLEAN, f"decks/{name}.keyxm")
    assert [row["largest_force"] for row in rows("decks", "--positions", "all.csv").values()] == [3500.0] * 2


@pytest.mark.parametrize("given", ["{folder}/{name}.csv", "at/{name}.csv", "at"])
def test_positions_by_name(place: Place, folder: Path, given: str) -> None:
    for name in "ab":
        place(CLEAN, f"decks/{name}.keyxm")
    where = folder / ("decks" if "{folder}" in given else "at")
    where.mkdir(exist_ok=True)
    (where / "a.csv").write_text(STATE, encoding="utf-8")
    found = rows("decks", "--positions", given, code=1)
    assert found["a"]["largest_force"] == 3500.0
    assert found["b"]["reason"].startswith("its positions were not found: ")


def test_folder_of_positions_is_as_that_of_the_decks(place: Place, folder: Path) -> None:
    for where, depth in {"near": "-0.3", "far": "-0.2"}.items():
        place(CLEAN, f"decks/{where}/case.keyxm")
        (folder / "at" / where).mkdir(parents=True)
        (folder / "at" / where / "case.csv").write_text(STATE.replace("-0.3", depth), encoding="utf-8")
    found = run("batch", "decks", "--positions", "at", "--output-format", "json", "-o", "out").json()
    assert [(row["deck"], row["largest_force"]) for row in found] == [
        ("decks/near/case.keyxm", 3500.0),
        ("decks/far/case.keyxm", 2500.0),
    ]
    (folder / "at" / "far" / "case.npz").touch()
    message = "several files of positions: at/far/case.csv, at/far/case.npz"
    assert rows("decks/far", "decks/near", "--positions", "at", code=1)["case"]["reason"] in (message, None)


def test_bad_positions_name_their_file(place: Place, folder: Path) -> None:
    (folder / "all.csv").write_text(STATE + "9,0,0,0\n", encoding="utf-8")
    found = rows(place(CLEAN, "a.keyxm"), place(CLEAN, "b.keyxm"), "--positions", "all.csv", code=1)
    assert found["a"]["reason"] == "all.csv:5: DAT001 node 9 is not defined in the deck"


# -------------------------------------------------------------------------------------------------------- processes


@pytest.mark.usefixtures("eager")
def test_output_is_the_same_whatever_the_number_of_processes(four: str, place: Place, folder: Path) -> None:
    for number in range(8):
        place((CLEAN, BAD_NUMBER, DEEP)[number % 3], f"{four}/more/{number}.keyxm")
    outcomes = []
    for jobs in ("1", "2"):
        outcome = run("batch", four, "--jobs", jobs, "-o", f"out{jobs}", "--form", "csv", "--output-format", "json")
        written = {
            path.relative_to(f"out{jobs}").as_posix(): path.read_bytes()
            for path in sorted(Path(f"out{jobs}").rglob("*"))
            if path.is_file()
        }
        outcomes.append((outcome.code, outcome.out, outcome.err.replace(f"out{jobs}", "out"), written))
    assert outcomes[0] == outcomes[1]
    assert multiprocessing.active_children() == []
    assert len(outcomes[0][3]) == 3 * 8 + 2
    assert not list(folder.rglob("*.mudline"))


@pytest.mark.usefixtures("eager")
def test_interrupted_run_ends_its_processes(four: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object) -> None:
        if multiprocessing.active_children():
            raise KeyboardInterrupt

    monkeypatch.setattr(batch_run, "_remember", interrupt)
    outcome = run("batch", four, "--jobs", "2", "-o", "out", "--form", "csv")
    assert (outcome.code, outcome.out) == (130, "")
    assert multiprocessing.active_children() == []
    assert not list(folder.rglob("*.mudline"))
    assert not Path("out/summary.csv").exists()


def end(order: Order) -> Done:
    """A worker that dies."""
    os._exit(len(order.data))


@pytest.mark.usefixtures("eager")
def test_process_that_dies_is_reported(four: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(batch_run, "_done", lambda task: Done(failed(task.case.file.name, "skipped")))
    monkeypatch.setattr(batch_run, "evaluate_case", end)
    outcome = run("batch", four, "--jobs", "2", "-o", "out")
    assert outcome.code == 2
    assert "a process that evaluated decks has ended early" in outcome.err
