"""Suction against uplift with a history, `*SEABED SUCTION`, after Bridge et al. (2004).

The largest suction and the uplift at breakout are powers of the pull-out velocity v:

    F_max = cyclic alpha_f v^n_f    per unit length,
    Delta_B = alpha_D v_max^n_D,

with alpha_f = 1.12 D cu / D^n_f, n_f = 0.18, alpha_D = 0.98 D and n_D = 0.26 for a pipe of diameter D in soil of
cohesion cu. The first law holds in any units of length, the second in SI only: Delta_B / D = 0.98 v^0.26. Over the
uplift x, from the point where the compressive reaction vanishes, the suction is -F_max times a trapezoid of x /
Delta_B.

Below the velocity v_r (regularisation) F_max is replaced by a parabola with the value and slope of the power at v_r and
the value 0 at rest: there it is less than alpha_f v^n_f, by 20 % at v_r / 2 and 74 % at v_r / 10 for n_f = 0.18.

F_max follows the present velocity: the force vanishes as the motion stops. Delta_B follows the largest velocity of the
episode, v_max: slowing down does not cause a breakout.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple, Self

import numpy as np

from mudline.basics.short_repr import counted, short_repr
from mudline.model.contact.arrays import BoolArray, FloatArray, StateArray
from mudline.model.contact.laws import Law, Moving, Parameter, Reached, Value, where

FORCE_EXPONENT = 0.18
DEPTH_EXPONENT = 0.26
_FORCE_NUMBER = 1.12
_DEPTH_NUMBER = 0.98
_BELOW_1 = float(np.nextafter(1.0, 0.0))
_SLOWEST = float(np.nextafter(0.0, 1.0))
"""Least velocity, which avoids 0 / 0 at rest without a regularisation."""


class SuctionState(IntEnum):
    """State of an element with a suction law."""

    FREE = 0
    """No contact and no suction: not touched yet, or broken out and come down again."""
    COMPRESSION = 1
    """The reaction of the seabed is compressive."""
    SUCTION = 2
    """Moving up, between the loss of the reaction and breakout: suction mobilised."""
    HOLD = 3
    """Lifted off and not moving up: suction paused, no breakout."""
    BROKEN = 4
    """Broken out, and still at least as high as at breakout."""


COMPRESSION, SUCTION, HOLD, BROKEN = map(int, list(SuctionState)[1:])
"""The states as numbers of compiled loops."""


def maximum_force(v: Value, factor: Value, exponent: Value, regularisation: Value) -> tuple[Value, Value]:
    """Return F_max per unit length and dF_max/dv at pull-out velocities v >= 0.

    Below v_r the power is replaced by v_r^n ((2 - n) r + (n - 1) r^2), r = v / v_r. For n >= 2 the power is smooth by
    itself (at n = 2 the two are equal).
    """
    pace = np.maximum(v, where(exponent < 2.0, np.maximum(regularisation, _SLOWEST), _SLOWEST))
    ratio = v / pace
    at_pace = factor * np.float_power(pace, exponent)
    linear, square = 2.0 - exponent, (exponent - 1.0) * ratio
    return at_pace * ((linear + square) * ratio), at_pace * (linear + square + square) / pace


def breakout_uplift(v_max: Value, factor: Value, exponent: Value, regularisation: Value) -> Value:
    """Return Delta_B for the largest pull-out velocity of the episode; v_r is the least velocity used."""
    return factor * np.float_power(np.maximum(v_max, regularisation), exponent)


def trapezoid(share: Value, first: Value, second: Value) -> tuple[Value, Value]:
    """Return the mobilised part of F_max, 0 to 1, and its slope, at `share` = x / Delta_B.

    It rises from 0 at 0 to 1 at `first`, stays 1 up to `second` and falls to 0 at 1. At its corners the slope is that
    of the plateau, or 0 at the ends.
    """
    rises, falls = share < first, share > second
    steep, fall = 1.0 / first, 1.0 / (1.0 - second)
    part = where(rises, share * steep, where(falls, (1.0 - share) * fall, 1.0))
    slope = where(rises & (share > 0.0), steep, where(falls & (share < 1.0), 0.0 - fall, 0.0))
    return np.minimum(np.maximum(part, 0.0), 1.0), slope


def next_state(
    armed: Value, v_max: Value, state: Value, depth: Value, uplift: Value, v: Value
) -> tuple[Value, Value, Value]:
    """Return armed, v_max and state of an element out of compression.

    `v_max` is the largest velocity of the episode, including this step, and `depth` the Delta_B for it. An armed
    element is in HOLD if it does not move up, broken out if uplift >= depth, and else in suction.
    """
    beyond = uplift >= depth
    moving = armed & (v > 0.0)
    pulls = moving & np.logical_not(beyond)
    holds = armed & np.logical_not(moving)
    stays_broken = np.logical_not(armed) & (state == BROKEN)
    after = where(pulls, SUCTION, where(holds, HOLD, where((moving | stays_broken) & beyond, BROKEN, 0)))
    return pulls | holds, where(after > 0, v_max, 0.0), after


def suction_force(
    uplift: Value, v: Value, depth: Value, law: tuple[Value, Value, Value, Value, Value]
) -> tuple[Value, Value]:
    """Return the force per unit length in the state SUCTION, <= 0, and its stiffness -d force / d uplift.

    `law` is the force factor (cyclic factor included), force exponent, regularisation, first and second corner.
    """
    force, _ = maximum_force(v, law[0], law[1], law[2])
    inverse = 1.0 / depth
    part, slope = trapezoid(np.maximum(uplift, 0.0) * inverse, law[3], law[4])
    return 0.0 - force * part, force * slope * inverse


def after_cycle(factor: Value, per_cycle: Value, floor: Value) -> Value:
    """Return the cyclic factor after one more completed uplift cycle."""
    return np.maximum(factor * per_cycle, floor)


def suction_damping(
    uplift: FloatArray, v: FloatArray, before: FloatArray, law: SuctionLaw, factor: FloatArray
) -> FloatArray:
    """Return d force / d v in the state SUCTION at constant uplift, for tangents.

    `before` is the largest velocity of the episode until this step. At a larger velocity, above v_r, Delta_B grows with
    it, which the derivative includes: on the rise it may be positive. At a velocity equal to `before` Delta_B is taken
    as constant.
    """
    with np.errstate(all="ignore"):
        share = np.maximum(uplift, 0.0) / law.breakout_uplift(np.maximum(before, v))
        force, force_slope = law.maximum_force(v, factor)
        part, part_slope = trapezoid(share, law.first_corner, law.second_corner)
        # The share falls with a growing depth: d share / d v = -share n_D / v.
        grows = v > np.maximum(before, law.regularisation)
        growth = force * part_slope * share * law.depth_exponent / v * grows
        rate: FloatArray = growth - force_slope * part
    return rate


class SuctionFactors(NamedTuple):
    """The two power laws, arrays (m,), in one system of units; velocity in its length unit per second.

    Attributes:
        force_factor: alpha_f, of the largest suction per unit length.
        force_exponent: n_f.
        depth_factor: alpha_D, of the uplift at breakout.
        depth_exponent: n_D.
    """

    force_factor: FloatArray
    force_exponent: FloatArray
    depth_factor: FloatArray
    depth_exponent: FloatArray


class SuctionLaw(NamedTuple):
    """The law of each element, arrays (m,): the fields are the parameters of `SUCTION_LAW`."""

    force_factor: FloatArray
    force_exponent: FloatArray
    depth_factor: FloatArray
    depth_exponent: FloatArray
    first_corner: FloatArray
    second_corner: FloatArray
    cyclic: FloatArray
    regularisation: FloatArray
    cyclic_floor: FloatArray

    @property
    def counts_cycles(self) -> BoolArray:
        """Elements whose cyclic factor is applied once per completed uplift cycle, down to its floor."""
        return ~np.isnan(self.cyclic_floor)

    @property
    def initial_factor(self) -> FloatArray:
        """The cyclic factor before the first cycle."""
        return np.where(self.counts_cycles, 1.0, self.cyclic)

    @property
    def least_depth(self) -> FloatArray:
        """Delta_B at the least velocity."""
        return self.breakout_uplift(0.0)

    @property
    def largest_factor(self) -> FloatArray:
        """The largest possible cyclic factor."""
        return np.maximum(self.initial_factor, self.cyclic)

    @property
    def factor_per_cycle(self) -> FloatArray:
        """Multiplier of the cyclic factor for each completed cycle."""
        return np.where(self.counts_cycles, self.cyclic, 1.0)

    def maximum_force(self, v: FloatArray, factor: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return F_max per unit length and dF_max/dv at pull-out velocities v >= 0, with these cyclic factors."""
        return maximum_force(v, self.force_factor * factor, self.force_exponent, self.regularisation)

    def breakout_uplift(self, v_max: FloatArray | float) -> FloatArray:
        """Return Delta_B for the largest pull-out velocity of the episode."""
        depth: FloatArray = breakout_uplift(v_max, self.depth_factor, self.depth_exponent, self.regularisation)
        return depth


def from_cohesion(
    cohesion: FloatArray, diameter: FloatArray, length_unit: float = 1.0, force_unit: float = 1.0
) -> SuctionFactors:
    """Return the power laws of elements (m,) from the soil's cohesion and the pipe's diameter.

    `length_unit` in m and `force_unit` in N are the units of arguments and results: 0.3048 and 4.4482216 for feet and
    pounds. The laws are evaluated in SI and converted back.
    """
    with np.errstate(all="ignore"):
        size = diameter * length_unit
        force = _FORCE_NUMBER * size * (cohesion * (force_unit / length_unit**2)) / size**FORCE_EXPONENT
        factor = force * (length_unit ** (1.0 + FORCE_EXPONENT) / force_unit)
        depth = _DEPTH_NUMBER * size * (length_unit**DEPTH_EXPONENT / length_unit)
    return SuctionFactors(factor, np.full(factor.shape, FORCE_EXPONENT), depth, np.full(depth.shape, DEPTH_EXPONENT))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class SuctionHistory:
    """History of elements (m,) with suction. It is never changed: a step returns a new history.

    Attributes:
        armed: whether there was compression since the last breakout.
        state: values of `SuctionState`.
        v_max: the largest pull-out velocity of the uplift episode. The episode begins when an armed element loses its
            compressive reaction and ends with the next compression or with breakout. A broken element keeps the value
            of its breakout. 0 in all other states.
        factor: the cyclic factor.
        depth: Delta_B for `v_max`.
    """

    armed: BoolArray
    state: StateArray
    v_max: FloatArray
    factor: FloatArray
    depth: FloatArray

    __repr__ = short_repr

    @classmethod
    def initial(cls, law: SuctionLaw) -> Self:
        """Return the history of elements that never touched the seabed."""
        nothing = np.zeros(len(law.cyclic))
        with np.errstate(all="ignore"):
            return cls(nothing > 0.0, nothing.astype(np.int8), nothing, law.initial_factor, law.least_depth)


def _crossed(parameters: dict[str, FloatArray]) -> tuple[BoolArray, str]:
    return parameters["first_corner"] > parameters["second_corner"], "its first corner is above its second"


def suction_rates(law: SuctionLaw, v: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return F_max / (xc1 Delta_B) and dF_max / dv per unit length, at the end of the rise, at velocities v."""
    with np.errstate(all="ignore"):
        force, by_velocity = law.maximum_force(v, law.largest_factor)
        return force / (law.first_corner * law.breakout_uplift(v)), by_velocity


def release_stiffness(law: SuctionLaw, velocity: FloatArray) -> FloatArray:
    """Return |d force / d uplift| on the release of suction, per unit length, at steady pull-out velocities > 0 (m,).

    F_max / ((1 - xc2) Delta_B): a structure has a unique equilibrium there only if it is stiffer, per unit length.
    """
    with np.errstate(all="ignore"):
        force, _ = law.maximum_force(velocity, law.largest_factor)
        return force / ((1.0 - law.second_corner) * law.breakout_uplift(velocity))


def _damping(step: Moving, parameters: dict[str, FloatArray]) -> FloatArray:
    rate = suction_damping(step.uplift, step.v, step.before.v_max, SuctionLaw(**parameters), step.before.factor)
    return np.where(step.after.state == SUCTION, 0.0 - rate, 0.0)


def _plan(parameters: dict[str, FloatArray]) -> str:
    slow = sorted(set(parameters["regularisation"].tolist()))
    span = f"{slow[0]:g}" if len(slow) == 1 else f"{slow[0]:g} to {slow[-1]:g}"
    capped = f", less force than alpha v^n below v = {span}" if slow[-1] > 0.0 else ""
    elements = counted(len(parameters["regularisation"]), "element")
    return f"{elements} after Bridge et al., with a state each{capped}"


def _largest(reached: Reached, parameters: dict[str, FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Return the rise and the damping at the velocity that makes them largest; infinite if no velocity does."""
    law = SuctionLaw(**parameters)
    if reached.speed is not None:
        rise, damping = (
            rates if rates.ndim == 1 else np.fmax.reduce(rates, axis=0) for rates in suction_rates(law, reached.speed)
        )
        return rise, damping
    acts, n, slow = law.force_factor * law.largest_factor > 0.0, law.force_exponent, law.regularisation
    rise = suction_rates(law, slow)[0]
    rise = np.where((n > law.depth_exponent) & acts, np.inf, np.where(slow > 0.0, rise, np.inf))
    at_rest, at_slow = (law.maximum_force(v, law.largest_factor)[1] for v in (0.0 * slow, slow))
    damping = np.where((n > 1.0) & acts, np.inf, np.maximum(at_rest, at_slow))
    damping = np.where((slow > 0.0) | (n >= 1.0), damping, np.inf)
    return np.where(acts, rise, 0.0), np.where(acts, damping, 0.0)


SUCTION_LAW = Law(
    name="suction",
    summary="suction after Bridge et al., with a state",
    stage="suction",
    acts_on="elements",
    parameters=(
        Parameter("force_factor", "F/L (T/L)^n", "alpha_f of F_max = alpha_f v^n_f"),
        Parameter("force_exponent", "1", "n_f"),
        Parameter("depth_factor", "L (T/L)^n", "alpha_D of Delta_B = alpha_D v_max^n_D", above=True),
        Parameter("depth_exponent", "1", "n_D"),
        Parameter("first_corner", "1", "x / Delta_B up to which suction rises", above=True, high=_BELOW_1, default=0.2),
        Parameter("second_corner", "1", "x / Delta_B from which suction falls", above=True, high=_BELOW_1, default=0.8),
        Parameter("cyclic", "1", "factor on F_max for cyclic loading", default=1.0),
        Parameter("regularisation", "L/T", "v_r, velocity below which F_max is capped", default=1e-3),
        Parameter(
            "cyclic_floor",
            "1",
            "least factor where `cyclic` is applied once per completed uplift cycle; NaN: always applied, once",
            default=np.nan,
            optional=True,
        ),
    ),
    velocities=True,
    history=True,
    state="suction",
    initial=lambda _rows, _count, parameters: SuctionHistory.initial(SuctionLaw(**parameters)),
    check=_crossed,
    plan=_plan,
    largest=_largest,
    damping=_damping,
    equation="F = -cyclic alpha_f v^n_f trapezoid(x / (alpha_D v_max^n_D))",
    source="Bridge, Laver, Clukey and Evans (2004), OTC 16628",
)
