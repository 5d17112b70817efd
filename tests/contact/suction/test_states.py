"""States and transitions: what an element goes through between contact and breakout."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.contact.laws.suction import SuctionHistory, SuctionState, step
from tests.builders.contact import bridge_law, floats
from tests.contact.bits import same_bits
from tests.contact.single import BROKEN, COMPRESSION, DEPTH, FORCE, FREE, HOLD, SUCTION, lift

REST = 0.048791855079
"""Uplift at breakout at the regularisation velocity."""


def test_states_are_small_numbers() -> None:
    assert [(state.name, state.value) for state in SuctionState] == [
        ("FREE", 0),
        ("COMPRESSION", 1),
        ("SUCTION", 2),
        ("HOLD", 3),
        ("BROKEN", 4),
    ]
    assert SuctionHistory.initial(bridge_law(3)).state.dtype == np.int8


def test_never_touched_never_held() -> None:
    path = lift(bridge_law(), [(0.01, 0.1), (0.02, 0.1), (1.0, 0.1), (0.05, -0.1), (0.0, -0.1)])
    assert path.states == [FREE] * 5
    assert path.forces == [0.0] * 5
    assert not path.last.armed.any()


def test_pull_out() -> None:
    shares = (-0.1, 0.1, 0.5, 0.9, 1.0 + 1e-9, 1.5)
    path = lift(bridge_law(), [(share * DEPTH, 0.1) for share in shares])
    assert path.states == [COMPRESSION, SUCTION, SUCTION, SUCTION, BROKEN, BROKEN]
    assert path.forces == pytest.approx([0.0, -FORCE / 2, -FORCE, -FORCE / 2, 0.0, 0.0], rel=1e-9)
    assert not path.last.armed.any()


def test_velocity_in_compression_does_not_count() -> None:
    path = lift(bridge_law(), [(-0.05, 5.0), (-0.01, 5.0), (0.01, 0.1)])
    assert path.last.v_max.tolist() == [0.1]
    assert path.depths == pytest.approx([REST, REST, DEPTH], rel=1e-9)


def test_slowing_down_keeps_the_depth_and_lowers_the_force() -> None:
    path = lift(bridge_law(), [(-0.01, 0.1), (0.04, 0.1), (0.06, 0.01), (0.07, 1e-4), (0.08, 0.0)])
    assert path.depths[1:] == pytest.approx([DEPTH] * 4, rel=1e-9)
    assert path.states == [COMPRESSION, SUCTION, SUCTION, SUCTION, HOLD]
    assert path.forces[1:3] == pytest.approx([-FORCE, -910.80929887], rel=1e-9)
    assert path.forces[2] < path.forces[3] < path.forces[4] == 0.0


def test_reversal_in_suction_and_on_again() -> None:
    path = lift(bridge_law(), [(-0.01, 0.1), (0.05, 0.1), (0.04, -0.1), (0.03, -0.2), (0.05, 0.05), (0.2, 0.05)])
    assert path.states == [COMPRESSION, SUCTION, HOLD, HOLD, SUCTION, BROKEN]
    assert path.forces[2:4] == [0.0, 0.0]
    assert path.depths[1:] == pytest.approx([DEPTH] * 5, rel=1e-9)


def test_contact_again_begins_a_new_episode() -> None:
    path = lift(bridge_law(), [(-0.01, 0.1), (0.05, 0.1), (-0.01, -0.1), (0.01, 0.01)])
    assert path.states == [COMPRESSION, SUCTION, COMPRESSION, SUCTION]
    assert path.depths[2:] == pytest.approx([REST, 0.08878658058], rel=1e-9)
    assert path.last.v_max.tolist() == [0.01]


def test_only_new_compression_arms_again() -> None:
    moves = [(-0.01, 0.1), (0.2, 0.1), (0.1, -0.1), (0.15, 0.1), (0.0, -0.1), (-0.01, -0.1), (0.05, 0.1)]
    path = lift(bridge_law(), moves)
    assert path.states == [COMPRESSION, BROKEN, FREE, FREE, FREE, COMPRESSION, SUCTION]
    assert path.forces[1:6] == [0.0] * 5
    assert path.forces[6] == pytest.approx(-FORCE, rel=1e-9)


def test_broken_ends_below_the_height_of_breakout_and_does_not_come_back() -> None:
    path = lift(bridge_law(), [(-0.01, 0.1), (0.17, 0.1), (0.3, 2.0), (0.162, -1.0), (0.16, -1.0), (0.3, 0.1)])
    assert path.states == [COMPRESSION, BROKEN, BROKEN, BROKEN, FREE, FREE]
    assert path.depths[1:4] == pytest.approx([DEPTH] * 3, rel=1e-9)
    assert path.last.v_max.tolist() == [0.0]


def test_hold_comes_before_breakout() -> None:
    path = lift(bridge_law(), [(-0.01, 0.1), (0.3, 0.0), (0.3, -0.1), (0.3, 0.1)])
    assert path.states == [COMPRESSION, HOLD, HOLD, BROKEN]
    assert path.forces == [0.0] * 4


def test_at_the_mudline_itself() -> None:
    assert lift(bridge_law(), [(-0.01, 0.1), (0.0, 0.1)]).states == [COMPRESSION, SUCTION]
    assert lift(bridge_law(), [(-0.01, 0.1), (0.0, -0.1)]).states == [COMPRESSION, HOLD]
    assert lift(bridge_law(), [(-0.01, 0.1), (0.0, 0.1)]).forces == [0.0, 0.0]


def test_over_the_whole_trapezoid_in_one_step() -> None:
    path = lift(bridge_law(), [(-0.01, 0.1), (5.0, 0.1)])
    assert path.states == [COMPRESSION, BROKEN]
    assert path.depths[1] == pytest.approx(DEPTH, rel=1e-9)
    assert path.last.v_max.tolist() == [0.1]


def test_one_fast_step_makes_its_own_depth() -> None:
    path = lift(bridge_law(), [(-0.01, 0.0), (0.2, 2.0)])
    assert path.states == [COMPRESSION, SUCTION]
    assert path.depths[1] == pytest.approx(0.294 * 2**0.26, rel=1e-9)


def test_creep_then_heave() -> None:
    creep = [(-0.001, 1e-6), (0.01, 1e-6), (0.03, 1e-6)]
    path = lift(bridge_law(), [*creep, (0.04, 0.1), (0.15, 0.1), (0.17, 0.1)])
    assert path.states == [COMPRESSION, SUCTION, SUCTION, SUCTION, SUCTION, BROKEN]
    assert path.depths[:3] == pytest.approx([REST] * 3, rel=1e-9)
    assert path.depths[3:] == pytest.approx([DEPTH] * 3, rel=1e-9)
    assert -2.0 < path.forces[1] < 0.0
    assert path.forces[3] == pytest.approx(-FORCE, rel=1e-9)
    broken = lift(bridge_law(), [*creep, (0.05, 1e-6), (0.06, 0.1)])
    assert broken.states[3:] == [BROKEN, BROKEN]
    assert broken.forces[3:] == [0.0, 0.0]


def test_the_old_history_is_not_changed() -> None:
    law = bridge_law()
    old = lift(law, [(-0.01, 0.1), (0.05, 0.1)]).last
    kept = SuctionHistory(old.flags.copy(), old.numbers.copy())
    for uplift, velocity in ((0.06, 1.0), (0.3, 0.1), (-0.1, 0.0), (0.05, -0.1)):
        lift(law, [(uplift, velocity)], old)
        assert same_bits(old, kept)


def test_a_step_gives_every_value_anew() -> None:
    law, above = bridge_law(2), np.zeros(2, np.bool_)
    touched = step(law, SuctionHistory.initial(law), floats(-0.01, 2), floats(0.1, 2), ~above)[1]
    out = step(law, touched, floats(0.05, 2), floats(0.1, 2), above)
    held = step(law, out[1], floats(0.04, 2), floats(-0.1, 2), above)
    kept = out[1].flags.copy(), out[1].numbers.copy()
    back = step(law, held[1], np.array([0.05, -0.01]), floats(0.1, 2), np.array([False, True]))
    assert back[1].state.tolist() == [SUCTION, COMPRESSION]
    assert back[1].armed.tolist() == [True, True]
    assert back[1].v_max.tolist() == [0.1, 0.0]
    assert back[0].force == pytest.approx([-FORCE, 0.0], rel=1e-9)
    assert np.array_equal(out[1].flags, kept[0])
    assert np.array_equal(out[1].numbers, kept[1])
    assert same_bits(SuctionHistory.of(law, back[1].armed, back[1].v_max, back[1].state, back[1].factor), back[1])
