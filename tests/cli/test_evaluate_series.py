"""`mudline evaluate --summary-only`: the extremes of all steps, also after any stop."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mudline.cli import evaluate_series
from mudline.contact.result import Part
from mudline.results.evaluation import Evaluation
from mudline.results.forms import form_names
from tests.builders.decks import CLEAN
from tests.cli.conftest import Place
from tests.cli.runner import assert_fits, run
from tests.cli.test_evaluate_states import BOTH, RIGID

STEPS = 700
DECKS = {"without history": CLEAN, "with history": BOTH, "rigid": RIGID}
TIMED = ("--positions", "long.npy", "--time-step", "0.25")
GIVEN = ("deck.keyxm", *TIMED, "--summary-only")


@pytest.fixture
def long(folder: Path) -> Path:
    """A series of 700 steps, which are eleven batches; the last node is in the air."""
    rng = np.random.default_rng(18)
    steps = np.zeros((STEPS, 3, 3))
    steps[:, :, 0] = 0.15 * np.sin(0.05 * np.arange(STEPS))[:, np.newaxis] + 0.01 * rng.normal(size=(STEPS, 3))
    steps[:, :, 1] = [0.0, 10.0, 20.0]
    steps[:, :, 2] = 0.02 * rng.normal(size=(STEPS, 3))
    steps[:, 2, 0] += 0.3
    np.save(folder / "long.npy", steps)
    return folder / "long.npy"


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.name.startswith("out")}


def stop_after(monkeypatch: pytest.MonkeyPatch, parts: int) -> None:
    """Ctrl-C after so many parts of the run; each of them is followed by a checkpoint."""
    monkeypatch.setattr(evaluate_series, "SAVED_EVERY", 0.0)
    resumed = Evaluation.resumed

    def stopped(evaluation: Evaluation, *given: object) -> Iterator[tuple[Part, Any]]:
        parts_of_run = resumed(evaluation, *given)  # type: ignore[arg-type] # handed on as they are
        for number, part in enumerate(parts_of_run):
            if number == parts:
                raise KeyboardInterrupt
            yield part

    monkeypatch.setattr(Evaluation, "resumed", stopped)


# ------------------------------------------------------------------------------------------------- what it holds


@pytest.mark.usefixtures("long")
@pytest.mark.parametrize("deck", DECKS.values(), ids=DECKS)
def test_extremes_are_those_of_all_results(place: Place, folder: Path, deck: str) -> None:
    place(deck)
    assert run("evaluate", "deck.keyxm", *TIMED, "-q", "-o", "whole.npz").code == 0
    assert run("evaluate", *GIVEN, "-q", "-o", "out.npz").code == 0
    with np.load(folder / "whole.npz") as whole, np.load(folder / "out.npz") as found:
        assert str(found["format"]) == "mudline-series/1"
        for table, prefix, names in (
            ("elements", "", ("force", "depth", "stiffness")),
            ("nodes", "", ("gap", "normal_force", "axial_force", "lateral_force")),
            (
                "summary",
                "summary_",
                ("first_touchdown", "contact_length", "largest_force", "largest_uplift", "reaction"),
            ),
        ):
            for name in names:
                values = whole[prefix + name]
                for side, best, at in (("least", np.fmin, np.nanargmin), ("largest", np.fmax, np.nanargmax)):
                    expected = best.reduce(values, axis=0)
                    assert np.array_equal(found[f"{table}_{name}_{side}"], expected, equal_nan=True)
                    for row in np.flatnonzero(~np.isnan(expected)):
                        step = at(values[:, row])
                        assert found[f"{table}_{name}_{side}_step"][row] == step
                        assert found[f"{table}_{name}_{side}_time"][row] == 0.25 * step
        assert found["elements_contact_steps"].tolist() == whole["contact"].sum(axis=0).tolist()
        assert found["summary_touchdown_steps"].tolist() == (whole["summary_touchdown_points"] > 0).sum(axis=0).tolist()
        slips = (whole["axial_state"] == "slip") | (whole["lateral_state"] == "slip")
        assert found["nodes_slip_steps"].tolist() == np.broadcast_to(slips, (STEPS, 3)).sum(axis=0).tolist()
        held = np.isin(np.broadcast_to(whole["state"], (STEPS, 2)), ("suction", "hold"))
        assert found["elements_suction_steps"].tolist() == held.sum(axis=0).tolist()
        assert found["totals_largest"][0] == whole["normal_force"].sum(axis=1).max()


@pytest.mark.usefixtures("long")
def test_forms_hold_the_same(place: Place, folder: Path) -> None:
    place(BOTH)
    for form in form_names():
        assert run("evaluate", *GIVEN, "-q", "-o", f"out.{form}").code == 0
    found = json.loads((folder / "out.json").read_text(encoding="utf-8"))
    assert_fits(found, "series")
    assert run("evaluate", *GIVEN, "-q", "--output-format", "json").json() == found
    tables = ("elements", "nodes", "summary", "totals")
    csv = [(folder / f"out{'' if each == 'elements' else '-' + each}.csv").read_bytes() for each in tables]
    for table, text in zip(tables[:3], csv, strict=False):
        assert run("evaluate", *GIVEN, "-q", "--output-format", "csv", "--table", table).output == text
    with np.load(folder / "out.npz") as arrays:
        for table, text in zip(tables, csv, strict=True):
            heading, *rows = text.decode().splitlines()
            assert heading.split(",")[:-1] == list(found[table][0])
            assert len(rows) == len(found[table])
            for name in found[table][0]:
                values = [row[name] for row in found[table]]
                stored = arrays[f"{table}_{name}"].tolist()
                if name.endswith(("step", "element")):
                    values = [-1 if value is None else value for value in values]
                assert stored == pytest.approx([np.nan if value is None else value for value in values], nan_ok=True)
    pq = pytest.importorskip("pyarrow.parquet")
    for table in tables:
        name = f"out{'' if table == 'elements' else '-' + table}.parquet"
        assert pq.read_table(folder / name).to_pylist() == found[table]
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.load_workbook(folder / "out.xlsx")
    assert book.sheetnames == list(tables)
    head, _, first, *_ = book["elements"].iter_rows(values_only=True)
    assert dict(zip(head, first, strict=True)) == found["elements"][0]


@pytest.mark.usefixtures("long")
def test_terminal_shows_what_a_whole_run_does(place: Place) -> None:
    place(BOTH)
    whole = run("evaluate", "deck.keyxm", *TIMED)
    outcome = run("evaluate", *GIVEN)
    assert (outcome.code, outcome.err) == (whole.code, whole.err)
    shown = outcome.out.splitlines()
    assert shown[0] == "Contact of deck.keyxm (metric units), 700 steps"
    assert "\n".join(shown[1:]).strip() == whole.out[whole.out.index("Over all steps") :].strip()


# ------------------------------------------------------------------------------------------------------------- stops


@pytest.mark.usefixtures("long")
@pytest.mark.parametrize("deck", [CLEAN, BOTH])
@pytest.mark.parametrize("form", form_names())
def test_a_stopped_run_goes_on(
    place: Place, folder: Path, monkeypatch: pytest.MonkeyPatch, deck: str, form: str
) -> None:
    output = f"out.{form}"
    place(deck)
    assert run("evaluate", *GIVEN, "-q", "-o", output).code == 0
    whole = files(folder)
    for name in whole:
        (folder / name).unlink()
    with monkeypatch.context() as patched:
        for parts in (5, 2):
            stop_after(patched, parts)
            assert run("evaluate", *GIVEN, "-o", output).code == 130
            assert list(files(folder)) == [f"{output}.unfinished"]
    outcome = run("evaluate", *GIVEN, "-o", output)
    assert outcome.code == 0
    assert f"goes on at step 448 of 700: {output}.unfinished\n" in outcome.err
    assert files(folder) == whole


# ------------------------------------------------------------------------------------------------------ what is refused


@pytest.mark.parametrize("change", ["the positions", "the deck", "an option", "damage"])
def test_state_of_another_run_is_refused(
    place: Place, long: Path, monkeypatch: pytest.MonkeyPatch, folder: Path, change: str
) -> None:
    place()
    with monkeypatch.context() as patched:
        stop_after(patched, 3)
        assert run("evaluate", *GIVEN, "-o", "out.json").code == 130
    unfinished = folder / "out.json.unfinished"
    options: tuple[str, ...] = ()
    what = f"is the state of another run: {change} changed"
    if change == "the positions":
        positions = np.load(long)
        np.save(long, positions[:-1])
    elif change == "the deck":
        place(CLEAN.replace("1000.0", "1001.0"))
    elif change == "an option":
        options = ("--tension", "cut")
    else:
        data = bytearray(unfinished.read_bytes())
        data[-30] ^= 1
        unfinished.write_bytes(data)
        what = "is damaged, or not the state of an unfinished run"
    kept = unfinished.read_bytes()
    outcome = run("evaluate", *GIVEN, *options, "-o", "out.json")
    assert outcome.code != 0
    assert f"out.json.unfinished {what}. Delete it, or begin again with --no-cache" in outcome.err
    assert unfinished.read_bytes() == kept
    outcome = run("evaluate", *GIVEN, *options, "-o", "out.json", "--no-cache")
    assert (outcome.code, "goes on" in outcome.err) == (0, False)
    assert list(files(folder)) == ["out.json"]


@pytest.mark.usefixtures("eager")
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_fault_in_a_late_step_names_it(place: Place, long: Path, folder: Path, jobs: str) -> None:
    positions = np.load(long)
    positions[690, 1, 2] = np.nan
    positions[699, 0, 0] = np.inf
    np.save(long, positions)
    place()
    outcome = run("evaluate", *GIVEN, "-o", "out.json", "--jobs", jobs, "--chunk", "64")
    assert (outcome.code, files(folder)) == (1, {})
    assert "node 2 at step 690: its position" in outcome.err


@pytest.mark.parametrize("how", ["shorter", "changed", "cut off"])
def test_a_file_that_changes_while_it_is_read(
    place: Place, long: Path, monkeypatch: pytest.MonkeyPatch, folder: Path, how: str
) -> None:
    place()
    resumed = Evaluation.resumed

    def changing(evaluation: Evaluation, *given: object) -> Iterator[tuple[Part, Any]]:
        parts_of_run = resumed(evaluation, *given)  # type: ignore[arg-type] # handed on as they are
        for number, part in enumerate(parts_of_run):
            if number == 2:
                data = long.read_bytes()
                long.write_bytes(data[: len(data) // 3] if how == "shorter" else data)
                os.utime(long, ns=(0, 10**15))
            yield part

    if how == "cut off":
        long.write_bytes(long.read_bytes()[:-100])
    else:
        monkeypatch.setattr(Evaluation, "resumed", changing)
    outcome = run("evaluate", *GIVEN, "-o", "out.json")
    assert (outcome.code != 0, files(folder)) == (True, {})
    assert ("not an NPY array" if how == "cut off" else "changed while it was read: wait until it is") in outcome.err


@pytest.mark.usefixtures("long")
@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--summary-only",), "--summary-only is for time steps: give a series with --positions"),
        (("--summary-only", "--positions", "state.npy"), "--summary-only is for time steps: state.npy holds one state"),
        ((*TIMED, "--summary-only", "--plot", "a.png"), "--plot is not for --summary-only: leave one of them out"),
        ((*TIMED, "--chunk", "8"), "--chunk is for --summary-only: add it"),
        (("deck.keyxm", "other.keyxm", "--summary-only"), "--summary-only is for one deck: give a single file"),
    ],
)
def test_options_that_do_not_fit(place: Place, folder: Path, options: tuple[str, ...], message: str) -> None:
    np.save(folder / "state.npy", np.zeros((3, 3)))
    outcome = run("evaluate", place(), *options)
    assert (outcome.code, outcome.out) == (2, "")
    assert message in outcome.err


@pytest.mark.usefixtures("long")
def test_bar_on_a_terminal(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.cli.view.DELAY", 0.0)
    monkeypatch.delenv("CI", raising=False)
    place()
    assert "/700" in run("evaluate", *GIVEN, "-o", "out.json", terminal=True).err
    assert "/700" not in run("evaluate", *GIVEN, "-o", "out.json").err
