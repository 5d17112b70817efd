"""Laws as functions of single numbers: worked values at the borders of their cases, where scenes seldom come."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from mudline.model.contact.laws import linear, soil
from mudline.model.contact.laws.friction import FrictionHistory, FrictionLaw, on_ellipse
from tests.model.contact.single import anchored, coulomb, move
from tests.model.contact.soil_program import Clay


def test_the_tangent_of_a_direction_without_a_limit_is_none() -> None:
    held = coulomb((0.0, 0.5), 1e5, ellipse=True)
    stuck = move(held, anchored(held), (0.5, 0.001), 1000.0)
    assert stuck.by_position[0].tolist() == [[0.0, 0.0], [0.0, -1e5]]
    slipping = move(held, anchored(held), (0.5, 0.01), 1000.0)
    assert slipping.by_position[0].tolist() == [[0.0, 0.0], [0.0, 0.0]]
    assert slipping.by_compression[0].tolist() == [0.0, -0.5]


def test_a_node_that_touches_down_has_no_force_and_no_stiffness() -> None:
    held = coulomb((0.4, 0.5), 1e5)
    step = move(held, FrictionHistory.initial(held.active), (0.5, 0.3), 1000.0)
    assert step.force[0].tolist() == [0.0, 0.0]
    assert step.by_position[0].tolist() == [[0.0, 0.0], [0.0, 0.0]]
    assert step.by_compression[0].tolist() == [0.0, 0.0]


def test_a_trial_far_beyond_the_ellipse_is_drawn_back_along_its_direction() -> None:
    force_1, force_2, slips = on_ellipse(3e300, -4e300, 1e-5, 1e-5)
    assert (float(force_1), float(force_2)) == pytest.approx((0.6e-5, -0.8e-5), rel=1e-14)
    assert slips


def test_a_spring_beyond_numbers_is_infinite_without_a_warning() -> None:
    every = np.array([True])
    law = FrictionLaw(np.array([[0.5, 0.5]]), np.array([[np.nan, 7.0]]), np.array([[5e-324, np.nan]]), every, every)
    assert law.rising.tolist() == [[np.inf, 0.0]]
    assert law.springs(np.array([2.0])).tolist() == [[np.inf, 7.0]]


CLAY = (5000.0, 1500.0, 6.0, 0.25, 200.0, 0.6, 1.0, 0.3, 0.0)
"""The parameters of the soil law; the pipe has a diameter of 0.3 m."""
PACE = 200.0 / 0.3


def test_the_steepest_stiffness_of_the_soil() -> None:
    """K_max P_u/D; just below the mudline, where P_u grows as a root, the initial path has half as much again."""
    assert soil.steepest(0.06, 0.3, *CLAY) == pytest.approx(4084665.7828, rel=1e-9)
    resistance = 6.0 * 0.1**0.25 * np.sqrt(10.0 * 1e-9) * 5000.0 * 0.3
    assert soil.steepest(0.3e-9, 0.3, *CLAY) == pytest.approx(1.5 * PACE * resistance, rel=1e-6)
    assert soil.steepest(np.inf, 0.3, *CLAY) == soil.steepest(0.3, 0.3, *CLAY)
    # the weight adds w D, where the pipe is half in the soil or more, else w times the width at the mudline
    heavy = (*CLAY[:-1], 9000.0)
    for depth, width in ((0.03, 0.18), (0.15, 0.3), (0.25, 0.3)):
        added = float(soil.steepest(depth, 0.3, *heavy)) - float(soil.steepest(depth, 0.3, *CLAY))
        assert added == pytest.approx(9000.0 * width, rel=1e-6)


@pytest.mark.parametrize("half_width", [0.0, 0.02])
@pytest.mark.parametrize("one_sided", [0.0, 1.0])
@pytest.mark.parametrize("force", [1.0, 99.0, 400.0, 401.0, 5e4])
def test_the_penetration_under_a_force_has_that_force(force: float, half_width: float, one_sided: float) -> None:
    z = linear.penetration_under(force, 1e4, half_width, one_sided)
    assert linear.smoothed_reaction(z, 0.3, 1e4, half_width, one_sided)[0] == pytest.approx(force, rel=1e-12)
    assert z > linear.zone_onset(1e4, half_width, one_sided)


def crossing(values: Callable[[float], float], low: float, high: float) -> float:
    """Where values of different signs at low and high have their zero, by halving."""
    begins = values(low) > 0.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if (values(middle) > 0.0) == begins else (low, middle)
    return high


def reloaded(fallen: float, z0: float, p0: float) -> tuple[float, ...]:
    """An element that was 0.06 deep, and goes down again from z0 with the force p0."""
    return 0.06, p0, soil.AGAIN, 0.06, fallen, z0, p0, -1.0


@pytest.mark.parametrize(
    ("z0", "share", "low", "high"),
    [(0.055, 0.6, 0.06, 0.1), (0.0599, 0.6, 0.06, 0.1), (0.0599, 0.9, 0.06, 0.1), (0.04, 0.9, 0.06, 0.06)],
)
def test_a_repenetration_meets_the_initial_path_where_its_formula_does(
    z0: float, share: float, low: float, high: float
) -> None:
    clay = Clay()
    p0 = share * clay.initial(z0)

    def above(z: float) -> float:
        rest, gone = clay.ultimate(z) - p0, PACE * (z - z0)
        return p0 + gone / (rest / clay.ultimate(z0) + gone) * rest - clay.initial(z)

    meets = crossing(above, low, high)
    assert (above(0.06) < 0.0) == (high > low)
    assert float(soil.meeting(0.3, reloaded(-1.0, z0, p0), CLAY)) == pytest.approx(meets, rel=1e-9)
    # where the force once fell through zero its bound is the initial path from z_P / (1 - lambda_rep) on
    late = 1.5 * meets
    assert float(soil.meeting(0.3, reloaded(0.7 * late, z0, p0), CLAY)) == pytest.approx(late, rel=1e-12)
    assert float(soil.meeting(0.3, reloaded(0.01, z0, p0), CLAY)) == pytest.approx(meets, rel=1e-9)


def test_a_repenetration_that_begins_without_force_meets_nothing_and_one_from_the_mudline_all() -> None:
    for p0 in (0.0, -200.0):
        assert soil.meeting(0.3, reloaded(0.03, 0.02, p0), CLAY) == np.inf
    assert soil.meeting(0.3, reloaded(-1.0, 0.0, 0.0), CLAY) == 0.06
    assert soil.meeting(0.3, reloaded(0.07, 0.0, 0.0), CLAY) == pytest.approx(0.1)
    slow = (*CLAY[:7], 1.0, 0.0)
    force = 0.9 * Clay().initial(0.04)
    assert soil.meeting(0.3, reloaded(0.03, 0.04, force), slow) == np.inf
    assert soil.meeting(0.3, reloaded(-1.0, 0.04, force), slow) == 0.06


def test_an_uplift_from_a_small_force_keeps_it_at_first() -> None:
    z0 = crossing(lambda z: Clay().initial(z) - 0.5, 0.0, 0.01)
    memory = z0, 0.5, soil.UP, z0, -1.0, z0, 0.5, -1.0
    assert float(soil.advance(0.9999 * z0, 0.3, memory, CLAY)[0]) == pytest.approx(0.5, abs=0.05)
    fallen = (*memory[:6], 0.0, -1.0)
    assert float(soil.advance(0.9999 * z0, 0.3, fallen, CLAY)[0]) <= 0.0


WAYS = {
    "initial": (0.08, (0.06, 900.0, soil.DOWN, 0.06, -1.0, 0.0, 0.0, -1.0)),
    "uplift": (0.059, (0.0595, 900.0, soil.UP, 0.06, -1.0, 0.06, 3000.0, 0.0)),
    "suction": (0.04, (0.041, -900.0, soil.UP, 0.06, 0.055, 0.06, 3000.0, 0.055)),
    "suction that decays": (0.02, (0.021, -900.0, soil.UP, 0.06, 0.055, 0.06, 3000.0, 0.055)),
    "again": (0.033, (0.025, 300.0, soil.AGAIN, 0.06, -1.0, 0.02, 100.0, -1.0)),
    "again, delayed": (0.045, (0.044, 500.0, soil.AGAIN, 0.06, 0.05, 0.04, -300.0, -1.0)),
    "again, delayed beyond": (0.062, (0.061, 500.0, soil.AGAIN, 0.06, 0.05, 0.059, 2500.0, -1.0)),
    "again, bounded by the initial path": (0.065, (0.064, 900.0, soil.AGAIN, 0.06, 0.02, 0.0599, 5375.0, -1.0)),
    "again, no longer delayed": (0.075, (0.07, 900.0, soil.AGAIN, 0.06, 0.02, 0.0595, 3000.0, -1.0)),
}


@pytest.mark.parametrize("way", WAYS)
def test_the_stiffness_of_each_way_against_differences(way: str) -> None:
    z, memory = WAYS[way]
    step = 1e-8
    ahead, behind = (float(soil.advance(z + by, 0.3, memory, CLAY)[0]) for by in (step, -step))
    found = float(soil.advance(z, 0.3, memory, CLAY)[1])
    assert found == pytest.approx((ahead - behind) / (2.0 * step), rel=1e-5)


def test_a_repenetration_is_no_weaker_than_where_it_began() -> None:
    """Its bound is exp(-0.3 + (z - z_P) / z_max) P_i, but P0 at least: there it goes on without stiffness."""
    z, z0, p0 = 0.041, 0.04, 3200.0
    assert np.exp(-0.3 + (z - 0.055) / 0.06) * Clay().initial(z) < p0
    force, stiffness, _ = soil.advance(z, 0.3, (z0, p0, soil.AGAIN, 0.06, 0.055, z0, p0, -1.0), CLAY)
    assert (float(force), float(stiffness)) == (p0, 0.0)
