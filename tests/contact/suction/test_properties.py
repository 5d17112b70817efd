"""What holds for any path: signs, bounds, states, and a step alone gives what the evaluator does."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.contact import ContactModel
from mudline.contact.laws.suction import SuctionHistory, SuctionLaw, SuctionState
from tests.builders.contact import NONE, chain, floats, heave, suction
from tests.contact.single import largest, lift

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
