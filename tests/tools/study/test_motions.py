"""The motions of the study and the schemes on them, against closed forms and published figures."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mudline.model.contact.laws.suction import from_cohesion
from mudline.model.curves import ForceCurve
from mudline.tools.study import drops
from mudline.tools.study.drops import CurveLaw, Drop, Law, LinearLaw, drop_to, landings
from mudline.tools.study.precision import Mass
from mudline.tools.study.schemes import SCHEMES, Forces, History, Motion, march, solved, started
from mudline.tools.study.slides import Drag, Pull, SuctionNumbers

SOFTENING = ForceCurve([(0.0, 0.0), (0.1, 3000.0), (0.2, 3000.0), (0.3, 2600.0), (0.6, 9000.0)])
STIFFENING = ForceCurve([(0.0, 0.0), (0.01, 200.0), (0.1, 3000.0), (0.5, 9000.0)])
JUMPING = ForceCurve([(0.0, 500.0), (0.1, 2000.0), (0.5, 9000.0)])


class Oscillator:
    """x'' = -x."""

    mass = 1.0

    def forces(self, position: np.ndarray, velocity: np.ndarray, history: History) -> Forces:
        return Forces(-position, np.full(position.shape, -1.0), np.zeros(velocity.shape), history)


def amplitude(scheme: str, omega_dt: float, steps: int = 2000) -> float:
    """How far an oscillator gets."""
    dt, farthest = np.array([omega_dt]), [0.0]

    def observe(number: int, motion: Motion) -> bool:
        farthest[0] = max(farthest[0], float(abs(motion.position[0])))
        return number == steps

    march(SCHEMES[scheme], Oscillator(), started(Oscillator(), np.ones(1), np.zeros(1)), dt, observe)
    return farthest[0]


@pytest.mark.parametrize(("scheme", "critical"), [("velocity Verlet", 2.0), ("RK4", 2.0 * math.sqrt(2.0))])
def test_explicit_schemes_grow_above_their_critical_step(scheme: str, critical: float) -> None:
    assert amplitude(scheme, 0.99 * critical) < 20.0
    assert amplitude(scheme, 1.01 * critical) > 1e6


def test_hht_never_grows_on_an_oscillator() -> None:
    assert max(amplitude("HHT (-0.3)", omega_dt, 300) for omega_dt in (0.1, 3.0, 100.0)) <= 1.0


@pytest.mark.parametrize(
    ("scheme", "omega_dt", "least", "largest"),
    [
        ("HHT (-0.3)", 0.1, 0.9987, 1.0012),
        ("HHT (-0.3)", 0.5, 0.9658, 1.0244),
        ("HHT (-0.3)", 1.0, 0.8774, 1.0804),
        ("HHT (-0.3)", 10.0, 0.370, 2.267),
        ("velocity Verlet", 0.5, 0.9783, 1.0221),
    ],
)
def test_landings_are_those_of_independent_figures(scheme: str, omega_dt: float, least: float, largest: float) -> None:
    """Of 400 phases; the sixteen of the study come close to the worst of them."""
    found = landings(Drop(LinearLaw(1.0), 1.0, 0.0, 1.0, 1.0), SCHEMES[scheme], np.array([omega_dt]))
    assert float(found.least[0]) == pytest.approx(least, abs=0.15 * (1.0 - least) + 2e-4)
    assert float(found.largest[0]) == pytest.approx(largest, abs=0.15 * (largest - 1.0) + 2e-4)


def test_an_equation_that_jumps_is_solved_at_the_jump() -> None:
    def residual(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return np.where(x > 0.3, 1.0, -1.0), np.ones(x.shape), np.ones(x.shape)

    root, _, jumps = solved(residual, np.array([-5.0, 2.0]))
    assert root == pytest.approx(0.3, abs=1e-14)
    assert jumps.all()


LAWS: list[Law] = [
    LinearLaw(5e4),
    LinearLaw(5e4, 0.004),
    CurveLaw(SOFTENING, 0.3),
    CurveLaw(STIFFENING, 0.3),
    CurveLaw(JUMPING, 0.3),
]


@pytest.mark.covered
@pytest.mark.parametrize("law", LAWS, ids=str)
def test_the_closed_form_of_a_drop_is_what_tiny_steps_give(law: Law) -> None:
    drop = drop_to(law, 170.0, 300.0, 0.075)
    assert drop is not None
    steps = np.array([2e-4, 1e-4]) / drop.omega * 20.0
    errors, _ = drop.errors(SCHEMES["RK4"], steps)
    assert errors[1] < (5e-3 if law is LAWS[-1] else 1e-5)  # a force that jumps makes every scheme one of first order


def test_a_bounce_on_a_linear_seabed_takes_half_a_period() -> None:
    drop = drop_to(LinearLaw(5e4), 170.0, 0.0, 0.1)
    assert drop is not None
    assert drop.duration == pytest.approx(math.pi / math.sqrt(5e4 / 170.0), rel=1e-14)
    assert drop.speed == pytest.approx(0.1 * math.sqrt(5e4 / 170.0), rel=1e-14)
    assert drop_to(LinearLaw(5e4), 170.0, 1e5, 0.1) is not None  # deeper, where the seabed carries the weight
    assert drop_to(CurveLaw(ForceCurve([(0.0, 0.0), (0.1, 10.0), (0.2, 10.0)]), 0.3), 170.0, 1e3, 0.1) is None


def test_the_work_of_a_law_is_the_integral_of_its_force() -> None:
    for law in LAWS:
        s = np.linspace(0.0, 0.2, 200_001)
        force = law.force(np.append(s[1:] - 0.5e-6, 0.2))[0][:-1]
        assert float(law.work(s[-1:])[0]) == pytest.approx(float(force.sum() * 1e-6), rel=1e-5)


def pull() -> Pull:
    force, force_exponent, depth, depth_exponent = map(float, from_cohesion(np.array(5000.0), np.array(0.3)))
    suction = SuctionNumbers(force, force_exponent, depth, depth_exponent, 0.2, 0.8, 1.0, 1e-3)
    return Pull(LinearLaw(5e4), suction, 170.0, 0.01, 0.1)


def test_breakout_is_that_of_an_integration_with_stops() -> None:
    integrate = pytest.importorskip("scipy.integrate")
    found, numbers = pull(), pull().suction
    speed, _ = found.passing()

    def rate(_: float, state: np.ndarray) -> list[float]:
        return [state[1], (found.pull - numbers.force(state[0], state[1])) / found.mass]

    def broken(_: float, state: np.ndarray) -> float:
        return float(state[0] - numbers.depth(state[1]))

    setattr(broken, "terminal", True)  # noqa: B010 - scipy asks for an attribute of a function
    run = integrate.solve_ivp(rate, (0.0, 10.0), [1e-12, speed], rtol=1e-11, atol=1e-13, max_step=1e-3, events=broken)
    assert found.exact.time == pytest.approx(float(run.t[-1]), rel=1e-7)
    assert (found.exact.uplift, found.exact.speed) == pytest.approx(tuple(run.y[:, -1]), rel=1e-7)
    assert found.exact.suction == pytest.approx(max(map(numbers.force, *run.y)), rel=1e-3)


@pytest.mark.parametrize("mass", [Drag(170.0, 300.0, 1e5), pull()], ids=["drag", "pull"])
@pytest.mark.parametrize("scheme", SCHEMES)
def test_errors_fall_with_the_step_to_the_exact_outcome(mass: Mass, scheme: str) -> None:
    errors, evaluations = mass.errors(SCHEMES[scheme], np.array([0.4, 0.1, 0.02]) / mass.omega)
    assert errors[2] < 5e-3
    assert errors[2] < 0.5 * errors[1] < 0.5 * errors[0]
    assert evaluations.min() >= {"velocity Verlet": 1.0, "RK4": 4.0}.get(scheme, 2.0)


def test_a_pull_that_does_not_break_out_is_refused() -> None:
    weak = Pull(LinearLaw(5e4), pull().suction._replace(depth_exponent=3.0, depth_factor=50.0), 170.0, 0.01, 0.1)
    with pytest.raises(ValueError, match="does not break the mass out"):
        _ = weak.exact


def test_a_landing_that_sticks_is_not_one_that_keeps_its_speed() -> None:
    found = drops.Landing(np.array([np.nan, 0.995]), np.array([np.nan, 1.005]))
    assert found.kept.tolist() == [False, True]
