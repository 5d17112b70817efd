"""Cells on a path: a small deck whose element moves down, sideways, back and up, each step against exact arithmetic.

The exact values follow from the texts of the deck, not from what the program has read.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from mudline.diagnostics import DeckError
from mudline.results.evaluation import as_deck_errors
from mudline.scene.model import Scene
from mudline.study import scene_of
from mudline.study.exact import BOUND, ExactCurve, ExactLinear, ExactSmoothed, Tally
from mudline.study.exact_geometry import ExactPlane, cross
from mudline.study.exact_steps import ExactElement, ExactFriction, ExactStep, NormalLaw
from mudline.study.stability.judging import FILE, Judgement, Verdict, guarded, refusal
from mudline.study.stability.small_decks import Pair, SmallDeck

Place = tuple[float, float, float]
"""Depth along the normal, and displacements along the line and across it."""
TILTED_BOUND = 32.0
"""Roundings where directions are no axes. A unit vector along the line takes eight (differences, squares, their sum,
root, quotient), its projection on the plane and that one's length as many again; two such vectors are multiplied for u2
and thrice with displacements."""


@dataclass(frozen=True, slots=True)
class PathCell:
    """A deck, its place on the ladder, and the path of its element."""

    family: str
    value: str
    deck: SmallDeck
    path: Sequence[Place]
    bound: float = BOUND

    @property
    def text(self) -> str:
        """The deck."""
        return self.deck.text


def judge_path(cell: PathCell) -> Judgement:
    """Read, resolve, step and compare one cell."""
    return guarded(cell.family, cell.value, lambda: _judged(cell))


def _judged(cell: PathCell) -> Judgement:
    scene = scene_of(cell.text, FILE)
    try:
        element = exact_element(cell.deck)
    except (ArithmeticError, ValueError):
        return Judgement(cell.family, cell.value, Verdict.WRONG, message="a deck without a valid law was accepted")
    tally = Tally()
    message = _follow(scene, element, [scene.coordinates, *points_of(cell.deck, element, cell.path)], tally, cell.bound)
    if message is None:
        refused = "a value that fits a float64 was refused"
        return Judgement(cell.family, cell.value, Verdict.NO_LINE, message=refused)
    if message and not tally.results:
        return Judgement(cell.family, cell.value, Verdict.REFUSED, message=message)
    verdict = Verdict.WRONG if tally.fault else Verdict.RIGHT_UNTIL_REFUSED if message else Verdict.RIGHT
    return Judgement(cell.family, cell.value, verdict, tally.results, tally.error, cell.bound, tally.fault or message)


def _follow(scene: Scene, element: ExactElement, steps: Sequence[np.ndarray], tally: Tally, bound: float) -> str | None:
    """Step along the path. Returns the first refusal, "" without any, None for one without reason."""
    with as_deck_errors(scene):
        model = scene.contact()
    state, message = model.initial_state(), ""
    exact = ExactStep(element, tally, bound)
    still = np.zeros((2, 3))
    for points in steps:
        places = points.tolist()
        try:
            with as_deck_errors(scene):
                result, after = model.step(points, still, state)
        except DeckError as error:
            line = refusal(error)
            if not line or not exact.may_overflow(places, state):
                return None
            message = message or line
            continue
        exact.compare(places, state, result, after)
        state = after
    return message


def points_of(deck: SmallDeck, element: ExactElement, path: Sequence[Place]) -> list[np.ndarray]:
    """The positions (2, 3) of both nodes at each place of a path, the line along the direction of the slope."""
    plane = element.plane
    along = plane.along((Fraction(0), Fraction(1), Fraction(0)))
    axes = [np.array([float(part) for part in axis]) for axis in (plane.normal, along, cross(plane.normal, along))]
    start = np.array([float(part) for part in plane.point])
    found = []
    with np.errstate(all="ignore"):
        for depth, ahead, aside in path:
            here = start - depth * axes[0] + ahead * axes[1] + aside * axes[2]
            found.append(np.array([here, here + float(deck.length) * axes[1]]))
    return [points for points in found if np.isfinite(points).all()]


# ---------------------------------------------------------------------------------------------- what a deck's texts say


def exact_element(deck: SmallDeck) -> ExactElement:
    """The element of a deck; raises ValueError or ArithmeticError where its numbers make none."""
    diameter = float(deck.diameter)
    smoothed = float(deck.smoothing) if deck.smoothing else 0.0

    def linear(stiffness: str) -> ExactLinear | ExactSmoothed:
        if smoothed:
            return ExactSmoothed(float(stiffness), diameter, smoothed, deck.form == "ONE-SIDED")
        return ExactLinear(float(stiffness), diameter)

    law: NormalLaw | None = None
    if deck.curve:
        law = ExactCurve([(float(ratio), float(force)) for ratio, force in deck.curve], diameter)
    elif not deck.nodal:
        law = linear(deck.stiffness)
    return ExactElement(
        diameter,
        abs(Fraction(float(deck.length)) - Fraction(float(deck.start))),
        ExactPlane(float(deck.slope or 0), float(deck.direction), list(map(float, deck.point or ("0", "0", "0")))),
        law,
        linear(deck.nodal) if deck.nodal else None,
        float(deck.unloading) if deck.unloading else None,
        _friction(deck),
        float(deck.lateral) if deck.lateral else None,
        _pair(deck.uplift),
    )


def _friction(deck: SmallDeck) -> ExactFriction | None:
    coefficients = _pair(deck.coefficients)
    if coefficients is None:
        return None
    if deck.lateral and float(deck.lateral) > 0.0:
        coefficients = coefficients[0], 0.0
    springs = None if deck.mobilisation else _pair(deck.springs)
    ellipse = deck.criterion == "ELLIPSE" and springs is not None
    angle = float(deck.angle) if deck.angle and springs is not None else None
    return ExactFriction(coefficients, springs, _pair(deck.mobilisation), ellipse, angle)


def _pair(texts: Pair | None) -> tuple[float, float] | None:
    return None if texts is None else (float(texts[0]), float(texts[1]))


# --------------------------------------------------------------------------------------------------------------- paths


def slide(depth: float, along: float, across: float) -> list[Place]:
    """Touches down, sticks, slips, turns back, slips the other way, lifts off and comes down again.

    At `depth` the friction is at its limit at displacements `along` and `across`.
    """
    stations = (
        (1.0, 0.0, 0.0),
        (1.0, 0.3, 0.2),
        (1.0, 1.7, 1.5),
        (1.0, 1.5, 1.4),
        (2.0, -1.3, -1.1),
        (0.5, -1.2, -1.1),
        (-1.0, 0.0, 0.0),
        (1.0, 0.4, 0.4),
        (1.0, 0.9, -3.0),
        (0.0, -0.0, -0.0),
    )
    return [(depth * z, along * one, across * other) for z, one, other in stations]


def plunge(depth: float, back: float) -> list[Place]:
    """Goes down, back by a distance over which the force vanishes, up and out, and down beyond."""
    down = [depth, depth - 0.5 * back, depth - 0.999 * back, depth - 1.5 * back, -0.1 * depth, depth - 0.25 * back]
    return [(z, 0.0, 0.0) for z in (0.3 * depth, *down, 1.4 * depth, 1.37 * depth, 0.0, 3.1 * depth)]


def sweep(*depths: float) -> list[Place]:
    """Each of these depths, down and up, without moving sideways."""
    return [(depth, 0.0, 0.0) for depth in depths]


Path = Callable[[SmallDeck], Sequence[Place]]


def limits(deck: SmallDeck, depth: float = 0.01) -> tuple[float, float]:
    """Displacements at which friction is at its limit under the law of the deck at a depth; 0.1 without friction."""
    element = exact_element(deck)
    spring = element.law.spring(Fraction(depth), Fraction(depth) / Fraction(element.diameter)) if element.law else None
    load = Fraction(0) if spring is None else spring.force * element.length / 2
    if element.nodal is not None:
        load += element.nodal.spring(Fraction(depth), Fraction(0)).force
    found = []
    for side in range(2):
        reach = Fraction(0)
        if element.friction is not None and (stiffness := element.friction.spring(side, load)) > 0:
            reach = element.friction.limit(side, load) / stiffness
        found.append(float(min(reach, Fraction(10) ** 300)) or 0.1)
    return found[0], found[1]
