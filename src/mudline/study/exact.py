"""Laws in exact rational arithmetic, with the values of float64 numbers, and results compared with them."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import copysign, inf, isfinite, nextafter
from sys import float_info
from typing import NamedTuple, TypeAlias

ROUNDING = Fraction(1, 2**53)
"""Largest relative error of one operation on float64."""
SMALLEST = Fraction(1, 2**1074)
"""Smallest float64 above 0: the resolution of results near 0."""
BOUND = 8.0
"""Roundings of the largest term. A slope is three (two differences and their quotient), a force between points has one
for the distance to the point, one for the product and one for the sum besides: six to first order; two are left for a
stiffness and for what is of second order."""


class Spring(NamedTuple):
    """Exact force per unit length, d force / d ratio, d force / d penetration, and the largest term in the force.

    `by_depth` is the largest term in the stiffness where that is a sum too.
    """

    force: Fraction
    slope: Fraction
    stiffness: Fraction
    term: Fraction
    by_depth: Fraction | None = None


@dataclass(frozen=True, slots=True)
class ExactLinear:
    """Force = stiffness * depth."""

    stiffness: float
    diameter: float

    def spring(self, depth: Fraction, ratio: Fraction) -> Spring:
        """The spring of an element in contact."""
        del ratio
        stiffness = Fraction(self.stiffness)
        force = stiffness * depth
        return Spring(force, stiffness * Fraction(self.diameter), stiffness, abs(force))

    def steepest(self, ratio: Fraction) -> Fraction:
        """The steepest d force / d penetration between the mudline and an embedment ratio > 0."""
        del ratio
        return Fraction(self.stiffness)

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
        slope = (f1 - f0) / (r1 - r0)
        # beyond the last point the line is drawn from there
        r, f = self.points[-1] if ratio >= self.points[-1][0] else (r0, f0)
        rise = slope * (ratio - r)
        return Spring(f + rise, slope, slope / Fraction(self.diameter), max(abs(f), abs(rise), abs(f + rise)))

    def steepest(self, ratio: Fraction) -> Fraction:
        """See `ExactLinear`; the segment behind a point does not count at the point."""
        inner = self._inner
        pieces = zip([None, *inner], [*inner, None], pairwise(self.points), strict=True)
        reached = [
            (f1 - f0) / (r1 - r0)
            for begin, end, ((r0, f0), (r1, f1)) in pieces
            if (begin is None or begin < ratio) and (end is None or end > 0)
        ]
        return max(reached) / Fraction(self.diameter)

    def ratios(self) -> list[float]:
        """See `ExactLinear`."""
        knots = [float(ratio) for ratio, _ in self.points]
        middles = [0.5 * low + 0.5 * high for low, high in pairwise(knots)]
        beside = [nextafter(knot, end) for knot in knots for end in (-inf, inf)]
        every = {*knots, *middles, *beside, 1.5 * knots[-1], 1e-300, 1e-9}
        return sorted(ratio for ratio in every if isfinite(ratio))


@dataclass(frozen=True, slots=True)
class ExactSmoothed:
    """A linear law with a quadratic zone of half width h > 0, about the mudline or below it."""

    stiffness: float
    diameter: float
    half_width: float
    one_sided: bool = False

    def spring(self, depth: Fraction, ratio: Fraction) -> Spring:
        """See `ExactLinear`."""
        del ratio
        stiffness, width = Fraction(self.stiffness), Fraction(self.half_width)
        into = depth if self.one_sided else depth + width
        if into < 2 * width:
            # the distance into the zone is a difference, as good as its terms
            term = max(abs(depth), width) if not self.one_sided else abs(depth)
            slope = stiffness * into / (2 * width)
            return Spring(
                stiffness * into * into / (4 * width),
                slope * Fraction(self.diameter),
                slope,
                2 * slope * term,
                stiffness * term / (2 * width),
            )
        shift = width if self.one_sided else Fraction(0)
        force = stiffness * (depth - shift)
        return Spring(force, stiffness * Fraction(self.diameter), stiffness, stiffness * max(depth, shift))

    def steepest(self, ratio: Fraction) -> Fraction:
        """See `ExactLinear`."""
        del ratio
        return Fraction(self.stiffness)

    @property
    def onset(self) -> Fraction:
        """The penetration from which on it acts."""
        return Fraction(0) if self.one_sided else -Fraction(self.half_width)


ExactLaw: TypeAlias = ExactLinear | ExactCurve
"""Of one element, of an external `diameter`."""


class Compared(NamedTuple):
    """A result, its exact value, and the term that its error is relative to."""

    found: float
    exact: Fraction
    term: Fraction


@dataclass(slots=True)
class Tally:
    """Numbers compared so far, and the largest error, in roundings of the largest term."""

    results: int = 0
    error: float = 0.0
    fault: str = ""

    def add(self, what: str, compared: Compared, bound: float = BOUND, floor: Fraction = 2 * SMALLEST) -> None:
        """Compare one more; errors up to `floor` are ignored, as results near 0 have no more digits."""
        self.results += 1
        if not isfinite(compared.found):
            self.error, self.fault = inf, f"{what} is {compared.found}"
            return
        if compared.found == 0.0 and copysign(1.0, compared.found) < 0.0:
            self.fault = f"{what} is -0.0"
        found = Fraction(compared.found)
        if found == compared.exact:
            return
        off = max(abs(found - compared.exact) - floor, Fraction(0))
        error = _roundings(off, compared.term)
        self.error = max(self.error, error)
        if error > bound:
            self.fault = f"{what} is {compared.found!r} instead of {_shown(compared.exact)}"


def _roundings(off: Fraction, term: Fraction) -> float:
    if not off:
        return 0.0
    return float(min(off / (term * ROUNDING), Fraction(10**300))) if term else inf


def _shown(exact: Fraction) -> str:
    largest = Fraction(float_info.max)
    return repr(float(exact)) if abs(exact) <= largest else "a number too large for a float64"
