"""Schemes against published and closed numbers: spectral radii, single impacts, orders, failures."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from mudline.study.laws import Falling, LinearLaw
from mudline.study.motion import Forces, History, Motion, Scheme, march
from mudline.study.newton import Newton
from mudline.study.schemes import SCHEMES, OneStep, generalised_alpha, hht
from mudline.study.stability.landings import restitution

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Oscillators:
    """Undamped oscillators m a = -k x.

    Attributes:
        mass: (k,).
        stiffness: (k,) force per length.
    """

    mass: Floats
    stiffness: Floats

    def forces(self, position: Floats, velocity: Floats, history: History) -> Forces:
        """See `System`."""
        return Forces(-self.stiffness * position, -self.stiffness, np.zeros(velocity.shape), history)


def amplification(scheme: Scheme, omega_dt: float) -> Floats:
    """The matrix (3, 3) that takes (x, dt v, dt^2 a) over one step of omega dt."""
    system = Oscillators(np.ones(3), np.full(3, omega_dt * omega_dt))
    unit = np.eye(3)
    after = scheme.step(system, Motion(unit[0], unit[1], unit[2], -system.stiffness * unit[0], None), 1.0).motion
    return np.array([after.position, after.velocity, after.acceleration])


def spectral_radius(scheme: Scheme, omega_dt: float) -> float:
    """Factor by which the largest part of an undamped oscillation grows in a step: above 1, the scheme is unstable."""
    return float(np.abs(np.linalg.eigvals(amplification(scheme, omega_dt))).max())


RADII: dict[str, tuple[Scheme, dict[float, float]]] = {
    "newmark": (SCHEMES["newmark"], {0.1: 1, 1: 1, 10: 1, 100: 1, 1e6: 1}),
    "hht-0.05": (
        hht(-0.05),
        {0.1: 0.9999994390, 1: 0.9964896684, 10: 0.9131682874, 100: 0.9048526986, 1e6: 0.9047619048},
    ),
    "hht-0.1": (
        hht(-0.1),
        {0.1: 0.9999989934, 1: 0.9938473293, 10: 0.8378028340, 100: 0.8184023292, 1e6: 0.8181818182},
    ),
    "hht-0.3": (
        hht(-0.3),
        {0.1: 0.9999981747, 1: 0.9893840771, 10: 0.6846112833, 100: 0.5494873492, 1e6: 0.5384615386},
    ),
    "hht-1/3": (hht(-1 / 3), {0.1: 0.9999981604, 1: 0.9893127860, 10: 0.6825284215, 100: 0.5371736239}),
    "ga-0.8": (generalised_alpha(0.8), {0.1: 0.9999999316, 1: 0.9994746140, 10: 0.9297917672, 100: 0.8346376088}),
    "ga-0.5": (generalised_alpha(0.5), {0.1: 0.9999981604, 1: 0.9893127860, 10: 0.6825284215, 100: 0.5371736239}),
    "ga-0": (generalised_alpha(0.0), {0.1: 0.9999519177, 1: 0.9065633333, 10: 0.2425356250, 100: 0.0478312817}),
    "backward-euler": (
        SCHEMES["backward-euler"],
        {0.1: 0.9950371902, 1: 0.7071067812, 10: 0.0995037190, 1e6: 0.000001},
    ),
    "rk2": (SCHEMES["rk2"], {0.1: 1.0000124999, 1: 1.1180339887, 10: 50.0099990002}),
    "rk4": (SCHEMES["rk4"], {0.1: 0.9999999931, 1: 0.9939050368}),
    "central-difference": (SCHEMES["central-difference"], {0.1: 1, 1: 1, 10: 97.9897948557, 2.01: 1.2213010932}),
    "velocity-verlet": (SCHEMES["velocity-verlet"], {0.1: 1, 1: 1, 10: 97.9897948557}),
}

HALF_WAY: dict[str, dict[float, float]] = {
    "newmark": {0.5: 0.9796976241, 1: 0.9360000000, 10: 0.9230769231},
    "hht-0.3": {1: 0.8893361223, 10: 0.6353229763},
    "generalised-alpha-1": {1: 0.9360000000},
    "generalised-alpha-0.5": {1: 0.8888979592, 10: 0.6324062878},
    "generalised-alpha-0": {1: 0.7839506173, 10: 0.5186466744},
    "backward-euler": {0.1: 0.8538846421, 0.5: 0.4673536, 1: 0.25, 10: 0.0049975687},
    "velocity-verlet": {0.1: 0.9991880838, 0.5: 0.9940185547, 1: 1.0},
    "central-difference": {0.1: 0.9991880838, 0.5: 0.9940185547},
}

# Least, mean and largest over 400 landing phases.
ALL_PHASES = {
    ("newmark", 0.1): (0.9988, 1.0000, 1.0012),
    ("newmark", 0.5): (0.9711, 1.0004, 1.0297),
    ("newmark", 1): (0.8995, 1.0056, 1.1116),
    ("newmark", 10): (0.352, 1.599, 2.841),
    ("newmark", 100): (0.335, 1.666, 2.993),
    ("hht-0.3", 0.5): (0.9658, 0.9951, 1.0244),
    ("hht-0.3", 1): (0.8774, 0.9790, 1.0804),
    ("hht-0.3", 10): (0.370, 1.319, 2.267),
    ("generalised-alpha-0.5", 1): (0.8769, 0.9788, 1.0802),
    ("generalised-alpha-0.5", 10): (0.370, 1.317, 2.261),
    ("generalised-alpha-0", 0.1): (0.9974, 0.9986, 0.9998),
    ("generalised-alpha-0", 1): (0.7502, 0.8009, 0.8517),
    ("generalised-alpha-0", 100): (0.334, 0.667, 0.998),
    ("backward-euler", 0.1): (0.8538, 0.8549, 0.8559),
    ("backward-euler", 1): (0.25, 0.25, 0.25),
    ("backward-euler", 10): (0.003, 0.007, 0.010),
    ("velocity-verlet", 0.1): (0.9988, 1.0000, 1.0012),
    ("velocity-verlet", 0.5): (0.9783, 1.0002, 1.0221),
    ("velocity-verlet", 1): (1.0, 1.0, 1.0),
}


@pytest.mark.parametrize("name", RADII)
def test_spectral_radius(name: str) -> None:
    scheme, radii = RADII[name]
    for omega_dt, radius in radii.items():
        assert spectral_radius(scheme, omega_dt) == pytest.approx(radius, abs=2e-10, rel=2e-9)


@pytest.mark.parametrize("scheme", [scheme for scheme in SCHEMES.values() if 0.0 < scheme.limit < np.inf])
def test_limit_separates_stable_from_unstable(scheme: Scheme) -> None:
    assert spectral_radius(scheme, 0.999 * scheme.limit) <= 1.0 + 1e-9
    assert spectral_radius(scheme, 1.001 * scheme.limit) > 1.0 + 1e-4


def test_schemes_without_a_limit_never_grow_and_those_with_limit_zero_always_do() -> None:
    for scheme in SCHEMES.values():
        radii = [spectral_radius(scheme, omega_dt) for omega_dt in (1e-2, 0.3, 1.0, 7.0, 1e3)]
        if scheme.limit == np.inf:
            assert max(radii) <= 1.0 + 1e-9
        if scheme.limit == 0.0:
            assert min(radii) > 1.0


@pytest.mark.parametrize("name", HALF_WAY)
def test_restitution_half_way_into_a_step(name: str) -> None:
    for omega_dt, expected in HALF_WAY[name].items():
        (found,) = restitution(SCHEMES[name], omega_dt, np.array([0.5]))
        assert found == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(("name", "omega_dt"), ALL_PHASES)
def test_restitution_over_all_phases(name: str, omega_dt: float) -> None:
    found = restitution(SCHEMES[name], omega_dt, (np.arange(400) + 0.5) / 400)
    rough = 1e-4 if omega_dt <= 1 else 2e-3
    assert (found.min(), found.mean(), found.max()) == pytest.approx(ALL_PHASES[name, omega_dt], abs=rough)


def test_backward_euler_never_gains() -> None:
    phases = np.linspace(0.001, 0.999, 333)
    for omega_dt in (0.05, 0.3, 2.0, 20.0):
        assert restitution(SCHEMES["backward-euler"], omega_dt, phases).max() < 1.0


@pytest.mark.parametrize(
    ("name", "order"),
    [
        ("forward-euler", 1),
        ("backward-euler", 1),
        ("rk2", 2),
        ("newmark", 2),
        ("hht-0.3", 2),
        ("velocity-verlet", 2),
        ("central-difference", 2),
        ("generalised-alpha-0", 2),
        ("rk4", 4),
    ],
)
def test_order_on_an_oscillator(name: str, order: int) -> None:
    system = Oscillators(np.ones(1), np.ones(1))
    start = Motion.start(system, np.ones(1), np.zeros(1))
    errors = []
    for steps in (100, 200):
        run = march(SCHEMES[name], system, start, 1.0 / steps, steps)
        errors.append(abs(run.position[-1, 0] - np.cos(1.0)))
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.15)


@dataclass(frozen=True)
class Damped:
    """m a = -k x - c v, with a count of the steps as history."""

    mass: Floats
    damping: float

    def forces(self, position: Floats, velocity: Floats, history: History) -> Forces:
        one = np.ones(len(position))
        return Forces(-position - self.damping * velocity, -one, -self.damping * one, (history or 0) + 1)


@pytest.mark.parametrize(
    ("name", "order"), [("central-difference", 1), ("velocity-verlet", 1.6), ("newmark", 1.9), ("rk4", 3.9)]
)
def test_force_that_depends_on_velocity(name: str, order: float) -> None:
    damping = 0.5
    system = Damped(np.ones(1), damping)
    frequency = np.sqrt(1 - damping**2 / 4)
    exact = np.exp(-damping / 2) * (np.cos(frequency) + damping / 2 / frequency * np.sin(frequency))
    errors = []
    for steps in (50, 100):
        run = march(SCHEMES[name], system, Motion.start(system, np.ones(1), np.zeros(1)), 1.0 / steps, steps)
        errors.append(abs(run.position[-1, 0] - exact))
    assert np.log2(errors[0] / errors[1]) > order - 0.2
    assert run.end.history == 101


def test_central_difference_and_verlet_are_one_without_velocity_in_the_force() -> None:
    seabed = Falling(np.ones(3), LinearLaw("", 0.3), weight=0.0)
    start = Motion.start(seabed, np.array([0.1, 0.5, 0.9]), np.full(3, -1.0))
    runs = [march(SCHEMES[name], seabed, start, 1.0, 30).position for name in ("central-difference", "velocity-verlet")]
    assert np.array_equal(runs[0], runs[1])


def test_unstable_run_fails_with_its_reason_and_leaves_the_others_alone() -> None:
    system = Oscillators(np.ones(2), np.array([0.01, 25.0]))
    start = Motion.start(system, np.ones(2), np.zeros(2))
    run = march(SCHEMES["central-difference"], system, start, 1.0, 50, bound=1e3)
    assert list(run.failures) == [1]
    assert "grew without bound" in run.failures[1]
    assert np.abs(run.position[-1, 0]) <= 1.01
    assert np.isfinite(run.position).all()
    both = march(SCHEMES["central-difference"], Oscillators(np.ones(2), np.full(2, 25.0)), start, 1.0, 50, bound=1e3)
    assert sorted(both.failures) == [0, 1]
    assert (both.position[-1] == both.position[-2]).all()


def test_iteration_cap_is_a_failure_with_its_reason() -> None:
    scheme = SCHEMES["newmark"]
    assert isinstance(scheme, OneStep)
    system = Oscillators(np.ones(1), np.ones(1))
    run = march(scheme.solved_by(Newton(most=0)), system, Motion.start(system, np.ones(1), np.zeros(1)), 0.1, 3)
    assert "Newton's method left a residual of" in run.failures[0]
    assert "after 0 iterations" in run.failures[0]


def clipped(unknown: Floats) -> tuple[Floats, Floats, Floats]:
    """u + clip(99 u, +-10) - 5: a weak spring beside friction."""
    spring = 99.0 * unknown
    slope: Floats = np.where(np.abs(spring) < 10, 100.0, 1.0)
    value: Floats = unknown + np.clip(spring, -10, 10) - 5
    return value, slope, np.abs(unknown) + 10


def test_newton_cycles_on_friction_and_halving_cures_it() -> None:
    plain = Newton(most=20).solve(clipped, np.array([1.0]))
    assert plain.iterations[0] == 20
    assert plain.root[0] in {-5.0, 15.0}
    assert plain.residual[0] > 1.0
    cured = Newton(halving=True).solve(clipped, np.array([1.0]))
    assert cured.root[0] == pytest.approx(0.05)
    assert cured.iterations[0] <= 5
    assert cured.residual[0] == 0.0


def test_newton_stops_at_what_is_not_a_number() -> None:
    solution = Newton(least=1).solve(lambda u: (u * np.nan, u, u), np.array([1.0]))
    assert solution.iterations[0] == 0
    assert np.isnan(solution.residual[0])
