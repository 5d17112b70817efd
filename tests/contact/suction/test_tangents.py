"""The derivatives are those of the force, in each state and on each branch; extremes stay finite."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from mudline.contact.laws.suction import Suction, step
from tests.builders.contact import bridge_law
from tests.contact.single import BROKEN, DEPTH, HOLD, lifted, pull

V_MAX = 0.1
BRANCHES = {"rise": 0.1, "plateau": 0.5, "release": 0.9}


def central(low: Suction, high: Suction, distance: float) -> float:
    return (high.force.item() - low.force.item()) / distance


@pytest.mark.parametrize("branch", BRANCHES)
@pytest.mark.parametrize("v", [3e-4, 5e-3, 0.09], ids=["capped", "slow", "near the largest"])
def test_at_a_latched_depth(branch: str, v: float) -> None:
    law, x = bridge_law(), BRANCHES[branch] * DEPTH
    here, dx, dv = pull(law, x, v, V_MAX), 1e-5 * x, 1e-5 * v
    by_uplift = central(pull(law, x - dx, v, V_MAX), pull(law, x + dx, v, V_MAX), 2 * dx)
    by_velocity = central(pull(law, x, v - dv, V_MAX), pull(law, x, v + dv, V_MAX), 2 * dv)
    assert here.by_uplift.item() == pytest.approx(by_uplift, rel=1e-7, abs=1e-3)
    assert here.by_velocity.item() == pytest.approx(by_velocity, rel=1e-7)
    assert here.by_velocity.item() < 0.0


@pytest.mark.parametrize("branch", BRANCHES)
@pytest.mark.parametrize("v", [5e-3, 0.2, 3.0])
def test_at_a_new_largest_velocity_the_depth_moves_too(branch: str, v: float) -> None:
    law = bridge_law()
    x = BRANCHES[branch] * pull(law, 0.0, v).depth.item()
    dv = 1e-5 * v
    by_velocity = central(pull(law, x, v - dv), pull(law, x, v + dv), 2 * dv)
    assert pull(law, x, v).by_velocity.item() == pytest.approx(by_velocity, rel=1e-7)


def test_sign_of_the_velocity_tangent_on_a_growing_trapezoid() -> None:
    law = bridge_law(3)
    x = np.array([0.1, 0.5, 0.9]) * pull(law, 0.0, 0.1).depth
    grows, latched = pull(law, x, 0.1), pull(law, x, 0.1, V_MAX)
    assert grows.force == pytest.approx(latched.force, rel=1e-14)
    assert (latched.by_velocity < 0.0).all()
    # On the rise the suction of a faster pull is mobilised over a longer way: n_D > n_f makes it smaller.
    assert grows.by_velocity[0] > 0.0
    assert grows.by_velocity[1] == latched.by_velocity[1]
    assert grows.by_velocity[2] < latched.by_velocity[2]


def test_extremes_are_finite_and_quiet() -> None:
    caps, velocities, latched = (0.0, 1e-300, 1e-3), (0.0, 5e-324, 1e-300, 1e-3, 1.0, 1e6, 1e100), (0.0, 0.1, 1e100)
    uplifts = (-1.0, 0.0, 5e-324, 1e-300, 1e-60, 0.01, 1.0, 1e300, 1.7e308)
    cap, v, x, v_max = np.array(list(product(caps, velocities, uplifts, latched))).T
    law = bridge_law(len(v), regularisation=cap)
    with np.errstate(all="raise"):
        suction, after = step(law, lifted(law, v_max), x, v, np.zeros(len(v), np.bool_))
    for values in (*suction, after.v_max):
        assert np.isfinite(values).all()
    assert (suction.force <= 0.0).all()
    assert not np.signbit(suction.force[suction.force == 0.0]).any()
    assert (after.state[v == 0.0] == HOLD).all()
    assert not suction.force[v == 0.0].any()
    assert (suction.force[(x == 0.01) & (v >= 1e-3)] < 0.0).all()
    assert (after.state[(x >= 1e300) & (v > 0.0)] == BROKEN).all()


def test_the_least_velocity_still_follows_the_power() -> None:
    suction = pull(bridge_law(regularisation=0.0), 1e-90, 1e-300)
    depth = 0.294 * 10.0 ** (-300 * 0.26)
    assert suction.depth.item() == pytest.approx(depth, rel=1e-12)
    force = 2086.5435606 * 1e-54 * (1e-90 / (0.2 * depth))
    assert -suction.force.item() == pytest.approx(force, rel=1e-10)
