"""The life of a contact, step by step through the whole evaluator: uplift, reversal, breakout, return, cycles."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from mudline.model.contact import ContactModel, ContactResult
from tests.helpers.builders.contact import (
    LINEAR,
    at_depths,
    bridge_law,
    chain,
    floats,
    heave,
    on,
    stepped,
    suction,
    walk,
)
from tests.model.contact.single import (
    BROKEN,
    COMPRESSION,
    DEPTH,
    FORCE,
    FREE,
    FULL_CYCLE,
    HOLD,
    SUCTION,
    breakout,
    largest,
)

Moves = Sequence[tuple[float, float]]
K, KU = 50000.0, 500000.0


def pipe(*, unloading: bool = False) -> ContactModel:
    return ContactModel(chain([LINEAR], suction(bridge_law()), on("unloading", int(unloading), stiffness=KU)))


def life(contact: ContactModel, moves: Moves) -> tuple[list[float], list[int]]:
    """Force per unit length and state of one element that goes through (depth, pull-out velocity)."""
    depths, rates = zip(*moves, strict=True)
    results = walk(contact, *heave(depths, rates))
    return [result.force.item() for result in results], [_state(result) for result in results]


def _state(result: ContactResult) -> int:
    assert result.state is not None
    return int(result.state[0])


def test_pull_out_and_return() -> None:
    moves = [(0.02, -0.1), (-0.0808, 0.1), (-1.1 * DEPTH, 0.1), (-0.2, 0.1), (-0.1, -0.1), (-0.01, 0.1), (0.01, -0.1)]
    forces, states = life(pipe(), [*moves, (-0.0808, 0.1)])
    assert states == [COMPRESSION, SUCTION, BROKEN, BROKEN, FREE, FREE, COMPRESSION, SUCTION]
    assert forces == pytest.approx([1000.0, -FORCE, 0.0, 0.0, 0.0, 0.0, 500.0, -FORCE], rel=1e-9)


def test_slowing_down_keeps_the_depth_and_lowers_the_force() -> None:
    forces, states = life(pipe(), [(0.02, 0.0), (-0.05, 0.1), (-0.1, 0.01), (-0.12, 0.001), (-0.9 * DEPTH, 0.01)])
    assert states == [COMPRESSION, *[SUCTION] * 4]
    # at 0.01 m/s alone the pipe would have broken out at 0.0888 m
    assert forces[1:] == pytest.approx([-FORCE, -910.80929887, -601.76573615, -0.5 * 910.80929887], rel=1e-9)


def test_reversal_in_suction_lets_go_and_holds_on() -> None:
    moves = [(0.02, 0.0), (-0.05, 0.1), (-0.04, -0.1), (-0.04, 0.0), (-0.05, 0.1), (0.01, -0.1), (-0.05, 0.01)]
    forces, states = life(pipe(), moves)
    assert states == [COMPRESSION, SUCTION, HOLD, HOLD, SUCTION, COMPRESSION, SUCTION]
    assert forces == pytest.approx([1000.0, -FORCE, 0.0, 0.0, -FORCE, 500.0, -910.80929887], rel=1e-9)


def test_at_the_mudline_itself() -> None:
    forces, states = life(pipe(), [(0.0, 0.0), (0.02, -0.1), (0.0, 0.1), (-0.0, -0.1), (0.0, 0.0)])
    assert states == [FREE, COMPRESSION, SUCTION, HOLD, HOLD]
    assert forces == [0.0, 1000.0, 0.0, 0.0, 0.0]
    assert not np.signbit(forces).any()


def test_depth_and_velocity_are_means_of_both_nodes() -> None:
    places = at_depths([[0.02, 0.02], [0.03, -0.19161650169]])  # the mean uplift is half of Delta_B at 0.1 m/s
    rates = np.zeros_like(places)
    rates[1, :, 0] = [-0.3, 0.5]
    rates[1, :, 1] = [7.0, -9.0]  # along the seabed
    result = walk(pipe(), places, rates)[1]
    assert result.state is not None
    assert result.state.tolist() == [SUCTION]
    assert result.normal_force == pytest.approx([-FORCE, -FORCE], rel=1e-9)


def test_two_diameters_break_out_one_after_the_other() -> None:
    law = bridge_law(2, [5000.0, 2000.0], [0.3, 0.5])
    contact = ContactModel(chain([LINEAR] * 2, suction(law), diameter=[0.3, 0.5]))
    depths = [0.02, -0.08, -0.17, -0.3, -0.37]
    results = walk(contact, *heave(depths, [0.0, *[0.3] * 4], nodes=3))
    small, large = 0.294 * 0.3**0.26, 0.35830065844  # Delta_B at 0.3 m/s
    assert 0.17 < small < 0.3 < large < 0.37
    assert [result.state.tolist() for result in results if result.state is not None] == [
        [COMPRESSION, COMPRESSION],
        [SUCTION, SUCTION],
        [SUCTION, SUCTION],
        [BROKEN, SUCTION],
        [BROKEN, BROKEN],
    ]
    assert results[1].force[1] == pytest.approx(-1021.6102644, rel=1e-10)
    assert results[3].normal_force[0] == 0.0
    assert results[3].normal_force[1:] == pytest.approx([results[3].force[1]] * 2)


# ------------------------------------------------------------------------------------------------------- with unloading


def test_full_cycle_with_unloading_on_a_linear_seabed() -> None:
    forces, states = life(pipe(unloading=True), FULL_CYCLE)
    uplift = [-FORCE / 2, -FORCE, 0.0, -FORCE / 2, 0.0]
    assert forces == pytest.approx([0.0, 2500.0, 1250.0, *uplift, 0.0, 1250.0, 3000.0, -FORCE], rel=1e-9, abs=1e-9)
    lifting = [SUCTION, SUCTION, HOLD, SUCTION, BROKEN]
    assert states == [FREE, COMPRESSION, COMPRESSION, *lifting, FREE, COMPRESSION, COMPRESSION, SUCTION]


@pytest.mark.parametrize("velocity", [1e-4, 0.1, 2.0])
def test_a_whole_cycle_takes_the_work_of_both_laws(velocity: float) -> None:
    law, down = bridge_law(), np.linspace(-0.5, 0.05, 1101)
    depths = np.concatenate([down, down[-2::-1]])
    rates = np.where(np.arange(len(depths)) < len(down), -velocity, velocity)
    positions, velocities = heave(depths, rates)
    forces = pipe(unloading=True).evaluate(positions, velocities=velocities).force[:, 0]
    work = np.sum(0.5 * (forces[1:] + forces[:-1]) * np.diff(depths))
    of_seabed = 0.5 * 2500.0**2 / K - 0.5 * 2500.0**2 / KU
    force, uplift = largest(law, floats(velocity))[0], breakout(law, floats(velocity))
    assert work == pytest.approx(of_seabed + (force * uplift).item() * 0.8, rel=1e-3)


def test_a_spring_against_uplift_acts_above_the_seabed_whatever_the_trench() -> None:
    """Trench bottom 0.045 m; the spring of 800 N/m2 reaches 0.1 m above the mudline, with and without unloading."""
    spring = on("suction spring", 1, stiffness=800.0, extent=0.1)
    depths = [-0.02, 0.05, 0.0475, 0.03, 0.0, -0.05, -0.1, -0.11, 0.0475]
    with_line = ContactModel(chain([LINEAR], spring, on("unloading", 1, stiffness=KU)))
    result = with_line.evaluate(heave(depths, np.zeros(9))[0])
    assert result.force.ravel() == pytest.approx(
        [-16.0, 2500.0, 1250.0, 0.0, 0.0, -40.0, -80.0, 0.0, 1250.0], rel=1e-9, abs=1e-9
    )
    assert result.stiffness.ravel() == pytest.approx([800.0, K, KU, 0.0, 0.0, 800.0, 800.0, 0.0, KU])
    assert result.slope.ravel() == pytest.approx(0.3 * result.stiffness.ravel())
    above = [depth <= 0.0 for depth in depths]
    bare = ContactModel(chain([LINEAR], spring)).evaluate(heave(depths, np.zeros(9))[0])
    assert np.array_equal(bare.force[above], result.force[above])


# --------------------------------------------------------------------------------------------------------------- cycles

UP, OUT, DOWN, REST = (-0.05, 0.1), (-0.3, 0.1), (0.02, -0.1), (-0.01, -0.1)
"""Suction fully mobilised, breakout, compression, lifted without moving up."""


def factors(moves: Moves, *, per_cycle: float = 0.9, floor: float = 0.5, unloading: bool = False) -> list[float]:
    """The cyclic factor behind each step of one element."""
    law = bridge_law()._replace(cyclic=floats(per_cycle), cyclic_floor=floats(floor))
    line = on("unloading", int(unloading), stiffness=KU)
    depths, rates = zip(*moves, strict=True)
    steps = stepped(ContactModel(chain([LINEAR], suction(law), line)), *heave(depths, rates))
    return [state.suction.factor.item() for _, state in steps if state.suction is not None]


def test_each_completed_cycle_lowers_the_suction_down_to_its_floor() -> None:
    """A cycle ends as the element is compressed again after it was pulled up."""
    found = factors([DOWN, *[UP, DOWN] * 10])
    assert found[::2] == pytest.approx([max(0.9**cycle, 0.5) for cycle in range(11)])
    assert found[1::2] == found[:-1:2]
    assert found[-3:] == [0.5] * 3


def test_a_breakout_ends_a_cycle_and_the_landing_behind_it_does_not_end_another() -> None:
    found = factors([DOWN, *[UP, OUT, REST, DOWN] * 3])
    assert found == pytest.approx([1.0, *(0.9**cycle for k in range(3) for cycle in (k, k + 1, k + 1, k + 1))])


def test_the_force_of_a_cycle_is_that_of_its_factor() -> None:
    law = bridge_law(2)._replace(cyclic=floats(0.9, 2), cyclic_floor=np.array([0.5, np.nan]))
    contact = ContactModel(chain([LINEAR] * 2, suction(law)))
    depths, rates = zip(*[DOWN, *[UP, DOWN] * 9], strict=True)
    results = walk(contact, *heave(depths, rates, nodes=3))
    pulled = [result.force.tolist() for result in results[1::2]]
    # without a floor the factor is applied once, always
    assert [each[0] for each in pulled] == pytest.approx([-FORCE * max(0.9**cycle, 0.5) for cycle in range(9)])
    assert [each[1] for each in pulled] == pytest.approx([-0.9 * FORCE] * 9)
