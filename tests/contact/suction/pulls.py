"""Suction laws and pulls for the tests: a pipe of 0.3 m in soil of 5 kPa, corners 0.2 and 0.8."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mudline.contact.arrays import FloatArray
from mudline.contact.suction import Suction, SuctionHistory, SuctionLaw, SuctionState, from_cohesion, step

FORCE = 1378.5656595
"""Largest suction at 0.1 m/s, N/m."""
DEPTH = 0.16156501691
"""Uplift at breakout at 0.1 m/s, m."""

BOTTOM = 0.045
"""Bottom of the trench behind a penetration of 0.05 m, with K = 50 kN/m2 and ten times that on the way back."""
FULL_CYCLE = [
    (-0.01, -0.1),
    (0.05, -0.1),
    (0.0475, 0.1),
    (BOTTOM - 0.1 * DEPTH, 0.1),
    (BOTTOM - 0.5 * DEPTH, 0.1),
    (BOTTOM - 0.4 * DEPTH, -0.1),
    (BOTTOM - 0.9 * DEPTH, 0.1),
    (BOTTOM - 1.1 * DEPTH, 0.1),
    (0.04, -0.1),
    (0.0475, -0.1),
    (0.06, -0.1),
    (0.0, 0.1),
]
"""Penetration, unloading, suction, a stop, breakout, and down again: penetrations and pull-out velocities."""

FREE, COMPRESSION, SUCTION, HOLD, BROKEN = SuctionState


def floats(values: ArrayLike, elements: int = 1) -> FloatArray:
    return np.broadcast_to(np.asarray(values, np.float64), (elements,)).copy()


def bridge_law(
    elements: int = 1,
    cohesion: ArrayLike = 5000.0,
    diameter: ArrayLike = 0.3,
    regularisation: ArrayLike = 1e-3,
    corners: tuple[float, float] = (0.2, 0.8),
) -> SuctionLaw:
    factors = from_cohesion(floats(cohesion, elements), floats(diameter, elements))
    first, second = (floats(corner, elements) for corner in corners)
    return SuctionLaw(*factors, first, second, floats(1.0, elements), floats(regularisation, elements)).checked()


def lifted(elements: int = 1, v_max: ArrayLike = 0.0) -> SuctionHistory:
    """Elements in the middle of an uplift episode."""
    state = np.full(elements, SUCTION, np.int8)
    return SuctionHistory(np.ones(elements, np.bool_), floats(v_max, elements), state)


class Walk(NamedTuple):
    """What one element did, by step."""

    forces: list[float]
    states: list[int]
    depths: list[float]
    last: SuctionHistory


def walk(law: SuctionLaw, moves: Sequence[tuple[float, float]], history: SuctionHistory | None = None) -> Walk:
    """Take one element through (uplift, velocity); it is compressed where the uplift is negative."""
    history = SuctionHistory.initial(1) if history is None else history
    forces, states, depths = [], [], []
    for uplift, velocity in moves:
        suction, history = step(law, history, floats(uplift), floats(velocity), np.array([uplift < 0.0]))
        forces.append(suction.force.item())
        states.append(history.state.item())
        depths.append(suction.depth.item())
    return Walk(forces, states, depths, history)


def pull(law: SuctionLaw, uplift: ArrayLike, velocity: ArrayLike, v_max: ArrayLike = 0.0) -> Suction:
    """The suction of elements in the middle of an uplift episode."""
    elements = len(law.cyclic)
    above = np.zeros(elements, np.bool_)
    return step(law, lifted(elements, v_max), floats(uplift, elements), floats(velocity, elements), above)[0]
