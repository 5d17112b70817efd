"""One element with suction, or one node with friction, step by step without a model; and numbers of both.

The suction is that of a pipe of 0.3 m in soil of 5 kPa, with corners 0.2 and 0.8.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws.friction import (
    ExtraLimit,
    FrictionForce,
    FrictionHistory,
    FrictionLaw,
    FrictionState,
    slide,
)
from mudline.model.contact.laws.suction import SuctionLaw, SuctionState, breakout_uplift, maximum_force

FREE, COMPRESSION, SUCTION, HOLD, BROKEN = SuctionState
OPEN, STICK, SLIP = FrictionState.OPEN, FrictionState.STICK, FrictionState.SLIP

# -------------------------------------------------------------------------------------------------------------- suction

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


def largest(law: SuctionLaw, v: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """F_max and its derivative by the velocity."""
    with np.errstate(all="ignore"):
        return maximum_force(
            np.asarray(v, np.float64), law.force_factor * law.cyclic, law.force_exponent, law.regularisation
        )


def breakout(law: SuctionLaw, v: ArrayLike) -> FloatArray:
    """The uplift at breakout."""
    found = breakout_uplift(np.asarray(v, np.float64), law.depth_factor, law.depth_exponent, law.regularisation)
    return np.asarray(found)


# ------------------------------------------------------------------------------------------------------------- friction

U1 = np.array([[0.0, 1.0, 0.0]])
U2 = np.array([[0.0, 0.0, 1.0]])


def coulomb(
    coefficients: tuple[float, float],
    stiffness: float | tuple[float, float] = np.nan,
    *,
    mobilisation: float = np.nan,
    ellipse: bool = False,
) -> FrictionLaw:
    """The law of one node."""
    spring = np.broadcast_to(np.asarray(stiffness, dtype=np.float64), (2,)).reshape(1, 2).copy()
    lengths = np.full((1, 2), mobilisation)
    return FrictionLaw(np.array([coefficients]), spring, lengths, np.array([ellipse]), np.array([True]))


def place_at(first: float, second: float, height: float = 0.0) -> FloatArray:
    """A point by its offsets along u1 and u2."""
    return np.array([[height, first, second]])


def anchored(held: FrictionLaw, at: FloatArray | None = None) -> FrictionHistory:
    """A node that touched down at a point, the origin if none is given."""
    place = place_at(0.0, 0.0) if at is None else at
    return slide(held, FrictionHistory.initial(held.active), place, (U1, U2), np.array([1.0])).history


def move(
    held: FrictionLaw,
    history: FrictionHistory,
    to: tuple[float, float],
    compression: float,
    extra: ExtraLimit | None = None,
) -> FrictionForce:
    """One step of a single node."""
    return slide(held, history, place_at(*to), (U1, U2), np.array([compression]), extra)
