"""The dynamic benchmark: its page is made from its tables, and coarse pieces of the tables come out again."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import mudline
from mudline.model.contact.arrays import FloatArray
from tests.benchmarks.dynamics.beam import DECKS
from tests.benchmarks.dynamics.bouncing import TIMES, fall
from tests.benchmarks.dynamics.chains import CASES
from tests.benchmarks.dynamics.limits import EXPLICIT, limits
from tests.benchmarks.dynamics.page import TABLES
from tests.benchmarks.dynamics.peers import CHAINS, CORRECTED, LOWERED, PULLED, REST, own
from tests.benchmarks.dynamics.reference import Reference, Tolerance
from tests.benchmarks.dynamics.schemes import RUNS, Truth, lifting, look, measure, row
from tests.benchmarks.dynamics.schemes import TIMES as MOMENTS
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


@pytest.mark.alike
@pytest.mark.parametrize(("name", "steps"), [("newmark", 1), ("rk4", 4)])
def test_a_run_comes_out_as_it_is_in_the_table(name: str, steps: int) -> None:
    found = dict(zip(RUNS, row(name, steps, *measure(name, steps), Truth.of(kept_rows("path"))), strict=True))
    kept = next(
        one for one in kept_rows("schemes") if one["scheme"] == name and float(one["step [s]"]) == found["step [s]"]
    )
    for heading in ("evaluations", "tangents", "touchdown rms [m]", "peak force", "seabed work", "energy balance"):
        assert found[heading] == pytest.approx(float(kept[heading]), rel=1e-3, abs=1e-9), heading


@pytest.mark.nightly
def test_the_reference_comes_out_as_it_is_in_the_table() -> None:
    system, times, kept = lifting(), MOMENTS[:11], kept_rows("path")[:11]
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
    rows = {one["what"]: one for one in kept_rows("limits")}
    for scheme in EXPLICIT:
        limit = {what: float(one[f"{scheme} [s]"]) for what, one in rows.items()}
        if scheme not in {"rk2", "forward-euler"}:  # these have none on springs that nothing damps
            assert min((what for what in limit if "line" not in what), key=limit.__getitem__) == "suction, damping"
        failed = {
            float(one["step [s]"]): bool(one["failure"]) for one in kept_rows("schemes") if one["scheme"] == scheme
        }
        assert failed == {step: step > limit["EA of the line"] for step in failed}
    assert not any(one["failure"] for one in kept_rows("schemes") if one["explicit"] == "false")


def test_what_limits_a_step_is_as_in_the_table() -> None:
    for found, kept in zip(limits(), kept_rows("limits"), strict=True):
        assert [cell or 0.0 for cell in found[1:2] + found[3:]] == pytest.approx(
            [float(cell or 0.0) for heading, cell in kept.items() if heading not in {"what", "unit"}], rel=1e-9
        )


def test_what_the_page_says_of_the_chain_holds_in_its_tables() -> None:
    def tensions(depth: int, when: str, source: str, friction: str = "no") -> FloatArray:
        row = next(
            one
            for one in kept_rows("chains")
            if (one["depth [m]"], one["when"], one["source"], one["friction"]) == (str(depth), when, source, friction)
        )
        return np.array([float(row["fairlead [kN]"]), float(row["anchor [kN]"])])

    for case in CASES:
        assert tensions(case.depth, REST, "published") == pytest.approx([case.fairlead, case.anchor])
        assert tensions(case.depth, REST, LOWERED) == pytest.approx([case.fairlead, case.anchor], rel=1e-3)
        assert tensions(case.depth, REST, CORRECTED) == pytest.approx(tensions(case.depth, REST, "mudline"), rel=5e-4)
        taken = {
            source: tensions(case.depth, PULLED, source)[1] - tensions(case.depth, PULLED, source, "yes")[1]
            for source in ("catenary", "mudline")
        }
        near = [one for one in kept_rows("anchor") if one["depth [m]"] == str(case.depth)]
        assert near[0]["share of its weight"] == "0.0"
        missing = float(near[-1]["friction missing up to it [kN]"])
        assert missing == pytest.approx(taken["catenary"] - taken["mudline"], rel=0.1)


@pytest.mark.nightly
def test_a_chain_comes_out_as_it_is_in_the_table() -> None:
    case = CASES[1]
    kept = [
        row for row in kept_rows("chains") if row["depth [m]"] == str(case.depth) and "MoorDyn" not in row["source"]
    ]
    for found, one in zip(own(case)[0], kept, strict=True):
        assert [str(cell) for cell in found[:4]] == [one[heading] for heading in CHAINS[:4]]
        assert found[4:] == pytest.approx([float(one[heading]) for heading in CHAINS[4:]], rel=1e-6)


@pytest.mark.nightly
def test_the_bouncing_beam_comes_out_as_it_is_in_the_table() -> None:
    moments = TIMES[:36]
    beam, path = fall(Tolerance(1e-6, 4e-3), moments)
    kept = kept_rows("bouncing-path")[:36]
    first, last = path.displacements[:, 0], path.displacements[:, beam.nodes - 1]
    assert first + beam.start[0, 0] == pytest.approx(column(kept, "reference, first node [m]"), abs=1e-6)
    assert last + beam.start[-1, 0] == pytest.approx(column(kept, "last node [m]"), abs=1e-6)
