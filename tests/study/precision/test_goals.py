"""Orders, needed steps and the advice for a deck, measured."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from mudline.scene.oscillation import line_of, oscillations
from mudline.study import SAMPLE_TEXT, sample_scene
from mudline.study.motion import Scheme
from mudline.study.precision import integration
from mudline.study.precision.contacts import all_cases, contacts_of
from mudline.study.precision.exact_motions import drop_case, reference_drop
from mudline.study.precision.goals import Limit, advised, order, order_of
from mudline.study.precision.integration import TRIED, Case, StepRow, ladder_rows, largest_step, measured, meets
from tests.builders.scenes import legal_scene

JUMPING = SAMPLE_TEXT.replace(" 0.00,    0.0\n", " 0.00,  300.0\n")
"""The curve begins with a force at ratio 0 (CRV007)."""
PUBLISHED = drop_case("published", "", reference_drop())


def drops_on(text: str) -> dict[str, Case]:
    return {case.name: case for case in all_cases(contacts_of(legal_scene(text)), []) if case.name.startswith("drop")}


def made(omega_dt: float, error: float | None, case: str = "c", scheme: str = "rk4") -> StepRow:
    """A row with one error for all three quantities; force evaluations are 1 / step."""
    dt = 0.1 * omega_dt
    return StepRow(case, scheme, omega_dt, dt, 9, error, error, error, 0.0, 1.0 / dt, 0.0, 0, "", work=6.0 / omega_dt)


def test_a_larger_step_does_not_count_behind_one_that_fails() -> None:
    ladder = [made(0.3, 1e-3), made(0.1, 0.02), made(0.03, 9e-3), made(0.01, 1e-4), made(1.0, None)]
    found = largest_step(ladder, 1e-2)
    assert found is not None
    assert found.omega_dt == 0.03
    assert largest_step(ladder, 1e-5) is None


def test_orders_are_slopes() -> None:
    assert order([(0.1, 1e-2), (0.01, 1e-4), (0.001, 1e-6), (1.0, 50.0)]) == pytest.approx(2.0)
    assert order([(0.1, 1e-2), (0.01, None)]) is None
    assert order([(0.1, 1e-2), (0.01, 1e-13)]) is None


@pytest.mark.parametrize("scheme", [name for name in TRIED if name != "generalised-alpha-1"])
def test_a_jump_of_the_force_makes_every_scheme_one_of_first_order(scheme: str) -> None:
    case = drops_on(JUMPING)["drop-curve"]
    rows = measured(case, [(TRIED[scheme], step) for step in (0.1, 0.03, 0.01)], 0)
    assert not any(row.reason for row in rows)
    assert order_of(rows) == pytest.approx(1.0, abs=0.15)
    smooth = measured(PUBLISHED, [(TRIED[scheme], step) for step in (0.03, 0.01)], 0)
    assert order_of(smooth) == pytest.approx(1.0 if scheme == "backward-euler" else 2.0, abs=0.25)


def test_the_steps_that_a_jump_needs() -> None:
    rows = ladder_rows(drops_on(JUMPING)["drop-curve"], {"velocity-verlet": TRIED["velocity-verlet"]}, full=False)
    found = [step for goal in (1e-2, 1e-3) if (step := largest_step(rows, goal))]
    assert 0.03 <= found[0].omega_dt < 0.1
    assert 0.003 <= found[1].omega_dt < 0.01
    assert [step.work for step in found] == pytest.approx([2.0 * math.pi / step.omega_dt for step in found])
    assert order_of(rows) == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize(
    ("scheme", "percent", "tenth", "most"),
    [
        *(("velocity-verlet", 0.0895, 0.0283, 1.01), ("newmark", 0.201, 0.0598, 1.01)),
        ("rk4", 0.318, 0.106, 1.1),  # its error does not grow evenly: 0.97 % at 0.348, 1.08 % at 0.365
    ],
)
def test_largest_steps_are_found(scheme: str, percent: float, tenth: float, most: float) -> None:
    """The limits are those of a dense search by another program, 60 steps per decade and a half."""
    rows = ladder_rows(PUBLISHED, {scheme: TRIED[scheme]}, full=False)
    for goal, limit in ((1e-2, percent), (1e-3, tenth)):
        best = largest_step(rows, goal)
        assert best is not None
        assert limit / 1.17 <= best.omega_dt <= most * limit
        assert min(row.omega_dt for row in rows if row.omega_dt > best.omega_dt) < 1.17 * best.omega_dt
        near = [row for row in rows if best.omega_dt / 1.36 < row.omega_dt <= best.omega_dt]
        assert len(near) >= 9  # the step, and eight closer ones below it
        assert all(meets(row, goal) for row in rows if row.omega_dt <= best.omega_dt)
    assert len({round(row.omega_dt, 9) for row in rows}) == len(rows)


def test_backward_euler_has_no_step_for_the_published_case() -> None:
    rows = ladder_rows(PUBLISHED, {"backward-euler": TRIED["backward-euler"]}, full=False)
    assert largest_step(rows, 1e-2) is None


def test_the_drops_on_a_deck() -> None:
    drops = drops_on(SAMPLE_TEXT)
    assert [(name, case.line) for name, case in drops.items()][1:] == [("drop-curve", 32), ("drop-linear", 27)]
    assert drops["drop-curve"].omega > drops["drop-linear"].omega
    stiff = drops_on(SAMPLE_TEXT.replace("STIFFNESS=50.0E3", "STIFFNESS=500.0E3"))
    assert stiff["drop-linear"].omega > stiff["drop-curve"].omega
    assert stiff["drop-linear"].omega == pytest.approx((5e5 / 169.5) ** 0.5, rel=1e-3)
    assert stiff["drop-linear"].line == 27
    bare = "$MODEL\n*NODE\n 1, 0.0, 0.0, 0.0\n 2, 0.0, 1.0, 0.0\n*ELEMENT\n 1, 1, 2\n"
    assert list(drops_on(bare)) == ["drop-reference"]


def test_cases_have_the_lines_of_their_laws() -> None:
    lines = {case.name: case.line for case in all_cases(contacts_of(sample_scene()), [])}
    assert lines == {"drop-reference": None, "drop-curve": 32, "drop-linear": 27, "pull": 43, "drag": 28}
    text = SAMPLE_TEXT.replace("*SEABED SUCTION\n SET=Clay\n COHESION=5.0E3\n", "")
    text = text.replace(" FRICTION=0.35, 0.60, 0.003, 0.150\n", "")
    lines = {case.name: case.line for case in all_cases(contacts_of(legal_scene(text)), [])}
    assert lines == {"drop-reference": None, "drop-curve": 31, "drop-linear": 26, "pull": None, "drag": 27}
    block = "*SEABED FRICTION\n SET=Clay\n COEFFICIENTS=0.4, 0.7\n STIFFNESS=4.0E5, 2.0E5\n$LOAD CASE"
    text = text.replace("$LOAD CASE", block)
    (line,) = (case.line for case in all_cases(contacts_of(legal_scene(text)), []) if case.name == "drag")
    assert line is not None
    assert text.splitlines()[line - 1] == " STIFFNESS=4.0E5, 2.0E5"


def test_the_advice_takes_the_smallest_step_of_the_deck_and_the_least_work() -> None:
    first, second = (replace(PUBLISHED, name=name, line=line) for name, line in (("a", 7), ("b", 8)))
    ladders = {
        ("published", "rk4"): [made(0.01, 0.5)],
        ("a", "rk4"): [made(0.1, 1e-2), made(0.3, 0.1)],
        ("b", "rk4"): [made(0.1, 5e-4), made(0.3, 8e-3)],
        ("a", "newmark"): [made(0.1, 1e-4, scheme="newmark"), made(0.3, 2e-3, scheme="newmark")],
        ("b", "newmark"): [made(0.1, 2e-4, scheme="newmark"), made(0.3, 3e-3, scheme="newmark")],
    }
    found = advised(ladders, [PUBLISHED, first, second])
    assert [(row.goal, row.scheme, row.dt, row.case, row.line) for row in found] == [
        (0.01, "Newmark", pytest.approx(0.03), "a", 7),
        (0.01, "RK4", pytest.approx(0.01), "a", 7),
        (0.001, "Newmark", pytest.approx(0.01), "a", 7),
        (0.001, "RK4", None, "a", 7),
    ]
    assert [row.error for row in found] == [3e-3, 1e-2, 2e-4, None]
    assert advised(ladders, [PUBLISHED]) == []


def test_the_advice_is_below_the_critical_step_of_every_contact() -> None:
    """Suction damping on the clay, c / m = 6459.6 1/s, allows velocity Verlet m / c and central difference 2 m / c."""
    scene = sample_scene()
    contacts, _ = oscillations(scene, scene.contact_input("cut"))
    limits = [Limit(one, line_of(scene, one.where), "") for one in contacts]
    case = replace(PUBLISHED, name="a", line=7)
    schemes = ("velocity-verlet", "central-difference", "newmark", "rk4")
    ladders = {("a", scheme): [made(0.1, 1e-4, scheme=scheme), made(0.3, 5e-3, scheme=scheme)] for scheme in schemes}
    found = {row.scheme: row for row in advised(ladders, [case], limits) if row.goal == 0.01}
    rate = 6459.6146664
    assert list(found) == ["Newmark", "RK4", "central difference", "velocity Verlet"]
    assert (found["Newmark"].omega_dt, found["Newmark"].case, found["Newmark"].line) == (0.3, "a", 7)
    for scheme, limit in (("velocity Verlet", 1.0), ("central difference", 2.0), ("RK4", 2.7852936)):
        row = found[scheme]
        assert row.dt == pytest.approx(limit / rate)
        assert (row.case, row.line, row.limited, row.omega_dt) == ("suction damping on Clay", 43, "stability", None)
        assert row.evaluations == pytest.approx(rate / limit)
        assert row.error == 1e-4


def test_run_times_are_medians_of_runs_in_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    seconds = iter(range(100))
    order_: list[str] = []
    plain = integration.row

    def timed(case: integration.Case, scheme: Scheme, omega_dt: float) -> StepRow:
        order_.append(scheme.name)
        return plain(case, scheme, omega_dt)._replace(seconds=float(next(seconds)))

    monkeypatch.setattr(integration, "row", timed)
    rk4, newmark = measured(PUBLISHED, [(TRIED["rk4"], 0.3), (TRIED["newmark"], 0.3)], 100)
    assert order_ == ["rk4", "newmark"] * 5
    assert (rk4.quick, rk4.seconds, rk4.slow, rk4.repeats) == (2.0, 4.0, 6.0, 5)
    assert (newmark.quick, newmark.seconds, newmark.slow) == (3.0, 5.0, 7.0)
    assert measured(PUBLISHED, [(TRIED["rk4"], 0.3)], 10)[0].repeats == 1


def test_a_ladder_ends_where_the_smallest_goal_is_met() -> None:
    rows = ladder_rows(PUBLISHED, {name: TRIED[name] for name in ("rk4", "velocity-verlet")}, full=False)
    steps = {name: [row.omega_dt for row in rows if row.scheme == name] for name in ("rk4", "velocity-verlet")}
    assert steps["rk4"][0] == 0.01
    assert steps["velocity-verlet"][0] == 0.003
    assert steps["rk4"] == sorted(steps["rk4"])
    verlet = next(row for row in rows if row.scheme == "velocity-verlet")
    assert verlet.work == pytest.approx(2094.395, rel=1e-6)
    assert verlet.evaluations == pytest.approx(1.0 / verlet.dt)
