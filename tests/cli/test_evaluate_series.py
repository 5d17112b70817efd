"""`mudline evaluate --summary-only`: the extremes of all steps."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from mudline.model.results.forms import FORMS
from tests.cli.conftest import Place
from tests.cli.runner import assert_fits, run
from tests.cli.test_evaluate_states import BOTH, RIGID
from tests.helpers.builders.decks import CLEAN

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
        total = np.nan if deck == RIGID else whole["normal_force"].sum(axis=1).max()  # of a constraint it is not known
        np.testing.assert_equal(found["totals_largest"][0], total)


@pytest.mark.usefixtures("long")
def test_forms_hold_the_same(place: Place, folder: Path) -> None:
    place(BOTH)
    for form in FORMS:
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


# ------------------------------------------------------------------------------------------------------ what is refused


@pytest.mark.usefixtures("long")
def test_terminal_shows_what_a_whole_run_does(place: Place) -> None:
    place(BOTH)
    whole = run("evaluate", "deck.keyxm", *TIMED)
    outcome = run("evaluate", *GIVEN)
    assert (outcome.code, outcome.err) == (whole.code, whole.err)
    shown = outcome.out.splitlines()
    assert shown[0] == "Contact of deck.keyxm (metric units), 700 steps"
    assert "\n".join(shown[1:]).strip() == whole.out[whole.out.index("Over all steps") :].strip()


@pytest.mark.usefixtures("long")
def test_a_plot_of_a_summary_is_refused(place: Place) -> None:
    outcome = run("evaluate", place(), *TIMED, "--summary-only", "--plot", "a.png")
    assert (outcome.code, outcome.out) == (2, "")
    assert "--plot is not for --summary-only: leave one of them out" in outcome.err


@pytest.mark.parametrize("positions", [(), ("--positions", "state.npy")])
def test_one_state_is_a_series_of_one_step(place: Place, folder: Path, positions: tuple[str, ...]) -> None:
    np.save(folder / "state.npy", np.array([[-0.1, 0.0, 0.0], [-0.1, 10.0, 0.0], [-0.1, 20.0, 0.0]]))
    given = ("evaluate", place(), *positions)
    assert run(*given, "--summary-only").out == run(*given).out
    state = run(*given, "--output-format", "json").json()
    summary = run(*given, "--summary-only", "--output-format", "json").json()
    assert_fits(summary, "series")
    assert (summary["steps"], summary["positions"]) == (1, state["positions"])
    assert "time" not in summary["totals"][0]
    for side in ("least", "largest"):
        assert [row[f"force_{side}"] for row in summary["elements"]] == [row["force"] for row in state["elements"]]


# ----------------------------------------------- touchdown of lines, and their least and largest figures over all steps


BOUNDED = CLEAN + "*SEABED PLANES\n PLANE=Shelf\n POINT=0.0, 0.0, 0.0\n SLOPE=0.0\n BOUNDS=-5.0, 15.0, -5.0, 5.0\n"
LAID = "node,x,y,z\n1,-0.1,0.0,0.0\n2,-0.1,10.0,0.0\n3,-0.1,20.0,0.0\n"


def apart(elements: int) -> str:
    """A deck of elements of which no two share a node."""
    nodes = "".join(f" {node + 1}, -0.1, {10.0 * node}, 0.0\n" for node in range(2 * elements))
    rows = "".join(f" {row + 1}, {2 * row + 1}, {2 * row + 2}\n" for row in range(elements))
    return f"$MODEL\n*NODE\n{nodes}*ELEMENT\n{rows}*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=1000.0\n"


def heaved(elements: int, *heights: float) -> str:
    rows = [
        f"{time},{node + 1},{height},{10.0 * node},0.0\n"
        for time, height in enumerate(heights)
        for node in range(2 * elements)
    ]
    return "time,node,x,y,z\n" + "".join(rows)


def test_a_line_is_all_on_the_seabed_only_where_all_of_it_is(place: Place) -> None:
    positions = ("--positions", place(LAID, "laid.csv"), "--table", "summary", "-q")
    assert "all on the seabed     20.008" in run("evaluate", place(CLEAN), *positions).out
    edge = run("evaluate", place(BOUNDED, "bounded.keyxm"), *positions).out
    assert edge.splitlines()[5].split()[:5] == ["1", "1", "to", "2", "10"], "where it leaves the seabed is not known"


def test_figures_of_many_lines_are_cut_unless_all_are_asked_for(place: Place) -> None:
    command = ("evaluate", place(apart(20)), "--positions", place(heaved(20, -0.1, -0.2), "heave.csv"), "-q")
    tables = run(*command).out.partition("Lines over all steps")[2]
    assert tables.count("total reaction") == 13
    assert "20 more rows: -v shows all" in tables
    assert run(*command, "-v").out.partition("Lines over all steps")[2].count("total reaction") == 20


def test_the_first_of_several_touchdown_points_is_called_so(place: Place) -> None:
    steps = [(0, 0.1, -0.3), (1, 0.1, -0.4)]
    sags = [f"{time},1,{up},0,0\n{time},2,{low},10,0\n{time},3,{up},20,0\n" for time, up, low in steps]
    both = "time,node,x,y,z\n" + "".join(sags)
    tables = run("evaluate", place(CLEAN), "--positions", place(both, "sag.csv"), "-q").out
    figures = [row[:22].strip() for row in tables.partition("Lines over all steps")[2].splitlines()[4:] if row]
    assert figures[:2] == ["first touchdown point", "last touchdown point"]


def test_a_summary_of_steps_ends_with_the_figures_over_all_of_them(place: Place) -> None:
    command = ("evaluate", place(apart(1)), "--positions", place(heaved(1, -0.1, -0.2), "heave.csv"), "-q")
    figures = run(*command).out.partition("Lines over all steps")[2]
    assert run(*command, "--table", "summary").out.partition("Lines over all steps")[2] == figures != ""
