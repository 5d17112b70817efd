"""Suction at the ends of velocity and cohesion, against the law in 50 digits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from mudline.study.exact import SMALLEST, Compared, Tally
from mudline.study.stability.ladder.cells import DIAMETER, suction_deck
from mudline.study.stability.ladder.judging import Judgement, Verdict, guarded, located, scene_of

BOUND = 64.0
"""Roundings of the largest suction. Powers and products behind a law take some 15; on the release, where the distance
to breakout is a tenth of the uplift, they count up to ten times in the distance, which is divided by a fifth again."""
FLOOR = 10**9 * SMALLEST
"""Velocity and cohesion are known to the smallest float64; the law multiplies that by its slopes, up to 10^8 here."""
VELOCITIES = ("0", "5E-324", "1E-300", "1E-100", "1E-30", "1E-10", "9.99E-4", "1E-3", "1E-1", "1E0", "1E3", "1E6")
COHESIONS = ("0", "5E-324", "1E-300", "1E-100", "1E-3", "1E0", "5E3", "1E6", "1E15", "1E100", "1E300", "1E308", "1E309")
_SHARES = (0.05, 0.19, 0.21, 0.5, 0.79, 0.81, 0.9, 0.999, 1.001)
_DIGITS = 50


@dataclass(frozen=True, slots=True)
class SuctionCell:
    """A pull-out at a constant velocity from soil of a cohesion, as the deck has them."""

    family: str
    value: str
    cohesion: str
    velocity: str


def suction_cells() -> list[SuctionCell]:
    """Velocities in a usual clay, and cohesions at a usual velocity."""
    velocities = [SuctionCell("pull-out velocity", value, "5.0E3", value) for value in VELOCITIES]
    return [*velocities, *(SuctionCell("cohesion", value, value, "0.1") for value in COHESIONS)]


def judge_suction(cell: SuctionCell) -> Judgement:
    """Read, resolve, pull out and compare one cell."""
    return guarded(cell.family, cell.value, lambda: _judged(cell))


def _judged(cell: SuctionCell) -> Judgement:
    scene = scene_of(suction_deck(cell.cohesion))
    model = scene.contact()
    if not model.input.has("suction"):
        return Judgement(cell.family, cell.value, Verdict.WRONG, message="the suction of the deck is missing")
    velocity = float(cell.velocity)
    heights, exact, largest = _expected(float(cell.cohesion), velocity, _SHARES)
    tally = Tally()
    state = model.initial_state()
    for index, height in enumerate([-0.01, *heights]):
        points, moving = np.zeros((2, 3)), np.zeros((2, 3))
        points[:, 0], points[1, 1], moving[:, 0] = height, 2.0, velocity
        with located(scene):
            result, state = model.step(points, moving, state)
        if index:
            force, stiffness = float(result.force[0]), float(result.stiffness[0])
            tally.add(f"the suction at uplift {height!r}", Compared(force, exact[index - 1][0], largest), BOUND, FLOOR)
            steepness = exact[index - 1][1]
            tally.add(
                f"its stiffness at uplift {height!r}", Compared(stiffness, steepness, abs(steepness)), BOUND, FLOOR
            )
    verdict = Verdict.WRONG if tally.fault else Verdict.RIGHT
    return Judgement(cell.family, cell.value, verdict, tally.results, tally.error, BOUND, tally.fault)


def _expected(
    cohesion: float, v: float, shares: Sequence[float]
) -> tuple[list[float], list[tuple[Fraction, Fraction]], Fraction]:
    """Uplifts at shares of the breakout depth, force and stiffness there, and the largest suction."""
    from mpmath import mp, mpf  # noqa: PLC0415 - comes with the extra "study", and only this needs it

    with mp.workdps(_DIGITS):
        size, reference = mpf(float(DIAMETER)), mpf(1e-3)
        n_f, n_d = mpf(0.18), mpf(0.26)
        speed = max(mpf(v), reference)
        slow = mpf(v) / speed
        most = mpf(1.12) * size * mpf(cohesion) * (speed / size) ** n_f * slow * (2 - n_f + (n_f - 1) * slow)
        depth = mpf(0.98) * size * max(mpf(v), reference) ** n_d
        first, second = mpf(0.2), mpf(0.8)
        heights = [float(share * depth) for share in shares]
        found = []
        for height in heights:
            share = mpf(height) / depth
            part, slope = _trapezoid(share, first, second, mpf(1))
            found.append((_fraction(-most * part), _fraction(most * slope / depth)))
        return heights, found, _fraction(most)


def _trapezoid(share: Any, first: Any, second: Any, one: Any) -> tuple[Any, Any]:  # noqa: ANN401 - mpmath has no types
    if share < first:
        return share / first, one / first
    if share <= second:
        return one, 0 * one
    if share < one:
        return (one - share) / (one - second), -one / (one - second)
    return 0 * one, 0 * one


def _fraction(value: Any) -> Fraction:  # noqa: ANN401 - mpmath has no types
    """The number itself: a 50-digit float is a fraction."""
    from mpmath.libmp import to_rational  # noqa: PLC0415 - see above

    numerator, denominator = to_rational(value._mpf_)
    return Fraction(int(numerator), int(denominator))
