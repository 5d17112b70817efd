"""Results of the evaluator against exact ones."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import copysign, inf, isfinite
from sys import float_info
from typing import NamedTuple

from mudline.contact.result import ContactResult
from mudline.study.stability.ladder.decks import LENGTH
from mudline.study.stability.ladder.exact import ROUNDING, SMALLEST, ExactLaw

BOUND = 8.0
"""Roundings of the largest term. A slope is three (two differences and their quotient), a force between points has one
for the distance to the point, one for the product and one for the sum besides: six to first order; two are left for a
stiffness and for what is of second order."""


class Compared(NamedTuple):
    """A number that came out, what it should be, and what its error is measured by."""

    found: float
    exact: Fraction
    term: Fraction


@dataclass(slots=True)
class Tally:
    """Numbers compared so far; the worst of them in roundings of its largest term."""

    results: int = 0
    error: float = 0.0
    fault: str = ""

    def add(self, what: str, compared: Compared, bound: float = BOUND, floor: Fraction = 2 * SMALLEST) -> None:
        """Compare one more; an error up to `floor` is none: results near 0 have no more digits."""
        self.results += 1
        if not isfinite(compared.found):
            self.error, self.fault = inf, f"{what} is {compared.found}"
            return
        if compared.found == 0.0 and copysign(1.0, compared.found) < 0.0:
            self.fault = f"{what} is -0.0"
        off = max(abs(Fraction(compared.found) - compared.exact) - floor, Fraction(0))
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


def compare(tally: Tally, law: ExactLaw, height: float, result: ContactResult) -> None:
    """One element whose two nodes lie at `height`: what it gives against what it should."""
    for what, compared in _pairs(law, height, result):
        tally.add(f"{what} at height {height!r}", compared)


def _pairs(law: ExactLaw, height: float, result: ContactResult) -> Iterator[tuple[str, Compared]]:
    """Each link of the chain from what the link before gave: none hides behind the condition of another."""
    depth, ratio = float(result.depth[0]), float(result.ratio[0])
    exact_ratio = Fraction(depth) / Fraction(law.diameter)
    yield "the depth", _itself(depth, -Fraction(height))
    yield "the embedment ratio", _itself(ratio, exact_ratio)
    numbers = [float(values[0]) for values in (result.force, result.slope, result.stiffness)]
    if depth > 0.0:
        spring = law.spring(Fraction(depth), Fraction(ratio))
        yield "the force", Compared(numbers[0], spring.force, spring.term)
        yield "the slope", _itself(numbers[1], spring.slope)
        yield "the stiffness", _itself(numbers[2], spring.stiffness)
    else:
        for what, number in zip(("the force", "the slope", "the stiffness"), numbers, strict=True):
            yield what, _itself(number, Fraction(0))
    for node in range(2):
        half = Fraction(numbers[0]) * Fraction(LENGTH) / 2 if isfinite(numbers[0]) else Fraction(0)
        yield "a reaction", _itself(float(result.reaction[node, 0]), half)


def _itself(found: float, exact: Fraction) -> Compared:
    return Compared(found, exact, abs(exact))
