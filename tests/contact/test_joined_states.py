"""The life of a contact, step by step through the whole evaluator: uplift, reversal, breakout, return."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from mudline.contact import ContactModel, ContactResult
from mudline.contact.extras import Extras
from tests.contact.chains import CURVE, LINEAR, at_depths, chain
from tests.contact.joined import heave, model, smoothing, suction, walk
from tests.contact.suction.pulls import BROKEN, COMPRESSION, DEPTH, FORCE, FREE, FULL_CYCLE, HOLD, SUCTION, bridge_law

Moves = Sequence[tuple[float, float]]
K, KU = 50000.0, 500000.0


def pipe(*, unloading: bool = False) -> ContactModel:
    stiff = np.array([KU]) if unloading else None
    return model(chain([LINEAR]), Extras(suction=suction(bridge_law()), unloading=stiff))


def life(contact: ContactModel, moves: Moves) -> tuple[list[float], list[int]]:
    """Force per unit length and state of one element that goes through (depth, pull-out velocity)."""
    depths, rates = zip(*moves, strict=True)
    results = walk(contact, *heave(depths, rates))
    return [result.force.item() for result in results], [_state(result) for result in results]


def _state(result: ContactResult) -> int:
    assert result.state is not None
    return int(result.state[0])


def test_above_a_bed_that_was_never_touched_nothing_holds() -> None:
    forces, states = life(pipe(), [(-0.01, 0.1), (-0.05, 0.1), (0.0, -0.1), (-0.01, 0.1)])
    assert forces == [0.0] * 4
    assert states == [FREE] * 4


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


def test_who_does_not_move_up_does_not_break_out() -> None:
    moves = [(0.02, 0.0), (-0.05, 0.1), (-0.3, 0.0), (-0.3, -0.1), (-0.31, 0.1), (-0.05, -0.1)]
    assert life(pipe(), moves)[1] == [COMPRESSION, SUCTION, HOLD, HOLD, BROKEN, FREE]


def test_creep_then_heave() -> None:
    # Delta_B at v_r = 1e-3 m/s is 0.0488 m, the least that there is: 0.04 m would be on its release
    moves = [(0.02, 0.0), (-0.02, 1e-5), (-0.03, 1e-4), (-0.04, 0.1), (-0.1, 0.1), (-0.17, 0.1)]
    forces, states = life(pipe(), moves)
    assert states == [COMPRESSION, SUCTION, SUCTION, SUCTION, SUCTION, BROKEN]
    assert forces[3:5] == pytest.approx([-FORCE, -FORCE], rel=1e-9)
    assert -20.0 < forces[1] < 0.0
    assert life(pipe(), [(0.02, 0.0), (-0.02, 1e-5), (-0.049, 1e-5)])[1] == [COMPRESSION, SUCTION, BROKEN]


def test_touchdown_and_lift_off_from_far_in_one_step() -> None:
    forces, states = life(pipe(), [(-1e6, -1e6), (1.0, -1e6), (-1e6, 1e6), (-1.0, -1e6), (0.5, -1e6)])
    assert states == [FREE, COMPRESSION, BROKEN, FREE, COMPRESSION]
    assert forces == pytest.approx([0.0, 5e4, 0.0, 0.0, 2.5e4])


def test_at_the_mudline_itself() -> None:
    forces, states = life(pipe(), [(0.0, 0.0), (0.02, -0.1), (0.0, 0.1), (-0.0, -0.1), (0.0, 0.0)])
    assert states == [FREE, COMPRESSION, SUCTION, HOLD, HOLD]
    assert forces == [0.0, 1000.0, 0.0, 0.0, 0.0]
    assert not np.signbit(forces).any()


def test_full_cycle_with_unloading_on_a_linear_bed() -> None:
    forces, states = life(pipe(unloading=True), FULL_CYCLE)
    uplift = [-FORCE / 2, -FORCE, 0.0, -FORCE / 2, 0.0]
    assert forces == pytest.approx([0.0, 2500.0, 1250.0, *uplift, 0.0, 1250.0, 3000.0, -FORCE], rel=1e-9, abs=1e-9)
    lifting = [SUCTION, SUCTION, HOLD, SUCTION, BROKEN]
    assert states == [FREE, COMPRESSION, COMPRESSION, *lifting, FREE, COMPRESSION, COMPRESSION, SUCTION]


def test_full_cycle_on_a_curve() -> None:
    """0.06 m are a ratio of 0.2: 3250 N/m, and 67 kN/m2 is the steepest slope on the way; ku = 500 kN/m2."""
    contact = model(chain([CURVE]), Extras(suction=suction(bridge_law()), unloading=np.array([KU])))
    bottom = 0.06 - 3250.0 / KU
    moves = [(0.06, -0.1), (0.058, 0.1), (bottom, 0.1), (bottom - 0.5 * DEPTH, 0.1), (0.01, -0.1), (0.058, -0.1)]
    forces, states = life(contact, [*moves, (0.06, -0.1), (0.09, -0.1)])
    assert forces == pytest.approx([3250.0, 2250.0, 0.0, -FORCE, 0.0, 2250.0, 3250.0, 4500.0], rel=1e-9, abs=1e-9)
    assert states == [COMPRESSION, COMPRESSION, SUCTION, SUCTION, HOLD, *[COMPRESSION] * 3]


def test_a_closed_cycle_takes_work() -> None:
    down = np.linspace(-0.3, 0.05, 351)
    depths = np.concatenate([down, down[-2::-1]])
    rates = np.where(np.arange(len(depths)) < len(down), -0.1, 0.1)
    forces = np.array(life(pipe(unloading=True), list(zip(depths.tolist(), rates.tolist(), strict=True)))[0])
    lost = np.sum(0.5 * (forces[1:] + forces[:-1]) * np.diff(depths))
    assert lost == pytest.approx(0.5 * 2500.0**2 * (1.0 / K - 1.0 / KU) + 178.18238727, rel=2e-3)


@pytest.mark.parametrize("one_sided", [False, True])
def test_the_uplift_begins_where_the_zone_ends(one_sided: bool) -> None:
    extras = Extras(suction=suction(bridge_law()), smoothing=smoothing(1, 0.005, one_sided=one_sided))
    start = 0.0 if one_sided else -0.005
    forces, states = life(model(chain([LINEAR]), extras), [(0.02, 0.0), (start, 0.1), (start - 0.1 * DEPTH, 0.1)])
    assert forces[1:] == pytest.approx([0.0, -FORCE / 2], rel=1e-9)
    assert states == [COMPRESSION, SUCTION, SUCTION]


def test_depth_and_velocity_are_means_of_both_nodes() -> None:
    places = at_depths([[0.02, 0.02], [0.03, -0.19161650169]])  # the mean uplift is half of Delta_B at 0.1 m/s
    rates = np.zeros_like(places)
    rates[1, :, 0] = [-0.3, 0.5]
    rates[1, :, 1] = [7.0, -9.0]  # along the bed
    result = walk(pipe(), places, rates)[1]
    assert result.state is not None
    assert result.state.tolist() == [SUCTION]
    assert result.normal_force == pytest.approx([-FORCE, -FORCE], rel=1e-9)


def test_two_diameters_break_out_one_after_the_other() -> None:
    inputs = replace(chain([LINEAR] * 2, diameter=[0.3, 0.5]))
    law = bridge_law(2, [5000.0, 2000.0], [0.3, 0.5])
    contact = model(inputs, Extras(suction=suction(law)))
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
