"""What the decks of the ladder should give, in exact rational arithmetic on the numbers as a float64 holds them."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import inf, isfinite, nextafter
from typing import NamedTuple, Protocol

ROUNDING = Fraction(1, 2**53)
"""Largest relative error of one operation on float64."""
SMALLEST = Fraction(1, 2**1074)
"""Smallest float64 above 0: what cannot be said more closely near 0."""


class Spring(NamedTuple):
    """Exact force per unit length, d force / d ratio, d force / d penetration, and the largest term in the force."""

    force: Fraction
    slope: Fraction
    stiffness: Fraction
    term: Fraction


class ExactLaw(Protocol):
    """An exact law of one element."""

    @property
    def diameter(self) -> float:
        """External diameter of the element."""
        ...

    def spring(self, depth: Fraction, ratio: Fraction) -> Spring:
        """The spring of an element in contact."""
        ...

    def ratios(self) -> list[float]:
        """Where its value matters: embedment ratios at, between, beside and beyond all corners."""
        ...


@dataclass(frozen=True, slots=True)
class ExactLinear:
    """Force = stiffness * depth."""

    stiffness: float
    diameter: float

    def spring(self, depth: Fraction, ratio: Fraction) -> Spring:
        """See `ExactLaw`."""
        del ratio
        stiffness = Fraction(self.stiffness)
        force = stiffness * depth
        return Spring(force, stiffness * Fraction(self.diameter), stiffness, abs(force))

    def ratios(self) -> list[float]:
        """See `ExactLaw`."""
        return [1e-300, 1e-12, 1e-3, 0.1, 1.0, 1e3]


class ExactCurve:
    """Linear between points, the end segments continued; at a point the segment behind it holds."""

    def __init__(self, points: Sequence[tuple[float, float]], diameter: float) -> None:
        self.diameter = diameter
        self.points = sorted({(Fraction(ratio), Fraction(force)) for ratio, force in points})

    def spring(self, depth: Fraction, ratio: Fraction) -> Spring:
        """See `ExactLaw`."""
        del depth
        left = bisect_right([point[0] for point in self.points[1:-1]], ratio)
        (r0, f0), (r1, f1) = self.points[left : left + 2]
        slope = (f1 - f0) / (r1 - r0)
        # beyond the last point the line is drawn from there
        r, f = self.points[-1] if ratio >= self.points[-1][0] else (r0, f0)
        rise = slope * (ratio - r)
        return Spring(f + rise, slope, slope / Fraction(self.diameter), max(abs(f), abs(rise), abs(f + rise)))

    def ratios(self) -> list[float]:
        """See `ExactLaw`."""
        knots = [float(ratio) for ratio, _ in self.points]
        middles = [0.5 * low + 0.5 * high for low, high in pairwise(knots)]
        beside = [nextafter(knot, end) for knot in knots for end in (-inf, inf)]
        every = {*knots, *middles, *beside, 1.5 * knots[-1], 1e-300, 1e-9}
        return sorted(ratio for ratio in every if isfinite(ratio))
