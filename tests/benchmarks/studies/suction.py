"""Suction of elements step by step with its derivatives: what the drivers and the tangent have in parts."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import BoolArray, FloatArray, StateArray
from mudline.model.contact.laws.suction import (
    BROKEN,
    COMPRESSION,
    SUCTION,
    SuctionHistory,
    SuctionLaw,
    after_cycle,
    breakout_uplift,
    next_state,
    suction_damping,
    suction_force,
)


def remembered(
    law: SuctionLaw, armed: BoolArray, v_max: FloatArray, state: StateArray, factor: FloatArray
) -> SuctionHistory:
    """The history with these properties."""
    with np.errstate(all="ignore"):
        depth = breakout_uplift(v_max, law.depth_factor, law.depth_exponent, law.regularisation)
    return SuctionHistory(armed, state.astype(np.int8), v_max, factor, np.asarray(depth))


class Suction(NamedTuple):
    """Suction of elements, arrays (m,). All but the depth are 0 outside the state SUCTION.

    force: per unit length, <= 0.
    by_uplift: d force / d uplift at constant velocity; positive on the release.
    by_velocity: d force / d pull-out velocity at constant uplift; see `suction_damping`.
    depth: Delta_B, the uplift at breakout.
    """

    force: FloatArray
    by_uplift: FloatArray
    by_velocity: FloatArray
    depth: FloatArray


def step(
    law: SuctionLaw, history: SuctionHistory, uplift: FloatArray, velocity: FloatArray, compressed: BoolArray
) -> tuple[Suction, SuctionHistory]:
    """The suction and the next history of elements (m,), with its derivatives.

    `uplift` is the distance x above the point where the compressive reaction vanishes, `velocity` the pull-out velocity
    v of the element, `compressed` says whether the reaction of the seabed is compressive. All finite, in the units of
    the law.
    """
    with np.errstate(all="ignore"):
        v_max = np.where(history.armed, np.maximum(history.v_max, velocity), history.v_max)
        depth = breakout_uplift(
            np.where(compressed, 0.0, v_max), law.depth_factor, law.depth_exponent, law.regularisation
        )
        armed, v_max, state = next_state(history.armed, v_max, history.state, depth, uplift, velocity)
        state = np.where(compressed, COMPRESSION, state).astype(np.int8)
        pulls = state == SUCTION
        shape = (law.force_factor * history.factor, law.force_exponent, law.regularisation)
        force, stiffness = suction_force(uplift, velocity, depth, (*shape, law.first_corner, law.second_corner))
        damping = suction_damping(uplift, velocity, history.v_max, law, history.factor)
        completed = history.armed & ((compressed & (history.v_max > 0.0)) | (state == BROKEN))
        factor = after_cycle(history.factor, law.factor_per_cycle, np.nan_to_num(law.cyclic_floor))
    suction = Suction(
        np.where(pulls, force, 0.0), np.where(pulls, 0.0 - stiffness, 0.0), np.where(pulls, damping, 0.0), depth
    )
    v_max, factor = np.where(compressed, 0.0, v_max), np.where(completed, factor, history.factor)
    return suction, remembered(law, compressed | armed, v_max, state, factor)
