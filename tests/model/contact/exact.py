"""Normal laws in exact rational arithmetic, with the values of float64 numbers, and results compared with them."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import copysign, inf, isfinite, nextafter
from typing import NamedTuple

ROUNDING = Fraction(1, 2**53)
"""Largest relative error of one operation on float64."""
SMALLEST = Fraction(1, 2**1074)
"""Smallest float64 above 0: the resolution of results near 0."""
BOUND = 8.0
"""Roundings of the largest term. A slope is three (two differences and their quotient), a force between points has one
for the distance to the point, one for the product and one for the sum besides: six to first order; two are left for
what is of second order."""


class Spring(NamedTuple):
    """Exact force per unit length, and the largest term in it."""

    force: Fraction
    term: Fraction


class ExactLinear:
    """Force = stiffness * depth."""

    def __init__(self, stiffness: float) -> None:
        self._stiffness = Fraction(stiffness)

    def spring(self, depth: Fraction, ratio: Fraction) -> Spring:
        """The spring of an element at a penetration, and at its embedment ratio."""
        del ratio
        force = max(self._stiffness * depth, Fraction(0))
        return Spring(force, force)

    def ratios(self) -> list[float]:
        """Embedment ratios to compare at: at, between, beside and beyond all corners."""
        return [1e-300, 1e-12, 1e-3, 0.1, 1.0, 1e3]


class ExactCurve:
    """Linear between points, the end segments continued; at a point the next segment applies."""

    def __init__(self, points: Sequence[tuple[float, float]], diameter: float) -> None:
        self.diameter = diameter
        self.points = sorted({(Fraction(ratio), Fraction(force)) for ratio, force in points})
        self._inner = [ratio for ratio, _ in self.points[1:-1]]

    def spring(self, depth: Fraction, ratio: Fraction) -> Spring:
        """See `ExactLinear`."""
        del depth
        left = bisect_right(self._inner, ratio)
        (r0, f0), (r1, f1) = self.points[left : left + 2]
        # beyond the last point the line is drawn from there
        r, f = self.points[-1] if ratio >= self.points[-1][0] else (r0, f0)
        rise = (f1 - f0) / (r1 - r0) * (ratio - r)
        return Spring(f + rise, max(abs(f), abs(rise), abs(f + rise)))

    def ratios(self) -> list[float]:
        """See `ExactLinear`."""
        knots = [float(ratio) for ratio, _ in self.points]
        middles = [0.5 * low + 0.5 * high for low, high in pairwise(knots)]
        beside = [nextafter(knot, end) for knot in knots for end in (-inf, inf)]
        every = {*knots, *middles, *beside, 1.5 * knots[-1], 1e-300, 1e-9}
        return sorted(ratio for ratio in every if isfinite(ratio) and ratio > 0.0)


class ExactSmoothed:
    """A linear law with a quadratic zone of half width h > 0, about the mudline or below it."""

    def __init__(self, stiffness: float, diameter: float, half_width: float, *, one_sided: bool) -> None:
        self._stiffness, self._width, self._one_sided = Fraction(stiffness), Fraction(half_width), one_sided
        self._diameter = diameter

    def spring(self, depth: Fraction, ratio: Fraction) -> Spring:
        """See `ExactLinear`."""
        del ratio
        width = self._width
        into = depth if self._one_sided else depth + width
        if into < 2 * width:
            # the distance into the zone is a difference, as good as its terms
            term = abs(depth) if self._one_sided else max(abs(depth), width)
            slope = self._stiffness * max(into, Fraction(0)) / (2 * width)
            return Spring(slope * into / 2, 2 * slope * term)
        shift = width if self._one_sided else Fraction(0)
        return Spring(self._stiffness * (depth - shift), self._stiffness * max(depth, shift))

    def ratios(self) -> list[float]:
        """See `ExactLinear`."""
        found = (share * float(self._width) / self._diameter for share in (1e-9, 0.3, 0.999, 1.0, 1.9, 2.0, 2.1, 30.0))
        return [ratio for ratio in found if isfinite(ratio)]


ExactLaw = ExactLinear | ExactCurve | ExactSmoothed
EXACT: dict[str, type[ExactLaw]] = {
    "linear": ExactLinear,
    "smoothed": ExactSmoothed,
    "nodal": ExactSmoothed,
    "curve": ExactCurve,
}
"""The laws that are computed here, by name."""


@dataclass(slots=True)
class Tally:
    """Numbers compared so far, the largest error in roundings of the largest term, and what is wrong."""

    results: int = 0
    error: float = 0.0
    fault: str = ""

    def add(self, what: str, found: float, exact: Fraction, term: Fraction, floor: Fraction = 2 * SMALLEST) -> None:
        """Compare one more; errors up to `floor` are ignored, as results near 0 have no more digits."""
        self.results += 1
        if not isfinite(found) or (found == 0.0 and copysign(1.0, found) < 0.0):
            self.error, self.fault = inf, f"{what} is {found}"
            return
        off = max(abs(Fraction(found) - exact) - floor, Fraction(0))
        error = float(min(off / (term * ROUNDING), Fraction(10**300))) if off and term else inf if off else 0.0
        self.error = max(self.error, error)
        if error > BOUND:
            self.fault = f"{what} is {found!r}, {error:.3g} roundings off"
