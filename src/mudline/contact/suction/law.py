"""Largest suction and uplift at breakout, as powers of the pull-out velocity v (Bridge et al. 2004).

    F_max = cyclic alpha_f v^n_f    per unit length,
    Delta_B = alpha_D v^n_D,

with alpha_f = 1.12 D cu / D^n_f, n_f = 0.18, alpha_D = 0.98 D and n_D = 0.26 for a pipe of diameter D in soil of
cohesion cu. The first law holds in any units of length, the second in SI only: Delta_B / D = 0.98 v^0.26.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.contact.laws.spring import LawError

FORCE_EXPONENT = 0.18
DEPTH_EXPONENT = 0.26
_FORCE_NUMBER = 1.12
_DEPTH_NUMBER = 0.98
_SLOWEST = np.nextafter(0.0, 1.0)
"""Keeps 0 / 0 away at rest where there is no cap."""


class SuctionFactors(NamedTuple):
    """The two power laws, arrays (m,), in one system of units; velocity in its length unit per second.

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
    """The law of each element, arrays (m,): the four of `SuctionFactors` and four more.

    first_corner, second_corner: ends of the rise and of the plateau, as fractions of the uplift at breakout.
    cyclic: factor on the largest suction for cyclic loading.
    regularisation: v_r, velocity below which the law of the largest suction is capped; also the least velocity that
        the uplift at breakout is reckoned with. 0 for neither.
    """

    force_factor: FloatArray
    force_exponent: FloatArray
    depth_factor: FloatArray
    depth_exponent: FloatArray
    first_corner: FloatArray
    second_corner: FloatArray
    cyclic: FloatArray
    regularisation: FloatArray

    def rows(self, rows: slice | IndexArray) -> SuctionLaw:
        """Return the laws of some elements, as views of a slice."""
        return SuctionLaw(*(values[rows] for values in self))

    def checked(self) -> SuctionLaw:
        """Return the law itself.

        Raises:
            LawError: a value is not finite or out of its range; its `index` is the element.
        """
        for name, values in self._asdict().items():
            _require(
                np.isfinite(values) & (values >= 0.0),
                f"the {name.replace('_', ' ')} of its suction is not finite and >= 0",
            )
        _require(self.depth_factor > 0.0, "the depth factor of its suction is not > 0")
        ordered = (self.first_corner > 0.0) & (self.first_corner <= self.second_corner) & (self.second_corner < 1.0)
        _require(ordered, "the corners of its suction are not 0 < first <= second < 1")
        return self


def from_cohesion(
    cohesion: FloatArray, diameter: FloatArray, length_unit: float = 1.0, force_unit: float = 1.0
) -> SuctionFactors:
    """Return the power laws of elements (m,) from the soil's cohesion and the pipe's diameter.

    `length_unit` in m and `force_unit` in N are the units of what is given and returned: 0.3048 and 4.4482216 for feet
    and pounds. The laws are evaluated in SI and converted back.
    """
    with np.errstate(all="ignore"):
        size = diameter * length_unit
        force = _FORCE_NUMBER * size * (cohesion * (force_unit / length_unit**2)) / size**FORCE_EXPONENT
        factor = force * (length_unit ** (1.0 + FORCE_EXPONENT) / force_unit)
        depth = _DEPTH_NUMBER * size * (length_unit**DEPTH_EXPONENT / length_unit)
    return SuctionFactors(factor, np.full(factor.shape, FORCE_EXPONENT), depth, np.full(depth.shape, DEPTH_EXPONENT))


def maximum_force(law: SuctionLaw, velocity: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return F_max per unit length and dF_max/dv at pull-out velocities v >= 0.

    Below v_r the power is replaced by v_r^n ((2 - n) r + (n - 1) r^2), r = v / v_r: 0 at rest, with a finite slope, and
    the same value and slope at v_r. From n = 2 on the power is smooth by itself (at n = 2 the two are one).
    """
    n = law.force_exponent
    with np.errstate(all="ignore"):
        pace = np.maximum(velocity, np.maximum(law.regularisation * (n < 2.0), _SLOWEST))
        share = velocity / pace
        at_pace = law.force_factor * law.cyclic * np.power(pace, n)
        linear, square = 2.0 - n, (n - 1.0) * share
        return at_pace * ((linear + square) * share), at_pace * (linear + square + square) / pace


def suction_depth(law: SuctionLaw, velocity: FloatArray) -> FloatArray:
    """Return Delta_B, the uplift at breakout, for a largest pull-out velocity `velocity` >= 0 of the episode."""
    with np.errstate(all="ignore"):
        return law.depth_factor * np.power(np.maximum(velocity, law.regularisation), law.depth_exponent)


def _require(holds: BoolArray, otherwise: str) -> None:
    broken = np.flatnonzero(~holds)
    if broken.size:
        raise LawError(otherwise, int(broken[0]))
