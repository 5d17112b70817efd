"""The dynamic benchmark: its page is made from its tables, and coarse pieces of the tables come out again."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import mudline
from mudline.study.schemes import SCHEMES
from tests.benchmarks.dynamics import page as pages
from tests.benchmarks.dynamics.beam import DECKS
from tests.benchmarks.dynamics.bouncing import TIMES, fall
from tests.benchmarks.dynamics.chains import CASES, read_chain
from tests.benchmarks.dynamics.lifting import touchdown
from tests.benchmarks.dynamics.peers import CHAINS, EXUDYN, MOORDYN, for_moordyn, own
from tests.benchmarks.dynamics.reference import Reference, Tolerance
from tests.benchmarks.dynamics.schemes import RUNS, Truth, lifting, limits, look, measure, row
from tests.benchmarks.dynamics.schemes import TIMES as MOMENTS
from tests.benchmarks.dynamics.tables import FOLDER, column, load


def test_the_page_is_made_from_its_tables() -> None:
    assert (FOLDER / "benchmark.md").read_text(encoding="utf-8") == pages.page()


def test_decks_have_no_findings_but_that_suction_softens() -> None:
    for deck in sorted(DECKS.glob("*.keyxm")):
        assert {finding.code for finding in mudline.lint(deck)} <= {"STB001"}


@pytest.mark.parametrize(("name", "steps"), [("newmark", 1), ("rk4", 4)])
def test_a_run_comes_out_as_it_is_in_the_table(name: str, steps: int) -> None:
    found = dict(zip(RUNS, row(name, steps, *measure(name, steps), Truth.of(load("path"))), strict=True))
    kept = next(one for one in load("schemes") if one["scheme"] == name and float(one["step [s]"]) == found["step [s]"])
    for heading in ("evaluations", "tangents", "touchdown rms [m]", "peak force", "seabed work", "energy balance"):
        assert found[heading] == pytest.approx(float(kept[heading]), rel=1e-3, abs=1e-9), heading


def test_the_reference_comes_out_as_it_is_in_the_table() -> None:
    system, times, kept = lifting(), MOMENTS[:11], load("path")[:11]
    path = Reference(system, Tolerance(1e-6, 4e-3)).run(times)
    seen = look(system, path, times)
    assert path.events > 5
    assert seen.touchdown == pytest.approx(column(kept, "touchdown [m]"), abs=1e-5)
    assert seen.force[:, 0] == pytest.approx(column(kept, "hoist up [N]"), abs=0.05)
    assert seen.works.sum(axis=1) == pytest.approx(seen.energy, abs=1e-4)


def test_what_the_page_says_in_words_holds_in_its_tables() -> None:
    runs = {(one["scheme"], round(1e6 * float(one["step [s]"]))): one for one in load("schemes") if not one["failure"]}
    off = {run: float(one["touchdown rms [m]"]) for run, one in runs.items()}
    steps = (40000, 20000, 10000, 5000, 2500)
    damped = ("newmark", "generalised-alpha-0.5", "generalised-alpha-0", "backward-euler")
    assert all(off[one, step] < off[other, step] for one, other in pairwise(damped) for step in steps)
    assert max(float(runs["newmark", step]["energy balance"]) for step in steps) < 1e-10
    assert off["velocity-verlet", 2500] < 1.1 * off["rk4", 10000]
    assert off["velocity-verlet", 1250] < off["rk4", 5000]
    assert {name for name, _ in runs} == set(SCHEMES) - {"forward-euler"}
    limit = {one["what"]: float(one["explicit limit [s]"]) for one in load("limits")}
    assert min(limit, key=limit.__getitem__) == "EA of the line"
    assert min((what for what in limit if "line" not in what), key=limit.__getitem__) == "suction, damping"


def test_what_limits_a_step_is_as_in_the_table() -> None:
    found = [limit[-1] for limit in limits()]
    assert found == pytest.approx(column(load("limits"), "explicit limit [s]"), rel=1e-9)


def test_a_chain_comes_out_as_it_is_in_the_table() -> None:
    case = CASES[1]
    kept = [row for row in load("chains") if row["depth [m]"] == str(case.depth) and "MoorDyn" not in row["source"]]
    for found, one in zip(own(case)[0], kept, strict=True):
        assert [str(cell) for cell in found[:4]] == [one[heading] for heading in CHAINS[:4]]
        assert found[4:] == pytest.approx([float(one[heading]) for heading in CHAINS[4:]], rel=1e-6)


def test_moordyn_gets_the_seabed_of_its_own_test() -> None:
    for case in CASES:
        given = for_moordyn(read_chain(case), case, 200.0, 1e-3)
        assert given["seabed"] == pytest.approx(1e5, rel=1e-8)
        assert (given["axial"], given["mass"], given["diameter"], given["friction"]) == (1.674e9, 390.0, 0.252, 0.5)


def test_the_bouncing_beam_comes_out_as_it_is_in_the_table() -> None:
    moments = TIMES[:36]
    beam, path = fall(Tolerance(1e-6, 4e-3), moments)
    kept = load("bouncing-path")[:36]
    first, last = path.displacements[:, 0], path.displacements[:, beam.nodes - 1]
    assert first + beam.start[0, 0] == pytest.approx(column(kept, "reference, first node [m]"), abs=1e-6)
    assert last + beam.start[-1, 0] == pytest.approx(column(kept, "last node [m]"), abs=1e-6)


def test_rows_of_other_programs_name_the_versions_that_are_installed() -> None:
    programs = {row["source"] for row in load("chains")} | {row["program"] for row in load("bouncing")}
    for peer, name in ((MOORDYN, "MoorDyn"), (EXUDYN, "Exudyn")):
        assert f"{name} {peer.requirements[0].partition('==')[2]}" in programs


def test_touchdown_is_where_the_gap_changes_sign() -> None:
    arcs = np.array([0.0, 2.0, 4.0])
    assert touchdown(np.array([-0.1, -0.1, 0.3]), arcs) == pytest.approx(2.5)
    assert touchdown(np.array([-0.1, -0.1, -0.1]), arcs) == 4.0
    assert touchdown(np.array([0.1, 0.1, 0.1]), arcs) == 0.0
