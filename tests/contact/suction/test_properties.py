"""What holds for any path: signs, bounds, energy, splitting, units, order of the rows."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.contact.arrays import FloatArray
from mudline.contact.laws.suction import Suction, SuctionHistory, SuctionLaw, SuctionState, step
from tests.builders.contact import bridge_law, floats
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


@given(law=laws, places=paths, dt=time_steps)
def test_closed_cycles_never_give_work(law: SuctionLaw, places: list[float], dt: float) -> None:
    path = moves([*places, places[0]], dt)
    forces = lift(law, path).forces
    work = sum(force * (new[0] - old[0]) for force, (old, new) in zip(forces[1:], pairwise(path), strict=True))
    assert work <= 0.0


@given(law=laws, places=paths, dt=time_steps, cut=st.integers(0, 30))
def test_going_on_from_a_history_is_the_whole_path(law: SuctionLaw, places: list[float], dt: float, cut: int) -> None:
    path = moves(places, dt)
    whole, first = lift(law, path), lift(law, path[:cut])
    second = lift(law, path[cut:], first.last)
    assert [*first.forces, *second.forces] == whole.forces
    assert [*first.states, *second.states] == whole.states


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


@given(
    places=millimetres,
    dt=time_steps,
    length=st.sampled_from([0.3048, 1e-3, 2.0]),
    force=st.sampled_from([4.448, 1e-3, 8.0]),
)
def test_explicit_laws_hold_in_any_units(places: list[float], dt: float, length: float, force: float) -> None:
    law = bridge_law()
    n, m = law.force_exponent, law.depth_exponent
    other = law._replace(
        force_factor=law.force_factor * length ** (n + 1.0) / force,
        depth_factor=law.depth_factor * length ** (m - 1.0),
        regularisation=law.regularisation / length,
    )
    here, there = lift(law, moves(places, dt)), lift(other, moves([place / length for place in places], dt))
    assert here.states == there.states
    np.testing.assert_allclose(np.array(there.forces) * (force / length), here.forces, rtol=1e-8, atol=1e-6)
    np.testing.assert_allclose(np.array(there.depths) * length, here.depths, rtol=1e-12)


def many(elements: int) -> tuple[SuctionLaw, list[FloatArray], FloatArray]:
    """Laws and a path of steps of 0.1 s for many elements."""
    random = np.random.default_rng(7)
    law = bridge_law(elements, random.uniform(1e3, 1e4, elements), random.uniform(0.1, 1.0, elements))
    places = [random.uniform(-0.2, 0.4, elements) for _ in range(12)]
    return law, places, np.zeros(elements)


def run(law: SuctionLaw, places: list[FloatArray], last: FloatArray) -> tuple[list[Suction], SuctionHistory]:
    history, found = SuctionHistory.initial(law), []
    for place in places:
        suction, history = step(law, history, place, (place - last) / 0.1, place < 0.0)
        found.append(suction)
        last = place
    return found, history


@settings(max_examples=5)
@given(seed=st.integers(0, 2**32 - 1))
def test_rows_do_not_know_each_other(seed: int) -> None:
    law, places, start = many(20_000)
    order = np.random.default_rng(seed).permutation(len(start))
    found, last = run(law, places, start)
    shuffled, last_shuffled = run(
        SuctionLaw(*(values[order] for values in law)), [place[order] for place in places], start
    )
    for one, other in zip(found, shuffled, strict=True):
        for values, values_shuffled in zip(one, other, strict=True):
            np.testing.assert_allclose(values[order], values_shuffled, rtol=1e-14)
    assert np.array_equal(last.state[order], last_shuffled.state)
    assert set(np.unique(last.state)) == {0, 1, 2, 3, 4}


def test_no_elements() -> None:
    law, places, start = many(0)
    found, last = run(law, places, start)
    assert all(values.shape == (0,) for suction in found for values in suction)
    assert last.state.shape == (0,)
