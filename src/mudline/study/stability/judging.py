"""Evaluate a small deck from its text to forces, compare them with exact results, and give a verdict.

The verdicts and what all cells have in common are here, and the cells whose forces depend on the depth alone.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from math import isfinite
from sys import float_info
from typing import Annotated

import numpy as np

from mudline.contact.result import ContactResult
from mudline.diagnostics import DeckError, Severity
from mudline.results.evaluation import as_deck_errors
from mudline.scene.model import Scene
from mudline.study import scene_of
from mudline.study.exact import BOUND, Compared, ExactCurve, ExactLaw, Tally
from mudline.study.stability.small_decks import DIAMETER, LENGTH, Pairs, SmallDeck


@dataclass(frozen=True, slots=True)
class Cell:
    """A deck, its place on the ladder, and the law that it should give; None where the deck has no valid law."""

    family: str
    value: str
    text: str
    law: ExactLaw | None


def linear_deck(stiffness: str, diameter: str = DIAMETER) -> str:
    """A linear seabed."""
    return SmallDeck(stiffness=stiffness, diameter=diameter).text


def curve_deck(points: Pairs, diameter: str = DIAMETER) -> str:
    """A force-embedment curve; numbers as the deck has them."""
    return SmallDeck(curve=points, diameter=diameter).text


FILE = "cell.keyxm"
"""File name of a cell in diagnostics."""
_ABOVE = (0.0, 5e-324, 0.05, 1e6)
_LARGEST = Fraction(float_info.max) * (1 - Fraction(1, 2**50))


class Verdict(StrEnum):
    """Verdict on a cell; only the first three are acceptable."""

    RIGHT = "right"
    """Every result is within the bound."""
    RIGHT_UNTIL_REFUSED = "right, beyond refused"
    """Results are within the bound; where one would overflow it is refused, with a line of the deck."""
    REFUSED = "refused"
    """The deck is refused, with a line of the deck."""
    WRONG = "WRONG"
    """A result is outside its bound, or not finite."""
    NO_LINE = "REFUSED WITHOUT A LINE"
    """A refusal without a line, or of a result that fits a float64."""
    WARNED = "WARNED"
    """A numpy warning, or an error other than a diagnostic."""

    @property
    def acceptable(self) -> bool:
        """Whether it is one of the first three."""
        return self in {Verdict.RIGHT, Verdict.RIGHT_UNTIL_REFUSED, Verdict.REFUSED}


@dataclass(frozen=True, slots=True)
class Judgement:
    """A cell and its verdict.

    Attributes:
        family: the number that is set to extreme values.
        value: of the number, as the deck has it.
        error: in roundings (2^-53) of the largest term; 0 where nothing was compared.
        bound: roundings that are allowed.
        message: the diagnostic of a refusal, or what is wrong.
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
    """Judge a cell with every numpy warning as an error; refusals of decks and all other errors become verdicts."""
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
    scene = scene_of(cell.text, FILE)
    if cell.law is None:
        return Judgement(cell.family, cell.value, Verdict.WRONG, message="a deck without a valid law was accepted")
    tally, heights = Tally(), _heights(cell.law)
    if isinstance(cell.law, ExactCurve):
        _compare_curve(tally, scene, cell.law)
    message = _compare_heights(tally, scene, cell.law, heights)
    if message is None:
        refused = "a value that fits a float64 was refused"
        return Judgement(cell.family, cell.value, Verdict.NO_LINE, message=refused)
    verdict = Verdict.WRONG if tally.fault else Verdict.RIGHT_UNTIL_REFUSED if message else Verdict.RIGHT
    return Judgement(cell.family, cell.value, verdict, tally.results, tally.error, BOUND, tally.fault or message)


def _heights(law: ExactLaw) -> list[float]:
    """Of the nodes: above the seabed, on it, and where the ratio is one that matters."""
    depths = [ratio * law.diameter for ratio in law.ratios() if isfinite(ratio) and ratio > 0.0]
    return [*_ABOVE, *(-depth for depth in depths if isfinite(depth))]


def _compare_heights(tally: Tally, scene: Scene, law: ExactLaw, heights: list[float]) -> str | None:
    """Compare the results at heights, as one series, or one by one where the series is refused.

    Returns the first refusal, "" without any, None where a result was refused without reason.
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
    return any(abs(number) > _LARGEST for number in (ratio, *spring[:4]))


def _evaluated(scene: Scene, heights: list[float]) -> ContactResult:
    points = np.zeros((len(heights), 2, 3))
    points[:, :, 0] = np.array(heights)[:, None]
    points[:, 1, 1] = 2.0
    with as_deck_errors(scene):
        return scene.contact().evaluate(points)


def _compare_curve(tally: Tally, scene: Scene, law: ExactCurve) -> None:
    """Compare the curve itself, also above the seabed where no element evaluates it."""
    curve = next(iter(scene.curves.values()))
    for ratio in law.ratios():
        spring = law.spring(Fraction(0), Fraction(ratio))
        if abs(spring.force) > _LARGEST or spring.term > _LARGEST:
            continue
        force, slope = curve.evaluate(ratio)
        tally.add(f"the curve at {ratio!r}", Compared(float(force), spring.force, spring.term))
        tally.add(f"the slope of the curve at {ratio!r}", Compared(float(slope), spring.slope, abs(spring.slope)))


def compare(tally: Tally, law: ExactLaw, height: float, result: ContactResult) -> None:
    """Compare one element whose two nodes are at `height`."""
    for what, compared in _pairs(law, height, result):
        tally.add(f"{what} at height {height!r}", compared)


def _pairs(law: ExactLaw, height: float, result: ContactResult) -> Iterator[tuple[str, Compared]]:
    """Each result and what follows exactly from the results before it, so that no error hides behind another."""
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
        half = Fraction(numbers[0]) * Fraction(float(LENGTH)) / 2 if isfinite(numbers[0]) else Fraction(0)
        yield "a reaction", _itself(float(result.reaction[node, 0]), half)


def _itself(found: float, exact: Fraction) -> Compared:
    return Compared(found, exact, abs(exact))
