"""The ladder of extremes: small decks with the largest and smallest numbers, against exact arithmetic.

Every deck is text, and goes through the whole program: read, resolved, stepped. A result is right, within a stated
bound, or it is refused with a diagnostic that names a line of the deck; nothing else is accepted. There is a family for
each number that is set to extreme values. An element goes down to the corners of its law, beside them and between them;
one with friction is then moved along the line, too little to slip, and far enough.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from math import isfinite
from sys import float_info

import numpy as np

from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import DeckError, Severity
from mudline.model.contact.model import ContactModel
from mudline.model.contact.result import ContactResult
from mudline.model.contact.tables import ContactState
from mudline.model.results.evaluation import as_deck_errors
from mudline.model.scene.model import Scene, resolve
from tests.model.contact.exact import SMALLEST, ExactCurve, ExactLaw, ExactLinear, ExactSmoothed, Tally

_LARGEST = Fraction(float_info.max) * (1 - Fraction(1, 2**50))
_ZERO = Fraction(0)
Pairs = Sequence[tuple[str, str]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Deck:
    """One element along +Y, all numbers as texts; an empty text is not in the deck.

    Attributes:
        diameter, length: of the element.
        stiffness: linear; not used with a curve. curve: embedment ratios and forces.
        half_width: of the quadratic zone. form: CENTRED or ONE-SIDED.
        friction: coefficient, and stiffness of its spring or the mobilisation length. mobilised: whether it is that.
    """

    diameter: str = "0.3"
    length: str = "2.0"
    stiffness: str = "50000.0"
    curve: Pairs = ()
    half_width: str = ""
    form: str = "CENTRED"
    friction: tuple[str, str] | None = None
    mobilised: bool = False

    @property
    def text(self) -> str:
        """The deck."""
        return "\n".join(self._lines()) + "\n"

    def _lines(self) -> Iterator[str]:
        yield from ("$MODEL", "*NODE", " 1, 0.0, 0.0, 0.0", f" 2, 0.0, {self.length}, 0.0", "*ELEMENT", " 1, 1, 2")
        yield from ("*GEOMETRIC SETS", " OPTION=RIGID", " SET=ALL")
        yield f" 207.0E9, 79.6E9, {self.diameter}, {0.5 * float(self.diameter)!r}, 7850.0"
        yield from ("*SEABED PROPERTIES", " TYPE=ELASTIC", " SET=ALL")
        yield f" STIFFNESS={'Extreme' if self.curve else self.stiffness}"
        coefficient, spring = self.friction or ("", "")
        if self.mobilised:
            yield f" FRICTION={coefficient}, {coefficient}, {spring}, {spring}"
        if self.curve:
            yield from ("*SEABED STIFFNESS", " CURVE=Extreme", *(f" {ratio}, {force}" for ratio, force in self.curve))
        if self.half_width:
            yield from ("*SEABED CONTACT", " SET=ALL", f" SMOOTHING={self.half_width}", f" FORM={self.form}")
        if self.friction and not self.mobilised:
            yield from ("*SEABED FRICTION", " SET=ALL", f" COEFFICIENTS={coefficient}, {coefficient}")
            yield f" STIFFNESS={spring}, {spring}"

    def law(self) -> ExactLaw:
        """The normal law; raises ValueError or ArithmeticError where its numbers make none."""
        diameter = float(self.diameter)
        if self.curve:
            points = [(float(ratio), float(force)) for ratio, force in self.curve]
            if len({ratio for ratio, _ in points}) < len(points):
                raise ValueError("two points at one ratio")
            return ExactCurve(points, diameter)
        if self.half_width:
            width, one_sided = float(self.half_width), self.form == "ONE-SIDED"
            return ExactSmoothed(float(self.stiffness), diameter, width, one_sided=one_sided)
        return ExactLinear(float(self.stiffness))


class Verdict(StrEnum):
    """Verdict on a cell; only the first three are acceptable."""

    RIGHT = "right"
    """Every result is within the bound."""
    RIGHT_UNTIL_REFUSED = "right, beyond refused"
    """Results are within the bound; where one would overflow it is refused, with a line of the deck."""
    REFUSED = "refused"
    """The deck is refused, with a line of the deck."""
    WRONG = "WRONG"
    """A result is outside its bound, a refusal has no line or no reason, or numpy warned."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """A cell: its family, the number as the deck has it, the verdict, and how many numbers were how far off."""

    family: str
    value: str
    verdict: Verdict
    results: int = 0
    error: float = 0.0
    message: str = ""


def judge(family: str, value: str, deck: Deck) -> Judgement:
    """Read, resolve, step and compare one deck, with every warning of numpy as an error."""
    with np.errstate(over="raise", divide="raise", invalid="raise"), warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return _judged(family, value, deck)
        except DeckError as error:
            line = _refusal(error)
            return Judgement(family, value, Verdict.REFUSED if line else Verdict.WRONG, message=line or str(error))
        except (ArithmeticError, Warning, ValueError, LookupError, TypeError) as error:
            return Judgement(family, value, Verdict.WRONG, message=f"{type(error).__name__}: {error}")


def _refusal(error: DeckError) -> str:
    """The first error with its line; empty where it names none."""
    errors = [found for found in error.diagnostics if found.severity is Severity.ERROR]
    first = min(errors, key=lambda found: found.line, default=None)
    return "" if first is None or first.line <= 1 else f"line {first.line}: {first.code} {first.message}"


def _judged(family: str, value: str, deck: Deck) -> Judgement:
    scene = resolve(load_bytes(deck.text.encode(), "cell.keyxm")).require()
    try:
        law = deck.law()
    except (ArithmeticError, ValueError):
        return Judgement(family, value, Verdict.WRONG, message="a deck without a valid law was accepted")
    with as_deck_errors(scene):
        model = scene.contact()
    tally, message = Tally(), ""
    depths = [float(scene.diameter[0]) * ratio for ratio in law.ratios()]
    for depth in [-0.05, 0.0, *filter(isfinite, depths), 0.02]:
        found, _, line = _stepped(scene, model, [depth, 0.0], model.initial_state())
        if found is None:
            if not line or not _overflows(deck, law, depth):
                return Judgement(family, value, Verdict.WRONG, message=f"refused without reason: {line}")
            message = message or line
            continue
        _compare(tally, deck, law, found)
        if deck.friction is not None and depth > 0.0:
            message = _slide(tally, deck, scene, model, found, depth) or message
    verdict = Verdict.WRONG if tally.fault else Verdict.RIGHT_UNTIL_REFUSED if message else Verdict.RIGHT
    return Judgement(family, value, verdict, tally.results, tally.error, tally.fault or message)


def _stepped(
    scene: Scene, model: ContactModel, place: Sequence[float], state: ContactState
) -> tuple[ContactResult | None, ContactState, str]:
    """The element at a depth and a displacement along the line; without a result, why it was refused."""
    depth, along = place
    points = scene.coordinates + np.array([-depth, along, 0.0])
    try:
        with as_deck_errors(scene):
            return *model.step(points, None, state), ""
    except DeckError as error:
        return None, state, _refusal(error)


def _overflows(deck: Deck, law: ExactLaw, depth: float) -> bool:
    """Whether some number of the result is too large for a float64."""
    ratio = Fraction(depth) / Fraction(float(deck.diameter))
    spring, length = law.spring(Fraction(depth), ratio), Fraction(float(deck.length))
    load = abs(spring.force) * length / 2
    mu, stiff = (Fraction(float(text)) for text in deck.friction or ("0", "1"))
    around = Fraction(1, 10**9) * max(Fraction(depth), Fraction(1, 10**300))
    slope = abs(
        law.spring(Fraction(depth) + around, ratio + around / Fraction(float(deck.diameter))).force - spring.force
    )
    numbers = (
        ratio,
        spring.force,
        spring.term,
        load,
        slope / around,
        mu * load,
        mu * load / stiff if deck.mobilised else stiff,
    )
    return any(abs(number) > _LARGEST for number in numbers)


def _compare(tally: Tally, deck: Deck, law: ExactLaw, found: ContactResult) -> None:
    """Compare the normal forces, each with what follows from the number before it."""
    depth, ratio, force = (float(part[0]) for part in (found.depth, found.ratio, found.force))
    quotient = Fraction(depth) / Fraction(float(deck.diameter))
    tally.add("the ratio", ratio, quotient, abs(quotient))
    touches = depth > 0.0 or (deck.half_width and deck.form == "CENTRED")
    spring = law.spring(Fraction(depth), Fraction(ratio)) if touches else None
    exact, term = (_ZERO, _ZERO) if spring is None else spring
    tally.add(f"the force at depth {depth!r}", force, exact, term)
    half = Fraction(force) * Fraction(float(deck.length)) / 2
    tally.add("the normal force", float(found.normal_force[0]), half, abs(half), SMALLEST * (2 + abs(Fraction(force))))


def _slide(tally: Tally, deck: Deck, scene: Scene, model: ContactModel, touched: ContactResult, depth: float) -> str:
    """Compare the friction at shares of the displacement at which it slips; why it was refused, if it was."""
    coefficient, given = (Fraction(float(text)) for text in deck.friction or ("0", "1"))
    load = Fraction(float(touched.normal_force[0]))
    limit = coefficient * load
    spring = limit / given if deck.mobilised else given
    reach = float(min(limit / spring, Fraction(10) ** 6)) if spring else 0.1
    for share in (0.3, 1.7, -1.3):
        _, state, line = _stepped(scene, model, [depth, 0.0], model.initial_state())
        found, _, line = _stepped(scene, model, [depth, share * reach], state)
        if found is None or found.friction is None:
            return line
        moved = Fraction(float(scene.coordinates[0, 1] + share * reach)) - Fraction(float(scene.coordinates[0, 1]))
        trial = spring * moved
        exact = max(min(trial, limit), -limit)
        term = max(abs(trial) if abs(trial) < 2 * limit else limit, abs(exact))
        floor = SMALLEST * (4 + 4 * spring + 4 * abs(moved) * (1 + load) + 4 * load)
        tally.add(f"the friction at {share} of its limit", 0.0 - float(found.friction[0, 0]), exact, term, floor)
    return ""


# ------------------------------------------------------------------------------------------------------------ families

_TINY = ("5E-324", "1E-320", "1E-308", "1E-300", "1E-200", "1E-100")
_HUGE = ("1E100", "1E200", "1E300", "1E305", "1E308", "1.7976931348623157E308", "1E309")
_ENDS = ("5E-324", "1E-310", "1E-300", "1E-100", "1E-10", "1E0", "1E10", "1E100", "1E300", "1E308")
_MIDDLING = (("0", "0"), ("0.1", "2000"), ("0.3", "4500"), ("0.5", "6000"))


def _powers(first: int, last: int) -> list[str]:
    return [f"1E{power}" for power in range(first, last + 1)]


def _narrow(value: str) -> Pairs:
    """A rise of 1000 on a segment of this width, which begins at a ratio of 0.1."""
    power = int(value.removeprefix("1E-"))
    end = "0.2" if power == 1 else "0." + str(10 ** (power - 1) + 1).zfill(power)
    return [("0", "0"), ("0.1", "1000"), (end, "2000"), ("0.5", "3000")]


def _bends(value: str) -> Pairs:
    """A slope of 1, one of this factor, and 1 again."""
    far = float(value) * 0.1
    return [("0", "0"), ("0.1", "0.1"), ("0.2", repr(0.1 + far)), ("0.3", repr(0.2 + far))]


def _curve(points: Callable[[str], Pairs]) -> Callable[[str], Deck]:
    return lambda value: Deck(curve=points(value))


FAMILIES: dict[str, tuple[Sequence[str], Callable[[str], Deck]]] = {
    "linear stiffness": ((*_TINY, *_powers(-3, 15), *_HUGE), lambda value: Deck(stiffness=value)),
    "curve: forces": (
        (*_TINY, *_powers(-3, 9), *_HUGE),
        _curve(lambda value: [("0", "0"), ("0.1", value), ("0.4", value)]),
    ),
    "curve: ratios": ((*_TINY, *_powers(-3, 9), *_HUGE), _curve(lambda value: [("0", "0"), (value, "1000")])),
    "curve: factor between slopes": (_powers(0, 15), _curve(_bends)),
    "curve: segment width": (_powers(-18, -1)[::-1], _curve(_narrow)),
    "curve: falling slope": (
        [f"-{power}" for power in _powers(0, 9)],
        _curve(lambda value: [("0", "0"), ("0.1", "1000"), ("0.2", repr(1000.0 + 0.1 * float(value)))]),
    ),
    "diameter": (_powers(-6, 3), lambda value: Deck(curve=_MIDDLING, diameter=value)),
    "element length": (_ENDS[2:-1], lambda value: Deck(length=value)),
    "smoothing, centred": (_ENDS, lambda value: Deck(half_width=value)),
    "smoothing, one-sided": (_ENDS, lambda value: Deck(half_width=value, form="ONE-SIDED")),
    "smoothed stiffness": (_ENDS, lambda value: Deck(half_width="0.005", stiffness=value)),
    "friction coefficient": (_ENDS, lambda value: Deck(friction=(value, "4E4"))),
    "friction spring": (_ENDS, lambda value: Deck(friction=("0.4", value))),
    "mobilisation length": (_ENDS, lambda value: Deck(friction=("0.4", value), mobilised=True)),
    "mobilised coefficient": (_ENDS, lambda value: Deck(friction=(value, "0.003"), mobilised=True)),
    "friction, stiffness below": (_ENDS, lambda value: Deck(friction=("0.4", "4E4"), stiffness=value)),
}
"""The ladder; to add to it, add a row."""
