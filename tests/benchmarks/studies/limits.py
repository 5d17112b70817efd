"""Critical steps of explicit schemes on an oscillator."""

from __future__ import annotations

import math

import numpy as np

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


def critical_step(scheme: str, frequency: float, rate: float = 0.0) -> float:
    """Return the largest time step at which x'' = -omega^2 x - gamma x' does not grow under a scheme.

    `frequency` is omega = sqrt(k / m), `rate` gamma = c / m of the damping c, both >= 0. Infinite without both, and
    for schemes that are not explicit. The damping acts as the schemes see it:

    * central difference, which sees the velocity of the half step before: (omega dt)^2 + 2 gamma dt < 4;
    * velocity Verlet, which predicts it from the acceleration before the step: (omega dt)^2 + 4 gamma dt < 4;
    * Runge-Kutta: |1 + z + ... + z^p / p!| <= 1 for the root z / dt of the equation with the larger amount.
    """
    if scheme not in CRITICAL_OMEGA_DT or not (frequency > 0.0 or rate > 0.0):
        return math.inf
    if scheme == "central-difference":
        return 4.0 / (rate + math.hypot(rate, 2.0 * frequency))
    if scheme == "velocity-verlet":
        return 2.0 / (rate + math.hypot(rate, frequency))
    half = 0.5 * rate
    if half >= frequency:  # two real roots: this is the faster one
        return _radius(_ORDERS[scheme], -1.0) / (half + math.sqrt((half - frequency) * (half + frequency)))
    return _radius(_ORDERS[scheme], -half / frequency) / frequency


_ORDERS = {"rk4": 4, "rk2": 2, "forward-euler": 1}
_ROUNDING = 1e-14


def _radius(order: int, cosine: float) -> float:
    """How far the stability region of a Runge-Kutta scheme of order 1 to 4 reaches in a direction of the left half.

    |R(z)|^2 - 1 on the ray z = r (cosine + i sine) is a polynomial in r without a constant.
    """
    direction = complex(cosine, math.sqrt(1.0 - cosine * cosine))
    terms = np.array([direction**power / math.factorial(power) for power in range(order + 1)])
    growth = np.convolve(terms, terms.conj()).real[1:]
    growth[np.abs(growth) < _ROUNDING] = 0.0
    lowest = growth[np.flatnonzero(growth)[0]]
    if lowest > 0.0:
        return 0.0
    roots = np.roots(growth[::-1])
    return float(roots.real[(np.abs(roots.imag) < 1e-6 * np.abs(roots)) & (roots.real > 0.0)].min())
