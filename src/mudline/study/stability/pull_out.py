"""Suction at extreme velocities, cohesions and forces, pulled out and compared with the law in 50 digits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from mudline.results.evaluation import as_deck_errors
from mudline.study import scene_of
from mudline.study.exact import SMALLEST, Compared, Tally
from mudline.study.exact_geometry import fraction_of
from mudline.study.stability.judging import FILE, Judgement, Verdict, guarded
from mudline.study.stability.small_decks import DIAMETER, Pair, SmallDeck

SUCTION_BOUND = 64.0
"""Roundings of the largest suction. Powers and products behind a law take some 15; on the release, where the distance
to breakout is a tenth of the uplift, they count up to ten times in the distance, which is divided by a fifth again."""
SUCTION_FLOOR = 10**9 * SMALLEST
"""Velocity and cohesion have the resolution of the smallest float64; the law multiplies it by its slopes, 10^8 here."""
VELOCITIES = ("0", "5E-324", "1E-300", "1E-100", "1E-30", "1E-10", "9.99E-4", "1E-3", "1E-1", "1E0", "1E3", "1E6")
COHESIONS = ("0", "5E-324", "1E-300", "1E-100", "1E-3", "1E0", "5E3", "1E6", "1E15", "1E100", "1E300", "1E308", "1E309")
_UPLIFTS = (0.05, 0.19, 0.21, 0.5, 0.79, 0.81, 0.9, 0.999, 1.001)
_DIGITS = 50


@dataclass(frozen=True, slots=True, kw_only=True)
class SuctionCell:
    """A pull-out at a constant velocity, all numbers as the deck has them.

    Attributes:
        cohesion: of the soil; the laws follow from it unless `force` and `depth` give factor and exponent of each.
        cutoff: corners of the trapezoid. regularisation: velocity below which the force is capped.
    """

    family: str
    value: str
    velocity: str = "0.1"
    cohesion: str = "5.0E3"
    force: Pair | None = None
    depth: Pair | None = None
    cutoff: Pair = ("0.2", "0.8")
    regularisation: str = "0.001"
    diameter: str = DIAMETER

    @property
    def text(self) -> str:
        """The deck."""
        rows = [f"COHESION={self.cohesion}"]
        if self.force is not None and self.depth is not None:
            rows = [f"FORCE={', '.join(self.force)}", f"DEPTH={', '.join(self.depth)}"]
        rows += [f"CUTOFF={', '.join(self.cutoff)}", f"REGULARISATION={self.regularisation}"]
        return SmallDeck(suction=tuple(rows), diameter=self.diameter).text


def suction_cells() -> list[SuctionCell]:
    """Velocities in a usual clay, and cohesions at a usual velocity."""
    return [
        *(SuctionCell(family="pull-out velocity", value=value, velocity=value) for value in VELOCITIES),
        *(SuctionCell(family="cohesion", value=value, cohesion=value) for value in COHESIONS),
        SuctionCell(family="negative zero", value="velocity", velocity="-0.0"),
    ]


def judge_suction(cell: SuctionCell) -> Judgement:
    """Read, resolve, pull out and compare one cell."""
    return guarded(cell.family, cell.value, lambda: _suction_judged(cell))


def _suction_judged(cell: SuctionCell) -> Judgement:
    scene = scene_of(cell.text, FILE)
    model = scene.contact()
    if not model.input.has("suction"):
        return Judgement(cell.family, cell.value, Verdict.WRONG, message="the suction of the deck is missing")
    velocity = float(cell.velocity)
    heights, exact, largest = _expected(cell, velocity, _UPLIFTS)
    tally = Tally()
    state = model.initial_state()
    for index, height in enumerate([-0.01, *heights]):
        points, moving = np.zeros((2, 3)), np.zeros((2, 3))
        points[:, 0], points[1, 1], moving[:, 0] = height, 2.0, velocity
        with as_deck_errors(scene):
            result, state = model.step(points, moving, state)
        if index:
            force, stiffness = exact[index - 1]
            for what, compared in (
                ("the suction", Compared(float(result.force[0]), force, largest)),
                ("its stiffness", Compared(float(result.stiffness[0]), stiffness, abs(stiffness))),
            ):
                tally.add(f"{what} at uplift {height!r}", compared, SUCTION_BOUND, SUCTION_FLOOR)
    verdict = Verdict.WRONG if tally.fault else Verdict.RIGHT
    return Judgement(cell.family, cell.value, verdict, tally.results, tally.error, SUCTION_BOUND, tally.fault)


def _expected(
    cell: SuctionCell, v: float, shares: Sequence[float]
) -> tuple[list[float], list[tuple[Fraction, Fraction]], Fraction]:
    """Uplifts at shares of the breakout depth, force and stiffness there, and the largest suction."""
    from mpmath import mp, mpf  # noqa: PLC0415 - comes with the extra "study", and only this needs it

    with mp.workdps(_DIGITS):
        size, reference = mpf(float(cell.diameter)), mpf(float(cell.regularisation))
        if cell.force is not None and cell.depth is not None:
            (alpha_f, n_f), (alpha_d, n_d) = ([mpf(float(text)) for text in law] for law in (cell.force, cell.depth))
        else:
            n_f, n_d = mpf(0.18), mpf(0.26)
            alpha_f, alpha_d = mpf(1.12) * size * mpf(float(cell.cohesion)) / size**n_f, mpf(0.98) * size
        speed = max(mpf(v), reference)
        slow = mpf(v) / speed
        most = alpha_f * speed**n_f * slow * (2 - n_f + (n_f - 1) * slow)
        depth = alpha_d * speed**n_d
        first, second = (mpf(float(corner)) for corner in cell.cutoff)
        heights = [float(share * depth) for share in shares]
        found = []
        for height in heights:
            share = mpf(height) / depth
            part, slope = _trapezoid(share, first, second, mpf(1))
            found.append((fraction_of(-most * part), fraction_of(most * slope / depth)))
        return heights, found, fraction_of(most)


def _trapezoid(share: Any, first: Any, second: Any, one: Any) -> tuple[Any, Any]:  # noqa: ANN401 - mpmath has no types
    if share < first:
        return share / first, one / first
    if share <= second:
        return one, 0 * one
    if share < one:
        return (one - share) / (one - second), -one / (one - second)
    return 0 * one, 0 * one
