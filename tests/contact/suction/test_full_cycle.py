"""Penetration, unloading, suction from the trench bottom, breakout, re-penetration: both laws together."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.contact.laws.unloading import UnloadingHistory, VirginPath
from mudline.contact.laws.unloading import step as unload
from mudline.contact.suction import SuctionHistory, maximum_force, suction_depth
from mudline.contact.suction import step as suck
from tests.contact.suction.pulls import (
    BROKEN,
    COMPRESSION,
    FORCE,
    FREE,
    FULL_CYCLE,
    HOLD,
    SUCTION,
    bridge_law,
    floats,
)

K, KU = 50000.0, 500000.0

Cycle = tuple[list[float], list[int]]


def cycle(moves: list[tuple[float, float]]) -> Cycle:
    """Net force and state over (penetration, pull-out velocity) of one element."""
    law, trench, held = bridge_law(), UnloadingHistory.initial(floats(KU)), SuctionHistory.initial(1)
    net, states = [], []
    for place, velocity in moves:
        z = floats(place)
        slope = np.where(z > 0.0, K, 0.0)
        reaction, trench = unload(trench, z, VirginPath(K * np.maximum(z, 0.0), slope, slope))
        suction, held = suck(law, held, reaction.uplift, floats(velocity), reaction.compressed)
        net.append((reaction.force + suction.force).item())
        states.append(held.state.item())
    return net, states


def test_full_cycle() -> None:
    net, states = cycle(FULL_CYCLE)
    down = [0.0, 2500.0, 1250.0]
    up = [-FORCE / 2, -FORCE, 0.0, -FORCE / 2, 0.0]
    again = [0.0, 1250.0, 3000.0, -FORCE]
    assert net == pytest.approx([*down, *up, *again], rel=1e-9, abs=1e-9)
    lifting = [SUCTION, SUCTION, HOLD, SUCTION, BROKEN]
    assert states == [FREE, COMPRESSION, COMPRESSION, *lifting, FREE, COMPRESSION, COMPRESSION, SUCTION]


def test_reversal_into_the_trench_reloads_along_the_unloading_line() -> None:
    net, states = cycle([(0.05, -0.1), (0.03, 0.1), (0.046, -0.1), (0.05, -0.1), (0.03, 0.1)])
    assert states == [COMPRESSION, SUCTION, COMPRESSION, COMPRESSION, SUCTION]
    assert net[2:4] == pytest.approx([500.0, 2500.0], rel=1e-9)
    assert net[4] == net[1] < 0.0


@pytest.mark.parametrize("velocity", [1e-4, 0.1, 2.0])
def test_a_whole_cycle_takes_the_work_of_both_laws(velocity: float) -> None:
    law, down = bridge_law(), np.linspace(-0.5, 0.05, 1101)
    places = np.concatenate([down, down[-2::-1]])
    rates = np.where(np.arange(len(places)) < len(down), -velocity, velocity)
    net = np.array(cycle(list(zip(places.tolist(), rates.tolist(), strict=True)))[0])
    work = np.sum(0.5 * (net[1:] + net[:-1]) * np.diff(places))
    of_bed = 0.5 * 2500.0**2 / K - 0.5 * 2500.0**2 / KU
    largest, depth = maximum_force(law, floats(velocity))[0], suction_depth(law, floats(velocity))
    assert work == pytest.approx(of_bed + (largest * depth).item() * 0.8, rel=1e-3)
