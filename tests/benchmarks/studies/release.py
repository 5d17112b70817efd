"""Several static solutions during the release of suction.

On its release suction falls with the slope F_max / ((1 - xc2) Delta_B). A pipe suspended from a structure of stiffness
ks (per unit length), whose far end is raised slowly, has one equilibrium at each height only for a greater ks.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from mudline.model.contact.laws.suction import (
    SuctionLaw,
    breakout_uplift,
    from_cohesion,
    release_stiffness,
    suction_force,
)
from tests.benchmarks.studies.laws import DIAMETER
from tests.benchmarks.tables import digits, load, save, table

RELEASE = "stability-release"
VELOCITIES = (1e-3, 1e-2, 1e-1, 1.0)
SHARES = (0.5, 0.99, 1.01, 2.0)
"""Structural stiffness over the one that is needed."""


def equilibria(law: SuctionLaw, velocity: float, structure: float) -> int:
    """The largest number of equilibria at one height of the structure's end, up to 1.5 times the uplift at breakout.

    At uplift x the end stands at x + suction / ks: where that falls as x grows, a height belongs to several uplifts.
    """
    depth = breakout_uplift(velocity, law.depth_factor, law.depth_exponent, law.regularisation)
    uplift = np.linspace(0.0, 1.5 * float(depth[0]), 4001)[1:]
    shape = law.force_factor, law.force_exponent, law.regularisation, law.first_corner, law.second_corner
    pull, _ = suction_force(uplift, np.full(len(uplift), velocity), depth, shape)
    height = uplift - pull / structure
    levels = 0.5 * (np.sort(height)[1:] + np.sort(height)[:-1])
    low, high = np.minimum(height[1:], height[:-1]), np.maximum(height[1:], height[:-1])
    starts, ends = np.searchsorted(np.sort(low), levels, "left"), np.searchsorted(np.sort(high), levels, "right")
    return int((starts - ends).max())


def counted() -> list[list[float]]:
    """The rows: velocity, stiffness needed, and the equilibria with shares of it."""
    factors = from_cohesion(np.array([5000.0]), np.array([DIAMETER]))
    law = SuctionLaw(*factors, *(np.array([value]) for value in (0.2, 0.8, 1.0, 1e-3, math.nan)))
    rows = []
    for velocity in VELOCITIES:
        needed = float(release_stiffness(law, np.array([velocity]))[0])
        rows.append([velocity, needed, *(equilibria(law, velocity, share * needed) for share in SHARES)])
    return rows


def run(progress: Callable[[str], None]) -> None:
    """Write the table."""
    progress("release of suction")
    save(RELEASE, ["velocity [m/s]", "needed [N/m2]", *(f"at {share:g} of it" for share in SHARES)], counted())


def _release() -> str:
    rows = load(RELEASE)
    return table(list(rows[0]), [[digits(cell) for cell in row.values()] for row in rows])


TABLES = {"release": _release}
