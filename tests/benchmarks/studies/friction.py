"""Static solutions: Newton's method on friction that finds none, and several of them during the release of suction.

A structure of stiffness kb, held by a friction spring kt up to mu N, is pulled with a force F:

    r(u) = kb u + clip(kt u, -mu N, mu N) - F.

From where it slips, with 0 <= F < mu N, the next iterate is (F - mu N) / kb, which slips the other way where

    kt / kb > 1 / (1 - F / (mu N));

from there it is (F + mu N) / kb, which slips too: the iterates alternate between the two without end. Two remedies:

* corrections that are halved until the residual falls. Beside the limit, at u = mu N / kt, the correction is
  about (mu N - F) / kb, and the residual falls only within 2 (mu N - F) / (kb + kt) of it: about log2(kt / kb) - 1
  halvings are needed, and with a lower cap some starts do not converge;
* a bracket, which keeps the two nearest points between which the residual changes its sign, and is halved where
  Newton's method would leave it.

On its release suction falls with the slope F_max / ((1 - xc2) Delta_B). A pipe suspended from a structure of stiffness
ks (per unit length), whose far end is raised slowly, has one equilibrium at each height only for a greater ks.

Friction and suction are those of the evaluator.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws.friction import FrictionHistory, FrictionLaw, slide
from mudline.model.contact.laws.suction import (
    SuctionHistory,
    SuctionLaw,
    breakout_uplift,
    from_cohesion,
    release_stiffness,
)
from tests.benchmarks.studies.laws import DIAMETER
from tests.benchmarks.studies.newton import Newton
from tests.benchmarks.studies.suction import step
from tests.benchmarks.tables import save

CYCLES, RELEASE = "stability-newton-cycles", "stability-release"
STARTS = np.linspace(-20.0, 20.0, 101)
RATIOS, FORCES = (1.0, 9.0, 99.0, 1e4, 1e6), (0.1, 0.5, 0.9)
"""kt / kb, and F / (mu N), with kb = 1 and mu N = 10."""
CAPS = (5, 10, 15, 20)
VELOCITIES = (1e-3, 1e-2, 1e-1, 1.0)
SHARES = (0.5, 0.99, 1.01, 2.0)
"""Structural stiffness over the one that is needed."""
_LIMIT = 10.0


def residual(spring: float, force: float, u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Residuals at displacements (k,), their derivatives, and their largest terms."""
    count = len(u)
    ones = np.ones((count, 2))
    law = FrictionLaw(ones, spring * ones, np.nan * ones, np.zeros(count, np.bool_), np.ones(count, np.bool_))
    stuck = FrictionHistory(np.zeros((count, 3)), np.ones((count, 2), np.int8))
    points = np.column_stack([np.zeros(count), u, np.zeros(count)])
    along, across = np.tile([0.0, 1.0, 0.0], (count, 1)), np.tile([0.0, 0.0, 1.0], (count, 1))
    held = slide(law, stuck, points, (along, across), np.full(count, _LIMIT))
    friction = held.force[:, 0]
    size = np.maximum(np.maximum(np.abs(u), np.abs(friction)), abs(force))
    return u - friction - force, 1.0 - held.by_position[:, 0, 0], size


def lost(spring: float, share: float, newton: Newton) -> int:
    """From how many of `STARTS` a solution does not converge."""
    return int((newton.solve(partial(residual, spring, share * _LIMIT), STARTS).residual != 0.0).sum())


def threshold(share: float) -> float:
    """The kt / kb above which Newton's method cycles from where friction slips, at F = share mu N."""
    return 1.0 / (1.0 - share)


def equilibria(law: SuctionLaw, velocity: float, structure: float) -> int:
    """The largest number of equilibria at one height of the structure's end, up to 1.5 times the uplift at breakout.

    At uplift x the end stands at x + suction / ks: where that falls as x grows, a height belongs to several uplifts.
    """
    depth = breakout_uplift(velocity, law.depth_factor, law.depth_exponent, law.regularisation)
    uplift = np.linspace(0.0, 1.5 * float(depth[0]), 4001)[1:]
    count = len(uplift)
    rows, none = SuctionLaw(*(np.repeat(values, count) for values in law)), np.zeros(count)
    _, armed = step(rows, SuctionHistory.initial(rows), none, none, np.ones(count, np.bool_))
    pulled, _ = step(rows, armed, uplift, np.full(count, velocity), np.zeros(count, np.bool_))
    height = uplift - pulled.force / structure
    levels = 0.5 * (np.sort(height)[1:] + np.sort(height)[:-1])
    low, high = np.minimum(height[1:], height[:-1]), np.maximum(height[1:], height[:-1])
    starts, ends = np.searchsorted(np.sort(low), levels, "left"), np.searchsorted(np.sort(high), levels, "right")
    return int((starts - ends).max())


def run(progress: Callable[[str], None]) -> None:
    """Write tables."""
    progress("Newton's method on friction, release of suction")
    heads = ["kt / kb [-]", "F / mu N [-]", "cycles above kt / kb", "plain", *(f"{cap} halvings" for cap in CAPS),
             "bracketed", "most iterations, bracketed"]  # fmt: skip
    rows = []
    for spring in RATIOS:
        for share in FORCES:
            halved = [lost(spring, share, Newton(halvings=cap)) for cap in CAPS]
            solved = Newton(bracketed=True).solve(partial(residual, spring, share * _LIMIT), STARTS)
            cells = [int((solved.residual != 0.0).sum()), int(solved.iterations.max())]
            rows.append([spring, share, threshold(share), lost(spring, share, Newton()), *halved, *cells])
    save(CYCLES, heads, rows)
    factors = from_cohesion(np.array([5000.0]), np.array([DIAMETER]))
    law = SuctionLaw(*factors, *(np.array([value]) for value in (0.2, 0.8, 1.0, 1e-3, math.nan)))
    found = []
    for velocity in VELOCITIES:
        needed = float(release_stiffness(law, np.array([velocity]))[0])
        found.append([velocity, needed, *(equilibria(law, velocity, share * needed) for share in SHARES)])
    save(RELEASE, ["velocity [m/s]", "needed [N/m2]", *(f"at {share:g} of it" for share in SHARES)], found)
