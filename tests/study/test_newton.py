"""Newton's method in a bracket: what alternates is solved, a jump is found, and every evaluation is counted."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from mudline.study.laws import LinearLaw
from mudline.study.motion import Forces, History, Motion, march
from mudline.study.newton import Newton
from mudline.study.schemes import SCHEMES, bracketed

Floats = NDArray[np.float64]
BRACKETED = Newton(most=100, least=1, bracketed=True)


def clipped(unknown: Floats) -> tuple[Floats, Floats, Floats]:
    """u + clip(99 u, +-10) - 5: a weak spring beside friction; the root is 0.05."""
    spring = 99.0 * unknown
    slope: Floats = np.where(np.abs(spring) < 10, 100.0, 1.0)
    return unknown + np.clip(spring, -10, 10) - 5, slope, np.abs(unknown) + 10


def jumping(unknown: Floats) -> tuple[Floats, Floats, Floats]:
    """u - 1, and 3 more above 0.5: it jumps across 0 there."""
    return unknown - 1.0 + np.where(unknown > 0.5, 3.0, 0.0), np.ones(unknown.shape), np.ones(unknown.shape)


class Counted:
    """A mass on a linear seabed that counts how often its force is evaluated."""

    mass = np.array([170.0])

    def __init__(self) -> None:
        self.calls = 0
        self._law = LinearLaw("seabed", 5e4)

    def forces(self, position: Floats, velocity: Floats, history: History) -> Forces:
        self.calls += 1
        force, slope = self._law.spring(-position)
        return Forces(force - 900.0, -slope, np.zeros(velocity.shape), history)


def test_a_bracket_solves_what_alternates() -> None:
    starts = np.linspace(-20.0, 20.0, 101)
    plain, kept = (newton.solve(clipped, starts) for newton in (Newton(most=100, least=1), BRACKETED))
    assert (plain.residual > 0.0).sum() > 50
    assert not kept.residual.any()
    assert kept.root == pytest.approx(0.05)
    assert kept.iterations.max() < 20
    assert (kept.bisections > 0).sum() >= (plain.residual > 0.0).sum()
    assert not kept.jumps.any()


def test_a_jump_is_a_root() -> None:
    found = BRACKETED.solve(jumping, np.array([-4.0, 0.5, 3.0]))
    assert found.root == pytest.approx(0.5, abs=1e-14)
    assert found.jumps.all()
    assert not found.residual.any()
    assert found.iterations.max() < 100
    lost = Newton(most=100, least=1).solve(jumping, np.array([-4.0, 0.5, 3.0]))
    assert (lost.residual > 0.0).all()


def test_a_bracket_that_is_not_needed_changes_nothing() -> None:
    starts = np.array([0.01, 0.06])
    plain, kept = (newton.solve(clipped, starts) for newton in (Newton(most=100, least=1), BRACKETED))
    assert (plain.root == kept.root).all()
    assert not kept.bisections.any()


def test_a_residual_that_falls_somewhere_is_solved() -> None:
    """u^3 - 3 u - 10 falls between -1 and 1; its only root is 2.6129."""

    def cubic(u: Floats) -> tuple[Floats, Floats, Floats]:
        return u**3 - 3.0 * u - 10.0, 3.0 * u * u - 3.0, np.abs(u**3) + 10.0

    found = BRACKETED.solve(cubic, np.linspace(-3.0, 3.0, 61))
    assert not found.residual.any()
    assert found.root == pytest.approx(2.6128878647)


@pytest.mark.parametrize("name", ["velocity-verlet", "rk4", "newmark", "hht-0.3", "backward-euler"])
@pytest.mark.parametrize("dt", [0.003, 0.3])
def test_every_evaluation_is_counted(name: str, dt: float) -> None:
    system = Counted()
    start = Motion.start(system, np.array([0.001]), np.array([-0.5]))
    run = march(bracketed(SCHEMES[name]), system, start, dt, 40)
    assert int(run.evaluations[0]) + 1 == system.calls
    if SCHEMES[name].explicit:
        assert run.evaluations[0] == 40 * (4 if name == "rk4" else 1)
    else:
        assert run.evaluations[0] == 40 + run.iterations.sum()


def test_runs_side_by_side_count_their_own_evaluations() -> None:
    alone = [BRACKETED.solve(clipped, np.array([start])).evaluations[0] for start in (0.01, 4.0, -19.0)]
    assert BRACKETED.solve(clipped, np.array([0.01, 4.0, -19.0])).evaluations.tolist() == alone
    assert len(set(alone)) > 1
