"""The motions of the precision study: laws, exact outcomes, and what the schemes make of them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import trapezoid

from mudline.contact import LawAssignment
from mudline.contact.laws.suction import SuctionHistory, SuctionLaw, from_cohesion, step
from mudline.curves import ForceCurve
from mudline.scene.oscillation import oscillations
from mudline.study import SAMPLE_TEXT, sample_scene
from mudline.study.laws import CurveLaw, LinearLaw, SuctionNumbers, smoothed_spring
from mudline.study.precision import contacts, exact_motions, integration
from mudline.study.precision.contacts import (
    all_cases,
    contacts_of,
    friction_of,
    suction_of,
)
from mudline.study.precision.exact_motions import (
    Drag,
    Pull,
    bounce,
    breakout,
    drag_case,
    drop_case,
    drop_to,
    pull_case,
    reference_drop,
)
from mudline.study.precision.integration import Case, row
from mudline.study.report import Omission, StudyError
from mudline.study.schemes import SCHEMES
from tests.builders.contact import changed
from tests.builders.scenes import legal_scene

CLAY = CurveLaw("clay", ForceCurve([(0.0, 0.0), (0.02, 640.0), (0.1, 1480.0), (0.5, 2450.0)]), 0.3)


def suction(regularisation: float = 1e-3) -> SuctionNumbers:
    factors = from_cohesion(np.array([5000.0]), np.array([0.3]))
    powers = {name: float(values[0]) for name, values in factors._asdict().items()}
    return SuctionNumbers(**powers, first_corner=0.2, second_corner=0.8, cyclic=1.0, regularisation=regularisation)


def test_linear_law_and_its_work() -> None:
    law = LinearLaw("contact", 5e4, 0.005)
    z = np.array([-0.005, -0.0025, 0.0, 0.0025, 0.005, 0.05])
    assert law.spring(z)[0] == pytest.approx([0, 15.625, 62.5, 140.625, 250, 2500])
    assert law.work(np.array([0.05]))[0] == pytest.approx(62.708333333333)
    assert law.work(np.array([-0.006]))[0] == 0.0
    assert law.breaks().tolist() == [0.005]
    kinked = LinearLaw("contact", 5e4)
    assert kinked.spring(np.array([-1.0, 0.02]))[0].tolist() == [0.0, 1000.0]
    assert kinked.work(np.array([-1.0, 0.02])).tolist() == [0.0, 10.0]
    assert kinked.breaks().size == 0


def test_zones_of_any_width_side_by_side() -> None:
    z = np.array([-0.2, -0.1, 0.0, 0.0, 0.05, 0.1, 0.3])
    h = np.array([0.1, 0.1, 0.1, 0.0, 0.0, 0.2, 0.2])
    force, slope = smoothed_spring(z, 1000.0, h)
    assert force == pytest.approx([0.0, 0.0, 25.0, 0.0, 50.0, 112.5, 300.0])
    assert slope == pytest.approx([0.0, 0.0, 500.0, 0.0, 1000.0, 750.0, 1000.0])


def test_curve_law_and_its_work() -> None:
    z = np.array([-0.1, 0.003, 0.006, 0.1, 0.3])
    force, stiffness = CLAY.spring(z)
    assert force == pytest.approx(
        [0, 320, 640, float(CLAY.curve.evaluate(1 / 3)[0]), float(CLAY.curve.evaluate(1.0)[0])]
    )
    assert stiffness[0] == 0.0
    assert CLAY.spring(np.array([-1.0]))[0].tolist() == [0.0]
    fine = np.linspace(0.0, 0.3, 200_001)
    forces = CLAY.curve.evaluate(fine / 0.3)[0]
    assert CLAY.work(z)[-1] == pytest.approx(trapezoid(forces, fine), rel=1e-9)
    assert CLAY.work(z)[0] == 0.0
    assert CLAY.steepest(0.0) == CLAY.steepest(0.1) == pytest.approx(640 / 0.006)
    assert CurveLaw("up", ForceCurve([(-0.2, -1.0), (-0.1, 0.0)]), 0.5).steepest(0.3) == pytest.approx(20.0)
    assert CurveLaw("late", ForceCurve([(0.1, 0.0), (0.2, 5.0)]), 0.5).steepest(0.0) == pytest.approx(100.0)


def test_reference_drop_has_the_published_depth() -> None:
    drop = reference_drop()
    assert drop.deepest == pytest.approx(0.20820726588, rel=1e-10)
    flight = bounce(drop.law, drop.mass, drop.weight, drop.speed)
    assert flight.deepest == pytest.approx(drop.deepest, rel=1e-11)
    assert flight.speed == pytest.approx(0.5, rel=1e-11)
    assert bounce(drop.law, 500.0, 0.0, 0.5).time == pytest.approx(0.31415926536, rel=1e-10)


@pytest.mark.parametrize("law", [CLAY, LinearLaw("soft", 3e3), LinearLaw("zone", 5e4, 0.01)])
def test_energies_and_integration_agree(law: CurveLaw | LinearLaw) -> None:
    drop = drop_to(law, 170.0, 900.0, 0.075)
    flight = bounce(law, drop.mass, drop.weight, drop.speed)
    if not law.top:
        assert flight.deepest == pytest.approx(drop.deepest, rel=1e-10)
    assert flight.speed == pytest.approx(drop.speed, rel=1e-10)


def test_seabed_that_never_carries_is_refused() -> None:
    soft = CurveLaw("mud", ForceCurve([(0.0, 0.0), (0.5, 10.0), (1.0, 5.0)]), 0.3)
    with pytest.raises(StudyError, match="mud never stops a mass"):
        drop_to(soft, 170.0, 900.0, 0.05)


def test_endless_search_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(exact_motions, "_MOST_EVALUATIONS", 20)
    with pytest.raises(StudyError, match="takes too long to find"):
        bounce(LinearLaw("contact", 1.0), 1.0, 0.0, 1.0)
    monkeypatch.setattr(exact_motions, "_MOST_EVALUATIONS", 100_000)
    monkeypatch.setattr(exact_motions, "_MOST_PHASES", 1)
    with pytest.raises(StudyError, match="does not release"):
        bounce(LinearLaw("contact", 1.0), 1.0, 0.0, 1.0)


def test_suction_numbers_are_those_of_the_law() -> None:
    law = suction()
    assert law.depth(0.1) == pytest.approx(0.16156501691, rel=1e-10)
    assert law.force(0.08, 0.1) == pytest.approx(1378.5656595, rel=1e-10)
    assert law.force(0.01, 0.1) == pytest.approx(426.62876092, rel=1e-9)
    assert law.force(0.03, 5e-4) == pytest.approx(424.24484398, rel=1e-10)
    assert law.force(0.2, 0.1) == 0.0


@pytest.mark.parametrize("floor", [math.nan, 0.3])
def test_suction_is_that_of_the_evaluator(floor: float) -> None:
    """In a first uplift a factor that is applied once per cycle has not been applied yet."""
    numbers = suction()._replace(cyclic=0.7, cyclic_floor=floor)
    armed = step(numbers.rows(1), SuctionHistory.initial(numbers.rows(1)), np.zeros(1), np.zeros(1), np.ones(1, bool))[
        1
    ]
    for x, v in ((0.01, 0.1), (0.08, 0.1), (0.15, 0.1), (0.03, 5e-4)):
        found, _ = step(numbers.rows(1), armed, np.array([x]), np.array([v]), np.zeros(1, bool))
        assert -found.force[0] == pytest.approx(numbers.force(x, v), rel=1e-13)
    assert numbers.force(0.08, 0.1) == pytest.approx(1378.5656595 * (0.7 if math.isnan(floor) else 1.0), rel=1e-10)


def test_breakout(monkeypatch: pytest.MonkeyPatch) -> None:
    pull = Pull("clay", CLAY, suction(), 170.0, 0.01, 0.1)
    exact = breakout(pull)
    assert exact.uplift == pytest.approx(0.294 * exact.speed**0.26, rel=1e-10)
    # The whole energy: what was there at the mudline, what the pull gave, what suction took.
    kinetic = 85.0 * (exact.speed**2 - pull.passing() ** 2)
    assert kinetic == pytest.approx(pull.pull * exact.uplift - exact.work, rel=1e-9)
    with pytest.raises(StudyError, match="without slowing down"):
        breakout(Pull("clay", LinearLaw("contact", 1e7), suction(), 170.0, 0.01, 1e-5))
    monkeypatch.setattr(exact_motions, "_STOPS", 1)
    with pytest.raises(StudyError, match="repeatedly"):
        breakout(pull)


CASES = {
    "drop": drop_case("drop", "", reference_drop()),
    "curve": drop_case("curve", "", drop_to(CLAY, 170.0, 900.0, 0.075)),
    "pull": pull_case(Pull("clay", CLAY, suction(), 170.0, 0.01, 0.1)),
    "drag": drag_case(Drag("clay", 170.0, 570.0, 2e5)),
}


@pytest.mark.untraced
@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("scheme", ["velocity-verlet", "rk4", "newmark", "generalised-alpha-0", "backward-euler"])
def test_errors_fall_with_the_step(name: str, scheme: str) -> None:
    coarse, fine = (row(CASES[name], SCHEMES[scheme], step) for step in (0.03, 0.01))
    assert not fine.reason
    for large, small in zip(coarse.errors, fine.errors, strict=True):
        assert large is not None
        assert small is not None
        assert small < 0.6 * large or small < 3e-5
    assert max(filter(None, fine.errors)) < (0.3 if scheme == "backward-euler" else 1e-3)
    assert (fine.iterations == 0.0) == SCHEMES[scheme].explicit


def test_drag_is_the_sliding_block_in_closed_form() -> None:
    case = CASES["drag"]
    omega, threshold = math.sqrt(2e5 / 170.0), 570.0 / 2e5
    assert case.omega == pytest.approx(omega)
    stiff = drag_case(Drag("hard", 1.0, 0.5 * 9.81, 1e8))
    # With a stiff spring the way is v^2 / (2 mu g) and the time v / (mu g).
    speed = 3.0 * math.sqrt(1e8) * 0.5 * 9.81 / 1e8
    assert stiff.duration == pytest.approx(speed / (0.5 * 9.81), rel=0.6)
    assert threshold < 0.003


def test_runs_that_fail_say_why() -> None:
    found = row(CASES["drop"], SCHEMES["central-difference"], 10.0)
    assert found.errors == (None, None, None)
    assert (found.failed, found.reason) == (64, "64 of 64 runs: step 2: the motion grew without bound")
    slow = row(CASES["drop"], SCHEMES["backward-euler"], 3.0)
    assert "no step ended above the seabed" in slow.reason
    stuck = row(CASES["drag"], SCHEMES["newmark"], 10.0)
    assert "Newton's method left a residual" in stuck.reason


def test_endless_runs_are_not_begun(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(integration, "_MOST_STEPS", 10)
    case: Case = CASES["drop"]
    found = row(case, SCHEMES["rk4"], 0.01)
    assert "it would take" in found.reason
    assert found.errors == (None, None, None)


def test_suction_of_a_deck_is_taken_from_it() -> None:
    found = sample_scene()
    inputs = found.contact_input()
    law = SuctionLaw(*(np.array([low, 2.0 * low]) for low in (2000.0, 0.18, 0.3, 0.26, 0.2, 0.4, 1.0, 1e-3, 0.4)))
    given = replace(inputs, laws=(LawAssignment("suction", np.array([5, 0]), law._asdict()),))
    studied = contacts_of(found)._replace(inputs=given)
    contact = studied.contacts[0]
    for element, place in ((5, 0), (0, 1)):
        assert suction_of(studied, contact._replace(element=element)) == tuple(float(v[place]) for v in law)
    assert suction_of(studied, contact._replace(element=9)).force_factor == 4000.0
    assert not studied.notes
    bare = studied._replace(inputs=replace(inputs, laws=()))
    assert suction_of(bare, contact).force_factor == pytest.approx(2086.5435606)
    assert "Bridge" in bare.notes[0]


def test_friction_is_the_stiffest_of_the_deck() -> None:
    """At the end node on sand: 0.5 W over 3 mm; as the mass per unit length there, so its omega is that of STB002."""
    studied = contacts_of(sample_scene())
    contact, inputs = studied.contacts[0], studied.inputs
    drag = friction_of(studied, contact)
    assert drag.name == "friction on Sand"
    assert drag.limit == pytest.approx(0.5 * contact.weight)
    assert drag.stiffness == pytest.approx(drag.limit / 0.003)
    assert drag.mass == pytest.approx(contact.mass)
    stiff = friction_of(studied._replace(inputs=changed(inputs, "friction", axial_stiffness=4e5)), contact)
    assert stiff.stiffness == pytest.approx(4e5)  # a metre of line at an end node, two at the others
    sideways = friction_of(studied._replace(inputs=changed(inputs, "friction", lateral_stiffness=4e5)), contact)
    assert sideways.stiffness == pytest.approx(4e5)
    assert sideways.limit == pytest.approx(0.6 * contact.weight)  # of two equal ones the first node, on clay
    assert not studied.notes
    bare = friction_of(studied._replace(inputs=replace(inputs, laws=())), contact)
    assert (bare.limit, bare.stiffness) == pytest.approx((0.5 * contact.weight, 0.5 * contact.weight / 0.003))
    assert "The deck has no friction:" in studied.notes[0]


def test_drag_oscillates_as_the_friction_of_the_stability_study() -> None:
    """Springs of *SEABED FRICTION, stiffer across: 3e7 N/m on half an element."""
    block = "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0.4, 0.7\n STIFFNESS=1.0E7, 3.0E7\n$LOAD CASE"
    text = SAMPLE_TEXT.replace("$LOAD CASE", block)
    found = legal_scene(text)
    (drag,) = (case for case in all_cases(contacts_of(found), []) if case.name == "drag")
    (friction,) = (one for one in oscillations(found, found.contact_input("cut")).found if one.kind == "friction")
    assert drag.omega == pytest.approx(friction.omega)
    assert drag.omega == pytest.approx((3e7 / 1.0 / friction.mass) ** 0.5)
    assert drag.title == "dragged, friction on ALL"
    assert drag.line is not None
    assert text.splitlines()[drag.line - 1] == " STIFFNESS=1.0E7, 3.0E7"


@pytest.mark.parametrize(("inner", "note"), [("0.295", "The pipe floats: half"), ("0.25", "")])
def test_a_floating_pipe_is_named(inner: str, note: str) -> None:
    studied = contacts_of(legal_scene(SAMPLE_TEXT.replace("0.3, 0.25,", f"0.3, {inner},")))
    assert [one.startswith(note) for one in studied.notes] == ([True] if note else [])


def test_case_that_overflows_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    endless = replace(drag_case(Drag("sand", 1.0, 1.0, 1.0)), omega=math.inf)
    monkeypatch.setattr(contacts, "_drag", lambda *_: endless)
    omissions: list[Omission] = []
    cases = all_cases(contacts_of(sample_scene()), omissions)
    assert "drag" not in {case.name for case in cases}
    assert [omission.reason for omission in omissions] == ["its stiffness or its duration overflows"]


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        (", 0.003,", ", 1.0E-307,", "friction: no frequency: its law has no largest stiffness or damping"),
        ("0.3, 0.25,", "0.3, 0.295,", "friction: no springs at 11 nodes: they follow the submerged weight, and the"),
    ],
)
def test_friction_without_a_known_spring_is_not_dragged(old: str, new: str, reason: str) -> None:
    found = legal_scene(SAMPLE_TEXT.replace(old, new))
    omissions: list[Omission] = []
    with np.errstate(all="ignore"):
        cases = all_cases(contacts_of(found), omissions)
    assert "drag" not in {case.name for case in cases}
    (omission,) = omissions
    assert omission.what == "drag along Soft Clay"
    assert omission.reason.startswith(reason)


def test_curve_of_many_points_does_without_stops(monkeypatch: pytest.MonkeyPatch) -> None:
    drop = drop_to(CLAY, 170.0, 900.0, 0.075)
    stopping = bounce(CLAY, drop.mass, drop.weight, drop.speed)
    monkeypatch.setattr(exact_motions, "_MOST_BREAKS", 0)
    assert bounce(CLAY, drop.mass, drop.weight, drop.speed).time == pytest.approx(stopping.time, rel=1e-6)


def test_mass_and_weight_of_the_sample() -> None:
    found = sample_scene()
    area = np.pi / 4 * (0.3**2 - 0.25**2)
    assert found.mass_per_length == pytest.approx(np.full(10, 7850 * area))
    weight = (7850 * area - 1025 * np.pi / 4 * 0.3**2) * 9.81
    assert found.submerged_weight == pytest.approx(np.full(10, weight))
