"""A small deck is evaluated from its text to forces, is compared with exact results, and is judged.

Suction, at the ends of velocity and cohesion, is compared with the law in 50 digits.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from math import isfinite
from sys import float_info
from typing import Annotated, Any

import numpy as np

from mudline.contact.result import ContactResult
from mudline.diagnostics import DeckError, Severity
from mudline.results.evaluation import as_deck_errors
from mudline.scene.model import Scene
from mudline.study import scene_of
from mudline.study.exact import BOUND, SMALLEST, Compared, ExactCurve, ExactLaw, Tally

Pairs = Sequence[tuple[str, str]]

DIAMETER = "0.3"
LENGTH = 2.0

_LINE = """\
$MODEL
*NODE
 1, -0.05, 0.0, 0.0
 2, -0.05, 2.0, 0.0
*ELEMENT
 1, 1, 2
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, {diameter}, {inner}, 7850.0
"""
_SUCTION = """\
*SEABED SUCTION
 SET=ALL
 COHESION={cohesion}
"""


@dataclass(frozen=True, slots=True)
class Cell:
    """A deck, where it stands on the ladder, and the law that it should give; None where the deck holds no law."""

    family: str
    value: str
    text: str
    law: ExactLaw | None


def linear_deck(stiffness: str, diameter: str = DIAMETER) -> str:
    """A linear seabed."""
    return _line(diameter) + _on(stiffness)


def curve_deck(points: Pairs, diameter: str = DIAMETER) -> str:
    """A force-embedment curve; numbers as the deck has them."""
    rows = "".join(f" {ratio}, {force}\n" for ratio, force in points)
    return _line(diameter) + _on("Extreme") + "*SEABED STIFFNESS\n CURVE=Extreme\n" + rows


def suction_deck(cohesion: str) -> str:
    """A linear seabed with suction."""
    return linear_deck("50000.0") + _SUCTION.format(cohesion=cohesion)


def _line(diameter: str) -> str:
    """A pipe of half the diameter inside."""
    return _LINE.format(diameter=diameter, inner=repr(0.5 * float(diameter)))


def _on(stiffness: str) -> str:
    return f"*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS={stiffness}\n"


_FILE = "cell.keyxm"
_ABOVE = (0.0, 5e-324, 0.05, 1e6)
_LARGEST = Fraction(float_info.max) * (1 - Fraction(1, 2**50))


class Verdict(StrEnum):
    """Only the first three may ever appear."""

    RIGHT = "right"
    """Every result is within the bound."""
    RIGHT_UNTIL_REFUSED = "right, beyond refused"
    """Results are within the bound; where one would overflow it is refused, with a line of the deck."""
    REFUSED = "refused"
    """The deck is refused, with a line of the deck."""
    WRONG = "WRONG"
    """A result is outside its bound, or not finite."""
    NO_LINE = "REFUSED WITHOUT A LINE"
    """A refusal that names no line, or one of a result that a float64 can hold."""
    WARNED = "WARNED"
    """A numpy warning came out, or an error that is none of ours."""

    @property
    def acceptable(self) -> bool:
        """Whether it may appear."""
        return self in {Verdict.RIGHT, Verdict.RIGHT_UNTIL_REFUSED, Verdict.REFUSED}


@dataclass(frozen=True, slots=True)
class Judgement:
    """A cell and what came of it.

    Attributes:
        family: what grows along the ladder.
        value: where on it, as the deck has it.
        error: in roundings (2^-53) of the largest term; 0 where nothing was compared.
        bound: roundings that are allowed.
        message: the diagnostic of a refusal, else what is wrong.
    """

    family: Annotated[str, "family"]
    value: Annotated[str, "value"]
    verdict: Annotated[Verdict, "verdict"]
    results: Annotated[int, "numbers compared"] = 0
    error: Annotated[float, "largest error [2^-53]"] = 0.0
    bound: Annotated[float, "bound [2^-53]"] = 0.0
    message: Annotated[str, "told"] = ""


def judge(cell: Cell) -> Judgement:
    """Read, resolve, evaluate and compare one cell."""
    return guarded(cell.family, cell.value, lambda: _judged(cell))


def guarded(family: str, value: str, judged: Callable[[], Judgement]) -> Judgement:
    """What is judged, with every numpy warning an error, refusals of decks and all other errors reported."""
    with np.errstate(all="raise"), warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return judged()
        except DeckError as error:
            line = refusal(error)
            return Judgement(family, value, Verdict.REFUSED if line else Verdict.NO_LINE, message=line or str(error))
        except (ArithmeticError, Warning, ValueError, LookupError, TypeError) as error:
            return Judgement(family, value, Verdict.WARNED, message=f"{type(error).__name__}: {error}")


def refusal(error: DeckError) -> str:
    """The first error with its line; empty where it names none."""
    errors = [found for found in error.diagnostics if found.severity is Severity.ERROR]
    first = min(errors, key=lambda found: found.line, default=None)
    if first is None or first.line <= 1:
        return ""
    return f"line {first.line}: {first.code} {first.message}"


def _judged(cell: Cell) -> Judgement:
    scene = scene_of(cell.text, _FILE)
    if cell.law is None:
        return Judgement(cell.family, cell.value, Verdict.WRONG, message="a deck without a valid law was accepted")
    tally, heights = Tally(), _heights(cell.law)
    if isinstance(cell.law, ExactCurve):
        _compare_curve(tally, scene, cell.law)
    message = _compare_heights(tally, scene, cell.law, heights)
    if message is None:
        refused = "a value was refused that a float64 can hold"
        return Judgement(cell.family, cell.value, Verdict.NO_LINE, message=refused)
    verdict = Verdict.WRONG if tally.fault else Verdict.RIGHT_UNTIL_REFUSED if message else Verdict.RIGHT
    return Judgement(cell.family, cell.value, verdict, tally.results, tally.error, BOUND, tally.fault or message)


def _heights(law: ExactLaw) -> list[float]:
    """Of the nodes: above the seabed, on it, and where the ratio is one that matters."""
    depths = [ratio * law.diameter for ratio in law.ratios() if isfinite(ratio) and ratio > 0.0]
    return [*_ABOVE, *(-depth for depth in depths if isfinite(depth))]


def _compare_heights(tally: Tally, scene: Scene, law: ExactLaw, heights: list[float]) -> str | None:
    """Compare the results at heights, as one series, or one by one where that is refused.

    Returns the first refusal, "" without any, None where a result was refused for no reason.
    """
    try:
        result = _evaluated(scene, heights)
    except DeckError:
        return _one_by_one(tally, scene, law, heights)
    for step, height in enumerate(heights):
        compare(tally, law, height, result.step(step))
    return ""


def _one_by_one(tally: Tally, scene: Scene, law: ExactLaw, heights: list[float]) -> str | None:
    message = ""
    for height in heights:
        try:
            result = _evaluated(scene, [height])
        except DeckError as error:
            line = refusal(error)
            if not line or not _overflows(law, height):
                return None
            message = message or line
        else:
            compare(tally, law, height, result.step(0))
    return message


def _overflows(law: ExactLaw, height: float) -> bool:
    """Whether some number of the result is too large for a float64."""
    ratio = -Fraction(height) / Fraction(law.diameter)
    spring = law.spring(-Fraction(height), ratio)
    return any(abs(number) > _LARGEST for number in (ratio, *spring))


def _evaluated(scene: Scene, heights: list[float]) -> ContactResult:
    points = np.zeros((len(heights), 2, 3))
    points[:, :, 0] = np.array(heights)[:, None]
    points[:, 1, 1] = 2.0
    with as_deck_errors(scene):
        return scene.contact().evaluate(points)


def _compare_curve(tally: Tally, scene: Scene, law: ExactCurve) -> None:
    """The curve itself, also above the seabed where no element asks for it."""
    curve = next(iter(scene.curves.values()))
    for ratio in law.ratios():
        spring = law.spring(Fraction(0), Fraction(ratio))
        if abs(spring.force) > _LARGEST or spring.term > _LARGEST:
            continue
        force, slope = curve.evaluate(ratio)
        tally.add(f"the curve at {ratio!r}", Compared(float(force), spring.force, spring.term))
        tally.add(f"the slope of the curve at {ratio!r}", Compared(float(slope), spring.slope, abs(spring.slope)))


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


SUCTION_BOUND = 64.0
"""Roundings of the largest suction. Powers and products behind a law take some 15; on the release, where the distance
to breakout is a tenth of the uplift, they count up to ten times in the distance, which is divided by a fifth again."""
SUCTION_FLOOR = 10**9 * SMALLEST
"""Velocity and cohesion are known to the smallest float64; the law multiplies that by its slopes, up to 10^8 here."""
VELOCITIES = ("0", "5E-324", "1E-300", "1E-100", "1E-30", "1E-10", "9.99E-4", "1E-3", "1E-1", "1E0", "1E3", "1E6")
COHESIONS = ("0", "5E-324", "1E-300", "1E-100", "1E-3", "1E0", "5E3", "1E6", "1E15", "1E100", "1E300", "1E308", "1E309")
_UPLIFTS = (0.05, 0.19, 0.21, 0.5, 0.79, 0.81, 0.9, 0.999, 1.001)
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
    return guarded(cell.family, cell.value, lambda: _suction_judged(cell))


def _suction_judged(cell: SuctionCell) -> Judgement:
    scene = scene_of(suction_deck(cell.cohesion), _FILE)
    model = scene.contact()
    if not model.input.has("suction"):
        return Judgement(cell.family, cell.value, Verdict.WRONG, message="the suction of the deck is missing")
    velocity = float(cell.velocity)
    heights, exact, largest = _expected(float(cell.cohesion), velocity, _UPLIFTS)
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
