"""The studies of the method: their pages show their tables, and pieces of the tables come out again."""

from __future__ import annotations

import re

import numpy as np
import pytest

from tests.benchmarks.studies import critical, friction
from tests.benchmarks.studies.__main__ import PAGES, TABLES
from tests.benchmarks.studies.curves import METHODS, largest_error
from tests.benchmarks.studies.landings import LANDINGS, LINEAR, PHASES, rebounds
from tests.benchmarks.studies.laws import CLAY
from tests.benchmarks.studies.limits import critical_step
from tests.benchmarks.studies.motions import PUBLISHED, drag, pull
from tests.benchmarks.studies.newton import Newton
from tests.benchmarks.studies.schemes import SCHEMES
from tests.benchmarks.studies.steps import NAME, tried
from tests.benchmarks.tables import FOLDER, column, inserted, load


@pytest.mark.parametrize("page", PAGES)
def test_the_tables_of_a_page_are_those_of_its_files(page: str) -> None:
    text = (FOLDER / f"{page}.md").read_text(encoding="utf-8")
    assert inserted(text, TABLES) == text
    assert text.count("<!-- table ") == text.count("<!-- end -->") > 0
    pictures = {path.name for path in FOLDER.glob(f"{page}-*.png")}
    assert pictures == set(re.findall(r"\]\((\S+\.png)\)", text))


@pytest.mark.alike
@pytest.mark.parametrize("name", ["velocity-verlet", "newmark", "rk4"])
def test_the_largest_steps_meet_their_goal_and_the_next_ones_do_not(name: str) -> None:
    rows = {(row["case"], row["scheme"]): row for row in load(NAME)}
    for case in (PUBLISHED.case("drop, linear"), pull(), drag()):
        step = float(rows[case.name, SCHEMES[name].title]["omega dt for 1 % [-]"])
        assert tried(case, SCHEMES[name], step).meets(0.0101)
        assert not tried(case, SCHEMES[name], step * 10.0 ** (1.0 / 12.0)).meets(0.0099)


def test_the_published_drop() -> None:
    assert PUBLISHED.deepest == pytest.approx(0.20820726588, rel=1e-10)


def test_landings_come_out_as_in_the_table() -> None:
    for row in load(LANDINGS):
        scheme = next(one for one in SCHEMES.values() if one.title == row["scheme"])
        if float(row["omega dt [-]"]) in {0.5, 1.0, 10.0}:
            speeds = rebounds(scheme, LINEAR, np.array([float(row["omega dt [-]"])]), PHASES)
            assert [speeds.min(), speeds.mean(), speeds.max()] == pytest.approx(
                [float(row[key]) for key in ("least [-]", "mean [-]", "largest [-]")], abs=1e-9
            )


def test_newtons_method_cycles_above_the_closed_form_and_a_bracket_cures_it() -> None:
    for share in friction.FORCES:
        for factor, cycles in ((0.99, False), (1.01, True)):
            ratio = factor * friction.threshold(share)
            assert (friction.lost(ratio, share, Newton()) > 0) == cycles
    rows = load(friction.CYCLES)
    assert not any(column(rows, "bracketed"))
    assert any(column(rows, "15 halvings"))
    assert not any(column(rows, "20 halvings"))


def test_critical_steps_are_those_at_which_a_motion_begins_to_grow() -> None:
    rows = load(critical.NAME)
    for row in rows:
        limit = float(row["critical step [s]"])
        if 0.0 < limit < np.inf:
            assert (row["grows below"], row["grows above"]) == ("False", "True")
        else:
            assert row["grows below"] == str(limit == 0.0)


@pytest.mark.parametrize(
    ("frequency", "step"), [(4.472135955, 0.4472135955), (44.72135955, 0.04472135955), (1414.213562, 0.001414213562)]
)
def test_published_steps_of_500_kg(frequency: float, step: float) -> None:
    assert critical_step("central-difference", frequency) == pytest.approx(step, rel=1e-9)
    assert critical_step("velocity-verlet", frequency) == pytest.approx(step, rel=1e-9)


def test_curves_come_out_again() -> None:
    ratios = np.random.default_rng(7).uniform(0.0, 0.5, 200)
    kept = {row["method"]: float(row["largest error [-]"]) for row in load("precision-curves")}
    assert largest_error(CLAY, METHODS["mudline"](CLAY), ratios) < 3e-16
    assert 0.3 < largest_error(CLAY, METHODS["scipy PCHIP"](CLAY), ratios) / kept["scipy PCHIP"] <= 1.0
