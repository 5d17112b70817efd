"""Lateral resistance with a single breakout: `LATERAL=PEAK-RESIDUAL` and `F114` of `*SEABED FRICTION`.

The law scales the lateral limit mu_2 N of friction. s is the largest distance so far, in either direction, along u2
from the place of first contact, and d the displacement of the peak:

    share = 1 up to d, falls linearly to r at the displacement of the residual, r beyond.

Up to d the node does not slip: the spring mu_2 N / d reaches the limit there. It is also the spring of unloading. s
never falls; a node that loses its normal force starts again. d and r may grow with the embedment w = z/D of the node,
the largest before s passed d, at the given positions: d = d_0 + d_1 w, r = min(1, r_0 + r_1 w^0.8). Beyond w = 1 they
have their values at 1 (inferred).
"""

from __future__ import annotations

import numpy as np

from mudline.model.contact.arrays import BoolArray, FloatArray
from mudline.model.contact.laws import Law, Parameter, Reached, Value, where

Numbers = tuple[Value, ...]

F114_RESIDUAL = (0.32, 0.8)
"""Residual resistance over N, and its growth with (z/D)^0.8."""
F114_DISPLACEMENTS = (0.02, 0.25, 1.5)
"""Best estimates over D: breakout displacement, its growth with z/D, and residual displacement."""


def reached(before: Numbers, distance: Value, embedment: Value, law: Numbers) -> Numbers:
    """Return s and w after a step to a distance, at an embedment; `before` has them before, 0 at first contact."""
    far, deep = before
    grows = (far <= law[0] + law[1] * deep) & (embedment > deep)
    return np.maximum(far, np.abs(distance)), where(grows, np.minimum(embedment, 1.0), deep)


def shares(far: Value, deep: Value, law: Numbers) -> tuple[Value, Value, Value]:
    """Return the remaining share of the limit, its decrease per s, and the spring over the spring at w = 0."""
    peak = law[0] + law[1] * deep
    fall = np.maximum(1.0 - (law[2] + law[3] * np.float_power(deep, 0.8)), 0.0)
    span = law[4] - peak
    into = np.minimum(np.maximum(far - peak, 0.0) / span, 1.0)
    return 1.0 - fall * into, where((into > 0.0) & (into < 1.0), fall / span, 0.0), law[0] / peak


def tangent(
    before: FloatArray, after: tuple[FloatArray, FloatArray], distance: FloatArray, limit: FloatArray, law: Numbers
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the remaining share of limits (k,), their derivative by the distance, and the spring over that at w = 0.

    `before` is s before the step, `after` are s and w after it, `limit` are limits without a breakout. w is held.
    """
    share, fall, softer = shares(*after, law)
    grows = np.isfinite(distance) & (after[0] > before)
    return share, np.where(grows, 0.0 - limit * fall * np.sign(distance), 0.0), softer


def _out_of_order(parameters: dict[str, FloatArray]) -> tuple[BoolArray, str]:
    peak = parameters["peak_displacement"] + parameters["peak_growth"]
    return parameters["residual_displacement"] <= peak, "its residual is reached no later than its peak"


def _largest(reached: Reached, parameters: dict[str, FloatArray]) -> tuple[FloatArray, None]:
    """Return the decrease of the lateral resistance after its peak, as an amount; it is smaller at large embedment."""
    fall = reached.lateral * reached.normal_force * np.maximum(1.0 - parameters["residual"], 0.0)
    return fall / (parameters["residual_displacement"] - parameters["peak_displacement"]), None


BREAKOUT = Law(
    name="breakout",
    summary="a single lateral breakout, then a residual",
    stage="friction",
    acts_on="nodes",
    parameters=(
        Parameter("peak_displacement", "L", "d_0, at which the lateral limit of friction is reached", above=True),
        Parameter("peak_growth", "L", "d_1, its growth with z/D", default=0.0),
        Parameter("residual", "1", "r_0, residual over breakout"),
        Parameter("residual_growth", "1", "r_1, its growth with (z/D)^0.8", default=0.0),
        Parameter("residual_displacement", "L", "at which the residual is reached", above=True),
    ),
    history=True,
    state="breakout",
    initial=lambda rows, *_: np.repeat([[np.nan], [np.nan], [np.nan], [0.0], [0.0]], len(rows), axis=1),
    check=_out_of_order,
    plan="with a single lateral breakout, then a residual, where mu2 and Kt2 have no effect",
    largest=_largest,
    equation="limit = mu2 N up to s = d, falling to r mu2 N; s the largest displacement so far",
    source="DNV-RP-F114, residual factor and best estimates of displacements, read at second hand",
)
