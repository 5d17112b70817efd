"""The dynamic benchmark: its page is made from its tables, and coarse pieces of the tables come out again."""

from __future__ import annotations

from itertools import pairwise

import pytest

import mudline
from tests.benchmarks.dynamics.beam import DECKS
from tests.benchmarks.dynamics.chains import CASES
from tests.benchmarks.dynamics.page import TABLES
from tests.benchmarks.dynamics.peers import CORRECTED, LOWERED, own
from tests.benchmarks.dynamics.reference import Reference, Tolerance
from tests.benchmarks.dynamics.schemes import RUNS, TIMES, Truth, lifting, look, measure, row
from tests.benchmarks.studies.schemes import SCHEMES
from tests.benchmarks.tables import FOLDER, Row, column, inserted, load

pytestmark = pytest.mark.covered


def kept_rows(name: str) -> list[Row]:
    return load(f"benchmark-{name}")


def test_the_tables_of_the_page_are_those_of_its_files() -> None:
    text = (FOLDER / "benchmark.md").read_text(encoding="utf-8")
    assert inserted(text, TABLES) == text
    assert text.count("<!-- table ") == text.count("<!-- end -->") == len(TABLES)


def test_decks_have_no_findings_but_that_suction_softens() -> None:
    for deck in sorted(DECKS.glob("*.keyxm")):
        assert {finding.code for finding in mudline.lint(deck)} <= {"STB001", "TIM005", "GEO010"}


@pytest.mark.parametrize(("name", "steps"), [("newmark", 1), ("rk4", 4)])
def test_a_run_comes_out_as_it_is_in_the_table(name: str, steps: int) -> None:
    found = dict(zip(RUNS, row(name, steps, *measure(name, steps), Truth.of(kept_rows("path"))), strict=True))
    kept = next(
        one for one in kept_rows("schemes") if one["scheme"] == name and float(one["step [s]"]) == found["step [s]"]
    )
    for heading in ("evaluations", "tangents", "touchdown rms [m]", "peak force", "seabed work", "energy balance"):
        assert found[heading] == pytest.approx(float(kept[heading]), rel=1e-3, abs=1e-9), heading


def test_the_reference_comes_out_as_it_is_in_the_table() -> None:
    system, times, kept = lifting(), TIMES[:11], kept_rows("path")[:11]
    path = Reference(system, Tolerance(1e-6, 4e-3)).run(times)
    seen = look(system, path, times)
    assert path.events > 5
    assert seen.touchdown == pytest.approx(column(kept, "touchdown [m]"), abs=1e-5)
    assert seen.force[:, 0] == pytest.approx(column(kept, "hoist up [N]"), abs=0.05)
    assert seen.works.sum(axis=1) == pytest.approx(seen.energy, abs=1e-4)


def test_what_the_page_says_in_words_holds_in_its_tables() -> None:
    runs = {
        (one["scheme"], round(1e6 * float(one["step [s]"]))): one for one in kept_rows("schemes") if not one["failure"]
    }
    off = {run: float(one["touchdown rms [m]"]) for run, one in runs.items()}
    steps = (40000, 20000, 10000, 5000, 2500)
    damped = ("newmark", "generalised-alpha-0.5", "generalised-alpha-0", "backward-euler")
    assert all(off[one, step] < off[other, step] for one, other in pairwise(damped) for step in steps)
    assert max(float(runs["newmark", step]["energy balance"]) for step in steps) < 1e-10
    assert off["velocity-verlet", 2500] < 1.1 * off["rk4", 10000]
    assert off["velocity-verlet", 1250] < off["rk4", 5000]
    assert {name for name, _ in runs} == set(SCHEMES) - {"forward-euler"}
    assert not any(one["failure"] for one in kept_rows("schemes") if one["explicit"] == "false")


def test_a_chain_comes_out_as_it_is_in_the_table() -> None:
    case = CASES[1]
    kept = [row for row in kept_rows("chains") if row["depth [m]"] == str(case.depth)]
    for found, one in zip(own(case), kept, strict=False):
        assert found[1] == one["source"]
        assert found[2:] == pytest.approx([float(one["fairlead [kN]"]), float(one["anchor [kN]"])], rel=1e-6)


def test_what_the_page_says_of_the_chain_holds_in_its_tables() -> None:
    found = {
        (row["depth [m]"], row["source"].partition(" 2")[0]): [float(row["fairlead [kN]"]), float(row["anchor [kN]"])]
        for row in kept_rows("chains")
    }
    for depth in (str(case.depth) for case in CASES):
        assert found[depth, LOWERED] == pytest.approx(found[depth, "published"], rel=1e-3)
        assert found[depth, CORRECTED] == pytest.approx(found[depth, "mudline"], rel=5e-4)
        assert found[depth, "MoorDyn"] == pytest.approx(found[depth, "mudline"], rel=1e-4)
