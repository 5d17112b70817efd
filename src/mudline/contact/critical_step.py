"""What contact asks of a time step, and of the structure: frequencies, steps, and the stiffness at suction release."""

from __future__ import annotations

import math
from decimal import ROUND_DOWN, Context

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.laws.suction import SuctionLaw, breakout_uplift, maximum_force

_THREE_DIGITS = Context(prec=3, rounding=ROUND_DOWN)

CRITICAL_OMEGA_DT = {
    "central-difference": 2.0,
    "velocity-verlet": 2.0,
    "rk4": 2.0 * math.sqrt(2.0),
    "rk2": 0.0,
    "forward-euler": 0.0,
}
"""Largest omega dt at which an undamped oscillator does not grow; 0 where it grows at every step.

Implicit schemes that are not here have no such limit on linear systems, which says nothing of contact that opens.
"""

ADVISED_OMEGA_DT = 0.5
"""Up to here a landing gains or loses within 3 % of its speed in the usual implicit schemes of second order."""


def omega(stiffness: FloatArray, mass: FloatArray) -> FloatArray:
    """Return the circular frequency sqrt(k / m) of contacts, radians per unit of time.

    `stiffness` k and `mass` m are both per unit length, or both of a node. NaN where there is no frequency: one of
    them is not known, not finite or not above 0.
    """
    with np.errstate(all="ignore"):
        found: FloatArray = np.sqrt(stiffness / mass)
        overflowed = ~np.isfinite(found) | (found == 0.0)
        found = np.where(overflowed, np.sqrt(stiffness) / np.sqrt(mass), found)
    known = np.isfinite(stiffness) & np.isfinite(mass) & (stiffness > 0.0) & (mass > 0.0)
    return np.where(known, found, np.nan)


def critical_step(frequency: FloatArray, omega_dt: float) -> FloatArray:
    """Return the time step at which omega dt has a value; infinite where that is, or where nothing swings (NaN)."""
    with np.errstate(all="ignore"):
        step: FloatArray = omega_dt / frequency
    return np.where(np.isnan(frequency), np.inf, step)


def rounded_down(step: float) -> float:
    """Return a step > 0 with three digits that are not above it: who gives them keeps to the step."""
    return float(_THREE_DIGITS.create_decimal_from_float(step))


def steepest_slope(ratios: FloatArray, slopes: FloatArray) -> float:
    """Return the largest slope that a curve has below the mudline, its continued end included.

    `ratios` (n,) ascend, `slopes` (n - 1,) are those of the segments between them, force per unit length.
    """
    return float(np.append(slopes[ratios[1:] > 0.0], slopes[-1]).max())


def release_stiffness(law: SuctionLaw, velocity: FloatArray) -> FloatArray:
    """Return |d force / d uplift| on the release of suction, per unit length, at steady pull-out velocities > 0 (m,).

    F_max / ((1 - xc2) Delta_B): only a structure that is stiffer, per unit length, has one equilibrium there.
    """
    with np.errstate(all="ignore"):
        force, _ = maximum_force(
            velocity, law.force_factor * law.largest_factor, law.force_exponent, law.regularisation
        )
        uplift = breakout_uplift(velocity, law.depth_factor, law.depth_exponent, law.regularisation)
        slope: FloatArray = force / ((1.0 - law.second_corner) * uplift)
    return slope
