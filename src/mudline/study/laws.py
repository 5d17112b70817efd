"""Laws of a mass on the seabed: elastic normal laws with the work that they store, and suction as numbers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.laws.linear import smoothed_reaction, zone_onset
from mudline.contact.laws.suction import SuctionLaw
from mudline.curves import ForceCurve
from mudline.study.motion import Forces, History


def smoothed_spring(z: FloatArray, stiffness: float, half_width: float | FloatArray) -> tuple[FloatArray, FloatArray]:
    """Force and d force / d z of centred zones at penetrations (k,) of any sign; 0 above the zone."""
    with np.errstate(all="ignore"):
        touches = z > zone_onset(stiffness, half_width, 0.0)
        force, slope = smoothed_reaction(z, np.nan, stiffness, half_width, 0.0)
        return np.where(touches, force, 0.0), np.where(touches, slope, 0.0)


@dataclass(frozen=True, slots=True)
class LinearLaw:
    """k z, with the quadratic zone of half width `top` around the mudline where that is > 0.

    A law gives the force per unit length over the penetration z > 0; above the seabed, which begins at the height `top`
    above the mudline, there is none.
    """

    name: str
    stiffness: float
    top: float = 0.0

    def spring(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Force and d force / d z at penetrations (k,)."""
        if self.top == 0.0:
            below = z > 0.0
            return np.where(below, self.stiffness * z, 0.0), np.where(below, self.stiffness, 0.0)
        return smoothed_spring(z, self.stiffness, self.top)

    def work(self, z: FloatArray) -> FloatArray:
        """Work from the mudline, or from the start of the zone, to z, exactly; 0 above the seabed."""
        k, h = self.stiffness, self.top
        zone = np.zeros(z.shape) if h == 0.0 else k * np.clip(z + h, 0.0, 2.0 * h) ** 3 / (12.0 * h)
        below = np.maximum(z, h)
        return zone + 0.5 * k * (below - h) * (below + h)

    def breaks(self) -> FloatArray:
        """Penetrations > 0 at which the slope jumps, ascending."""
        return np.array([self.top] if self.top else [])

    def steepest(self, z: float) -> float:
        """The largest slope between the mudline and z."""
        del z
        return self.stiffness


@dataclass(frozen=True, slots=True)
class CurveLaw:
    """A force-embedment curve on a pipe of a diameter."""

    name: str
    curve: ForceCurve
    diameter: float
    top: float = 0.0

    def spring(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See `LinearLaw`."""
        below = z > 0.0
        if not below.any():
            return np.zeros(z.shape), np.zeros(z.shape)
        force, slope = self.curve.evaluate(np.where(below, z, 0.0) / self.diameter)
        return np.where(below, force, 0.0), np.where(below, slope / self.diameter, 0.0)

    def work(self, z: FloatArray) -> FloatArray:
        """See `LinearLaw`: sums of trapezoids, which are exact between points."""
        at = np.maximum(z, 0.0) / self.diameter
        knots = np.concatenate([[0.0], self.breaks() / self.diameter])
        forces = self.curve.evaluate(knots)[0]
        sums = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(knots) * (forces[1:] + forces[:-1]))])
        left = np.searchsorted(knots[1:], at, side="right")
        rest = 0.5 * (at - knots[left]) * (forces[left] + self.curve.evaluate(at)[0])
        work: FloatArray = (sums[left] + rest) * self.diameter
        return work

    def breaks(self) -> FloatArray:
        """See `LinearLaw`."""
        return self.curve.ratios[self.curve.ratios > 0.0] * self.diameter

    def steepest(self, z: float) -> float:
        """See `LinearLaw`."""
        knots = self.curve.ratios
        reached = (knots[:-1] <= z / self.diameter) & (knots[1:] > 0.0)
        end = slice(-1, None) if knots[-1] <= 0.0 else slice(0, 1)
        slopes = self.curve.slopes[reached] if reached.any() else self.curve.slopes[end]
        return float(np.abs(slopes).max() / self.diameter)


Law: TypeAlias = LinearLaw | CurveLaw


@dataclass(frozen=True, slots=True)
class Falling:
    """Masses (k,) on the seabed of a law, under a weight in water."""

    mass: FloatArray
    law: Law
    weight: float

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`."""
        force, slope = self.law.spring(-position)
        return Forces(force - self.weight, -slope, np.zeros(velocity.shape), history)


class ElasticContact(NamedTuple):
    """An elastic law of the scene, and the pipe on it, per unit length and in the deck's units."""

    law: Law
    diameter: float
    mass: float
    weight: float
    element: int

    @property
    def stiffness(self) -> float:
        """The law's slope at the mudline."""
        return self.law.steepest(0.0)


class SuctionNumbers(NamedTuple):
    """The suction law of one element, as numbers; the fields are those of `SuctionLaw`.

    An implementation of its own, to compare the evaluator with.
    """

    force_factor: float
    force_exponent: float
    depth_factor: float
    depth_exponent: float
    first_corner: float
    second_corner: float
    cyclic: float
    regularisation: float
    cyclic_floor: float = math.nan

    def rows(self, count: int) -> SuctionLaw:
        """The law of so many elements."""
        return SuctionLaw(*(np.full(count, value) for value in self))

    @property
    def largest(self) -> float:
        """The factor of the largest suction before an uplift cycle is completed."""
        return self.force_factor * (self.cyclic if math.isnan(self.cyclic_floor) else 1.0)

    def depth(self, v: float) -> float:
        """Uplift at breakout at a velocity that never fell."""
        return self.depth_factor * math.pow(max(v, self.regularisation, 5e-324), self.depth_exponent)

    def force(self, x: float, v: float) -> float:
        """Suction at an uplift and a velocity > 0 that never fell."""
        n, share = self.force_exponent, x / self.depth(v)
        slow = v / self.regularisation if self.regularisation > v and n < 2.0 else 1.0
        most = self.largest * math.pow(v / slow, n) * slow * (2.0 - n + (n - 1.0) * slow)
        return most * max(0.0, min(share / self.first_corner, 1.0, (1.0 - share) / (1.0 - self.second_corner)))
