"""Static solutions: suction that lets go, and how stiff a structure must be; Newton on friction: cycles and cures."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mudline.contact.laws.suction import SuctionLaw
from mudline.study import SAMPLE_TEXT, sample_scene
from mudline.study.newton import Newton
from mudline.study.stability.statics import (
    EXAMPLE,
    STARTS,
    CycleCount,
    FrictionProblem,
    bracketed,
    cycle_threshold,
    equilibria,
    halved_failures,
    newton_failures,
    newton_path,
    releases,
    residual,
)
from tests.builders.scenes import legal_scene


def test_one_equilibrium_needs_the_stiffness_that_is_given() -> None:
    scene = sample_scene()
    suction = scene.contact_input().assigned["suction"]
    found = releases(scene, suction)
    assert [one.velocity for one in found] == [1e-3, 1e-2, 0.1, 1.0]
    assert found[2].needed == pytest.approx(42662.876092, rel=1e-10)
    assert {one.equilibria for one in found} == {(3, 3, 1, 1)}
    assert equilibria(SuctionLaw(*suction.columns).rows(slice(0, 1)), 0.1, 1e9) == 1


def test_the_release_is_that_of_a_first_uplift() -> None:
    """A factor that is applied once per cycle is not applied yet; elements that differ in it alone have one law."""
    scene = sample_scene()
    given = scene.contact_input().assigned["suction"]
    found = releases(scene, given)
    weaker = replace(given, parameters={**given.parameters, "cyclic": np.full(7, 0.5)})
    assert releases(scene, weaker)[2].needed == pytest.approx(0.5 * found[2].needed)
    per_cycle = {"cyclic": np.array([0.0, *np.full(6, 0.5)]), "cyclic_floor": np.full(7, 0.2)}
    assert releases(scene, replace(given, parameters={**given.parameters, **per_cycle})) == found


def test_suction_of_no_force_asks_for_nothing() -> None:
    scene = legal_scene(SAMPLE_TEXT.replace("COHESION=5.0E3", "COHESION=0"))
    suction = scene.contact_input().assigned["suction"]
    assert releases(scene, suction) == []


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


def test_a_bracket_cures_every_cycle(cycles: list[CycleCount]) -> None:
    for one in cycles:
        assert one.bracketed == 0
        assert one.plain == 0 or (one.ratio > 1.0 and one.share < 1.0)
        assert one.halved == 0 or one.ratio >= 1e4
    assert newton_failures(EXAMPLE, Newton()) > 95
    assert (bracketed(FrictionProblem(1.0, 99.0, 10.0, float("nan")), STARTS[:1]) == -1).all()


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_plain_newton_cycles_exactly_above_the_closed_form(share: float) -> None:
    limit = 1.0 / (1.0 - share)
    assert cycle_threshold(share) == pytest.approx(limit)
    assert newton_failures(FrictionProblem(1.0, 0.99 * limit, 10.0, 10.0 * share), Newton()) == 0
    assert newton_failures(FrictionProblem(1.0, 1.01 * limit, 10.0, 10.0 * share), Newton()) > 50
    assert cycle_threshold(1.0) == cycle_threshold(1.5) == math.inf


def test_a_cap_on_halvings_loses_solutions_and_the_closed_form_loses_none() -> None:
    """With ten halvings at 10^4 and 10^6 some are lost, with twenty none."""
    for ratio, lost in ((1e4, 27), (1e6, 49)):
        problem = FrictionProblem(1.0, ratio, 10.0, 5.0)
        assert halved_failures(problem, 10) == newton_failures(problem, Newton(halving=True)) == lost
        assert halved_failures(problem, 20) == halved_failures(problem, math.ceil(math.log2(ratio)) - 1) == 0
