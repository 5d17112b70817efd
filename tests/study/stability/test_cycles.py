"""Newton's method on friction: cycles and cures."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.study.newton import Newton
from mudline.study.stability.cycles import (
    EXAMPLE,
    STARTS,
    FrictionProblem,
    bracketed,
    cycle_counts,
    newton_failures,
    newton_path,
    residual,
)


def test_the_cycle_of_the_example_and_its_cure() -> None:
    plain = newton_path(EXAMPLE, 1.0, Newton(most=5))
    assert plain.iterates == pytest.approx([1.0, -5.0, 15.0, -5.0, 15.0, -5.0])
    assert not plain.converged
    cured = newton_path(EXAMPLE, 1.0, Newton(halving=True))
    assert (cured.iterations, cured.converged) == (3, True)
    assert cured.iterates[-1] == pytest.approx(0.05, abs=1e-12)


def test_the_friction_of_the_evaluator_is_the_one_of_the_formula() -> None:
    u = np.linspace(-1.0, 1.0, 101)
    value, slope, _ = residual(EXAMPLE, u)
    assert value == pytest.approx(u + np.clip(99.0 * u, -10.0, 10.0) - 5.0)
    assert slope == pytest.approx(np.where(np.abs(99.0 * u) > 10.0, 1.0, 100.0))


def test_a_bracket_cures_every_cycle() -> None:
    for one in cycle_counts():
        assert one.bracketed == 0
        assert one.plain == 0 or (one.ratio > 1.0 and one.share < 1.0)
        assert one.halved == 0 or one.ratio >= 1e4
    assert newton_failures(EXAMPLE, Newton()) > 95
    assert (bracketed(FrictionProblem(1.0, 99.0, 10.0, float("nan")), STARTS[:1]) == -1).all()
