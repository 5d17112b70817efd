"""One step of the suction law: from uplift and velocity to force, tangents and the next state."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.suction.law import SuctionLaw, maximum_force, suction_depth
from mudline.contact.suction.states import SuctionHistory, SuctionState
from mudline.contact.suction.trapezoid import trapezoid

_BLOCK = 8192
"""Elements reckoned at a time: the work arrays stay in the second-level cache."""


class Suction(NamedTuple):
    """Suction of elements, arrays (m,). All but the depth are 0 outside the state SUCTION.

    force: per unit length, <= 0.
    by_uplift: d force / d uplift at constant velocity; positive on the release.
    by_velocity: d force / d pull-out velocity at constant uplift. Where the velocity is a new largest one of the
        episode (and above v_r), Delta_B grows with it, and this tangent holds that too: on the rise it may be
        positive. At a velocity equal to the largest one so far it is that at constant Delta_B.
    depth: Delta_B, the uplift at breakout.
    """

    force: FloatArray
    by_uplift: FloatArray
    by_velocity: FloatArray
    depth: FloatArray

    @classmethod
    def blank(cls, elements: int) -> Suction:
        """Return arrays for so many elements, without force."""
        return cls(*(np.zeros(elements) for _ in cls._fields))

    def rows(self, rows: slice) -> Suction:
        """Return some elements, as views."""
        return Suction(*(values[rows] for values in self))


def step(
    law: SuctionLaw,
    history: SuctionHistory,
    uplift: FloatArray,
    velocity: FloatArray,
    compressed: BoolArray,
    out: tuple[Suction, SuctionHistory] | None = None,
) -> tuple[Suction, SuctionHistory]:
    """Return the suction and the next history of elements (m,).

    `uplift` is the way x up from where the compressive reaction vanishes, `velocity` the pull-out velocity v of the
    element, `compressed` says whether the reaction of the bed is compressive. All finite, in the units of the law.

    An armed element that is not compressed holds where it does not move up, has broken out where x >= Delta_B, and is
    else in suction, with -F_max(v) times the trapezoid at x / Delta_B. F_max follows the velocity of the moment: the
    force vanishes as the motion stops. Delta_B follows the largest velocity of the episode: who slows down does not
    break out for that.

    The values go to `out` where it is given, which must not be the memory of `history`: fresh arrays for 10^5 elements
    cost as much as the law.
    """
    elements = len(uplift)
    suction, after = (Suction.blank(elements), SuctionHistory.initial(elements)) if out is None else out
    with np.errstate(all="ignore"):
        for start in range(0, elements, _BLOCK):
            rows = slice(start, start + _BLOCK)
            motion = _Motion(uplift[rows], velocity[rows], compressed[rows])
            _step_rows(law.rows(rows), history.rows(rows), motion, suction.rows(rows), after.rows(rows))
    return suction, after


class _Motion(NamedTuple):
    uplift: FloatArray
    velocity: FloatArray
    compressed: BoolArray


def _step_rows(
    law: SuctionLaw, before: SuctionHistory, motion: _Motion, suction: Suction, after: SuctionHistory
) -> None:
    """Write the suction and the history of some elements."""
    uplift, velocity, compressed = motion
    bound = before.armed & ~compressed
    v_max = np.where(compressed, 0.0, np.maximum(before.v_max, velocity * before.armed))
    suction.depth[...] = suction_depth(law, v_max)
    beyond = uplift >= suction.depth
    moving = bound & (velocity > 0.0)
    breaks = moving & beyond
    sucks = moving & ~beyond
    stays_broken = (before.state == SuctionState.BROKEN) & ~compressed & beyond
    after.state[...] = compressed * np.int8(SuctionState.COMPRESSION)
    after.state[...] += sucks * np.int8(SuctionState.SUCTION)
    after.state[...] += (bound & ~moving) * np.int8(SuctionState.HOLD)
    after.state[...] += (breaks | stays_broken) * np.int8(SuctionState.BROKEN)
    after.armed[...] = compressed | (bound & ~breaks)
    after.v_max[...] = np.where(after.state > SuctionState.COMPRESSION, v_max, 0.0)
    if not sucks.any():
        suction.force[...] = suction.by_uplift[...] = suction.by_velocity[...] = 0.0
        return
    grows = velocity > np.maximum(before.v_max, law.regularisation)
    for whole, values in zip(suction, _pull(law, uplift, velocity, suction.depth, grows), strict=False):
        whole[...] = np.where(sucks, values, 0.0)


def _pull(
    law: SuctionLaw, uplift: FloatArray, v: FloatArray, depth: FloatArray, grows: BoolArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Force and its derivatives by uplift and by velocity, of use for elements in suction only."""
    share = np.maximum(uplift, 0.0) / depth
    force, force_slope = maximum_force(law, v)
    part, part_slope = trapezoid(share, law.first_corner, law.second_corner)
    by_share = force * part_slope
    # The share falls with a growing depth: d share / d v = -share n_D / v.
    growth = by_share * share * law.depth_exponent / v * grows
    return 0.0 - force * part, 0.0 - by_share / depth, growth - force_slope * part
