"""One step of an element with suction: what holds on any path, its derivatives, and what the evaluator does."""

from __future__ import annotations

from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.contact import ContactModel
from mudline.model.contact.laws.suction import SuctionHistory, SuctionLaw, SuctionState
from tests.helpers.builders.contact import NONE, bridge_law, chain, floats, heave, suction
from tests.helpers.suction import Suction, step
from tests.model.contact.single import BROKEN, DEPTH, HOLD, largest, lift, lifted, pull

Path = list[tuple[float, float]]

paths = st.lists(st.floats(-0.3, 0.6), min_size=2, max_size=30)
millimetres = st.lists(st.integers(-300, 600).map(lambda place: place / 1000), min_size=2, max_size=30)
time_steps = st.floats(1e-3, 10.0)
laws = st.builds(
    lambda first, width, force, depth, exponents: SuctionLaw(
        *(
            floats(value)
            for value in (
                force,
                exponents[0],
                depth,
                exponents[1],
                first,
                first + width * (0.99 - first),
                1.0,
                1e-3,
                np.nan,
            )
        )
    ),
    st.floats(0.01, 0.98),
    st.floats(0.0, 1.0),
    st.floats(0.0, 1e5),
    st.floats(1e-3, 2.0),
    st.tuples(st.floats(0.0, 2.5), st.floats(0.0, 1.5)),
)


def moves(places: list[float], dt: float) -> Path:
    """The path with the velocities of backward differences."""
    return [(places[0], 0.0), *((here, (here - last) / dt) for last, here in pairwise(places))]


@given(law=laws, places=paths, dt=time_steps)
def test_never_pushes_and_never_exceeds_the_largest_force(law: SuctionLaw, places: list[float], dt: float) -> None:
    path = moves(places, dt)
    walked = lift(law, path)
    for (_, velocity), force, state in zip(path, walked.forces, walked.states, strict=True):
        limit = largest(law, floats(max(velocity, 0.0)))[0].item()
        assert -limit * (1 + 1e-15) <= force <= 0.0
        assert force == 0.0 or state == SuctionState.SUCTION
        assert not (force == 0.0 and np.signbit(force))


@given(law=laws, places=millimetres, dt=time_steps)
def test_a_step_alone_is_what_the_evaluator_does(law: SuctionLaw, places: list[float], dt: float) -> None:
    path = moves(places, dt)
    depths, rates = [0.0 - place for place in places], [velocity for _, velocity in path]
    positions, velocities = heave(depths, rates)
    result = ContactModel(chain([NONE], suction(law))).evaluate(positions, velocities=velocities)
    walked = lift(law, path)
    assert result.state is not None
    assert result.state[:, 0].tolist() == walked.states
    assert result.force[:, 0] == pytest.approx(walked.forces, rel=1e-12, abs=1e-300)


@given(law=laws, places=paths, dt=time_steps)
def test_only_compression_arms_and_only_breakout_disarms(law: SuctionLaw, places: list[float], dt: float) -> None:
    history, broken = SuctionHistory.initial(law), False
    for place, velocity in moves(places, dt):
        after = lift(law, [(place, velocity)], history).last
        state = after.state.item()
        assert after.armed.item() == (state in {SuctionState.COMPRESSION, SuctionState.SUCTION, SuctionState.HOLD})
        assert (state == SuctionState.COMPRESSION) == (place < 0.0)
        broken = (broken or state == SuctionState.BROKEN) and state != SuctionState.COMPRESSION
        assert not (broken and after.armed.item())
        history = after


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
