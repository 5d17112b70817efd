"""The ladder of extremes: a family of cells for each number that is set to extreme values, and random decks.

To add to the ladder, add a row to `FAMILIES`.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import NamedTuple, TypeAlias

from mudline.study.exact import BOUND, ExactCurve, ExactLinear
from mudline.study.stability.judging import Cell, Judgement, curve_deck, linear_deck
from mudline.study.stability.judging import judge as judge_heights
from mudline.study.stability.paths import (
    TILTED_BOUND,
    PathCell,
    Place,
    exact_element,
    judge_path,
    limits,
    plunge,
    slide,
    sweep,
)
from mudline.study.stability.pull_out import SuctionCell, judge_suction
from mudline.study.stability.small_decks import DIAMETER, Pairs, SmallDeck

AnyCell: TypeAlias = Cell | PathCell | SuctionCell

RANDOM = "random"
"""The family of the random decks."""
_SEED = 20040503
TINY = ("1E-3", "1E-100", "1E-300", "2.3E-308", "2.2E-308", "1E-310", "5E-324", "1E-400")
HUGE = ("1E3", "1E20", "1E100", "1E200", "1E300", "1E307", "1E308", "1.7976931348623157E308", "1E309", "1E400")
ENDS = ("5E-324", "1E-310", "1E-300", "1E-100", "1E-10", "1E0", "1E10", "1E100", "1E300", "1E308")
LENGTHS = (*ENDS[:3], "1E-200", *ENDS[3:8], "1E200", "1E300")
ANGLES = (
    "5E-324",
    "1E-300",
    "1E-20",
    "1E-10",
    "1E-3",
    "30.0",
    "45.0",
    "60.0",
    "-75.0",
    "89.0",
    "89.9999",
    "89.9999999999",
    "89.99999999999999",
)
HEADINGS = ("-1E-300", "1E-20", "30.0", "90.0", "135.0", "-180.0", "179.9999999999", "270.0", "1E10", "1E100")
PLACES = ("1E-300", "1E-100", "1E-10", "1E0", "1E10", "1E100", "1E150", "1E151")


class Family(NamedTuple):
    """A number that is set to extreme values: the values, as decks have them, and the cell of family and value."""

    name: str
    values: Sequence[str]
    cell: Callable[[str, str], AnyCell]


def judge(cell: AnyCell) -> Judgement:
    """The verdict on a cell of any kind."""
    if isinstance(cell, PathCell):
        return judge_path(cell)
    return judge_suction(cell) if isinstance(cell, SuctionCell) else judge_heights(cell)


def powers(first: int, last: int) -> list[str]:
    """Powers of ten from the first on to the last, as a deck has them."""
    return [f"1E{power}" for power in range(first, last + 1)]


def all_cells() -> list[AnyCell]:
    """All cells but those of suction, family by family."""
    return [family.cell(family.name, value) for family in FAMILIES for value in family.values]


# --------------------------------------------------------------------------------------------------- by the depth alone


def _linear(family: str, value: str, diameter: str = DIAMETER, stiffness: str = "") -> Cell:
    law = ExactLinear(float(stiffness or value), float(diameter))
    return Cell(family, value, linear_deck(stiffness or value, diameter), law)


def curve_cell(family: str, value: str, rows: Pairs, diameter: str = DIAMETER) -> Cell:
    """A curve of these points; without a law where they make none."""
    points = [(float(ratio), float(force)) for ratio, force in rows]
    usable = len({ratio for ratio, _ in points}) == len(points) and all(abs(n) < 1e309 for pair in points for n in pair)
    law = ExactCurve(points, float(diameter)) if usable else None
    return Cell(family, value, curve_deck(rows, diameter), law)


def _curves(rows: Callable[[str], Pairs]) -> Callable[[str, str], Cell]:
    """Cells on curves whose points follow from the value."""
    return lambda family, value: curve_cell(family, value, rows(value))


def _stiffer(value: str) -> Pairs:
    """Segments whose slopes differ by this factor."""
    far = float(value) * 0.1
    return [("0", "0"), ("0.1", "0.1"), ("0.2", repr(0.1 + far)), ("0.3", repr(0.2 + far))]


def _softer(value: str) -> Pairs:
    far = float(value) * 0.1
    return [("0", "0"), ("0.1", repr(far)), ("0.2", repr(far + 0.1)), ("0.3", repr(far + 0.1 + far))]


def _narrow(value: str) -> Pairs:
    """A rise of 1000 on a segment of this width, which begins at a ratio of 0.1."""
    power = int(value.removeprefix("1E-"))
    end = "0.2" if power == 1 else "0." + str(10 ** (power - 1) + 1).zfill(power)
    return [("0", "0"), ("0.1", "1000"), (end, "2000"), ("0.5", "3000")]


def _softening(value: str) -> Pairs:
    """A curve that falls after its peak, with this slope of the last segment; its force ends below 0."""
    return [("0", "0"), ("0.1", "1000"), ("0.2", repr(1000.0 + 0.1 * float(value)))]


_MIDDLING = (("0", "0"), ("0.1", "2000"), ("0.3", "4500"), ("0.5", "6000"))
_FORCES = _curves(lambda value: [("0", "0"), ("0.1", value), ("0.4", value)])
_RATIOS = _curves(lambda value: [("0", "0"), (value, "1000")])


# ------------------------------------------------------------------------------------------------------------- on paths

_RUBS = SmallDeck(coefficients=("0.4", "0.7"))
_MOBILISED = SmallDeck(coefficients=("0.4", "0.7"), mobilisation=("0.003", "0.15"))
_BACK = SmallDeck(unloading="250000.0")
_SIDE = SmallDeck(lateral="3000.0", coefficients=("0.4", "0.7"))
_ROUND = SmallDeck(smoothing="0.005")
_NODAL = SmallDeck(nodal="40000.0", smoothing="0.004")
_TILTED = SmallDeck(slope="10.0", direction="30.0", coefficients=("0.4", "0.7"))


def _on_path(
    made: Callable[[str], SmallDeck], path: Callable[[SmallDeck], Sequence[Place]], bound: float = BOUND
) -> Callable[[str, str], PathCell]:
    """Cells of decks that follow from the value, on paths that follow from the deck."""

    def cell(family: str, value: str) -> PathCell:
        deck = made(value)
        try:
            places = path(deck)
        except (ArithmeticError, ValueError):  # a number of the deck is not a float64: it must be refused
            places = ()
        return PathCell(family, value, deck, places, bound)

    return cell


def sliding(deck: SmallDeck, depth: float = 0.01) -> list[Place]:
    """A path on which friction sticks, slips and turns back."""
    return slide(depth, *limits(deck, depth))


def returning(deck: SmallDeck, depth: float = 0.03) -> list[Place]:
    """A path on which a force vanishes on unloading and comes back."""
    element = exact_element(deck)
    if element.law is None or not deck.unloading:
        return plunge(depth, depth)
    ratio = Fraction(depth) / Fraction(element.diameter)
    force = element.law.spring(Fraction(depth), ratio).force
    line = max(Fraction(float(deck.unloading)), element.law.steepest(ratio))
    return plunge(depth, float(min(force / line, Fraction(depth))) if line else depth)


def through_zone(deck: SmallDeck) -> list[Place]:
    """Depths in the quadratic zone of a deck, at its ends and beyond it."""
    width = float(deck.smoothing)
    shares = (-1.5, -1.0, -0.999, -0.5, -1e-9, 0.0, 1e-9, 0.3, 0.999, 1.0, 1.001, 1.9, 2.0, 2.1, 30.0)
    return [place for place in sweep(*(share * width for share in shares), 0.01) if abs(place[0]) < 1e308]


_SIDEWAYS = slide(0.01, 0.05, 0.03)


def _both(value: str) -> tuple[str, str]:
    return value, value


_ZEROS = {
    "X, Y, Z": replace(_RUBS, height="-0.0", across="-0.0", start="-0.0"),
    "stiffness": replace(_RUBS, stiffness="-0.0"),
    "ratio": SmallDeck(curve=(("-0.0", "0"), ("0.2", "900")), coefficients=("0.4", "0.7")),
    "force": SmallDeck(curve=(("0", "-0.0"), ("0.2", "900")), unloading="90000.0"),
    "no force": SmallDeck(curve=(("0", "-0.0"), ("0.2", "-0.0")), coefficients=("0.4", "0.7")),
    "nodal": SmallDeck(nodal="-0.0", coefficients=("0.4", "0.7")),
    "mu": replace(_RUBS, coefficients=("-0.0", "-0.0")),
    "ellipse": replace(_RUBS, coefficients=("-0.0", "0.4"), criterion="ELLIPSE"),
    "springs": replace(_RUBS, springs=("-0.0", "-0.0")),
    "angle": replace(_RUBS, angle="-0.0"),
    "lateral": replace(_SIDE, lateral="-0.0"),
    "uplift": SmallDeck(uplift=("-0.0", "0.1")),
    "slope": replace(_TILTED, slope="-0.0", direction="-0.0"),
    "plane": replace(_TILTED, slope="-0.0", direction="-0.0", point=("-0.0", "-0.0", "-0.0")),
    "-1E-400": replace(_RUBS, height="-1E-400", across="-1E-400", coefficients=("-1E-400", "0.4")),
}
"""Decks with negative zeros, by the name of the number."""

FAMILIES = (
    Family("linear stiffness", powers(-3, 15), _linear),
    Family("curve stiffness", powers(-3, 15), _curves(lambda value: [("0", "0"), ("1", value)])),
    Family("jump to stiffer", powers(0, 12), _curves(_stiffer)),
    Family("jump to softer", powers(0, 12), _curves(_softer)),
    Family("segment width", powers(-18, -1)[::-1], _curves(_narrow)),
    Family(
        "ratios up to",
        powers(0, 9),
        _curves(lambda value: [(f"-{value}", "-5000"), ("0", "0"), ("0.1", "1000"), (value, "9000")]),
    ),
    Family("diameter", powers(-6, 3), lambda family, value: curve_cell(family, value, _MIDDLING, value)),
    Family("softening slope", [f"-{value}" for value in powers(0, 9)], _curves(_softening)),
    Family("tiny linear stiffness", TINY, _linear),
    Family("huge linear stiffness", HUGE, _linear),
    Family("tiny curve forces", TINY, _FORCES),
    Family("huge curve forces", HUGE, _FORCES),
    Family("tiny curve ratios", TINY, _RATIOS),
    Family("huge curve ratios", HUGE, _RATIOS),
    Family("element length", LENGTHS, _on_path(lambda value: replace(_RUBS, length=value), sliding)),
    Family(
        "element length, lateral", LENGTHS, _on_path(lambda value: replace(_SIDE, length=value), lambda _: _SIDEWAYS)
    ),
    Family("negative zero", tuple(_ZEROS), _on_path(lambda value: _ZEROS[value], sliding, TILTED_BOUND)),
    Family("friction coefficients", ENDS, _on_path(lambda value: replace(_RUBS, coefficients=_both(value)), sliding)),
    Family("friction springs", ENDS, _on_path(lambda value: replace(_RUBS, springs=_both(value)), sliding)),
    Family(
        "mobilisation lengths", ENDS, _on_path(lambda value: replace(_MOBILISED, mobilisation=_both(value)), sliding)
    ),
    Family(
        "mobilised coefficients", ENDS, _on_path(lambda value: replace(_MOBILISED, coefficients=_both(value)), sliding)
    ),
    Family(
        "ellipse, one coefficient",
        ENDS,
        _on_path(lambda value: replace(_RUBS, coefficients=("0.4", value), criterion="ELLIPSE"), sliding, TILTED_BOUND),
    ),
    Family(
        "ellipse, one spring",
        ENDS,
        _on_path(lambda value: replace(_RUBS, springs=("4E4", value), criterion="ELLIPSE"), sliding, TILTED_BOUND),
    ),
    Family("friction under a stiffness", ENDS, _on_path(lambda value: replace(_RUBS, stiffness=value), sliding)),
    Family("friction angle", HEADINGS, _on_path(lambda value: replace(_RUBS, angle=value), sliding, TILTED_BOUND)),
    Family("smoothing, centred", ENDS, _on_path(lambda value: replace(_ROUND, smoothing=value), through_zone)),
    Family(
        "smoothing, one-sided",
        ENDS,
        _on_path(lambda value: replace(_ROUND, smoothing=value, form="ONE-SIDED"), through_zone),
    ),
    Family("smoothed stiffness", ENDS, _on_path(lambda value: replace(_ROUND, stiffness=value), through_zone)),
    Family("unloading stiffness", ENDS, _on_path(lambda value: replace(_BACK, unloading=value), returning)),
    Family(
        "unloading from a curve",
        ENDS,
        _on_path(lambda value: replace(_BACK, unloading=value, curve=_MIDDLING), returning),
    ),
    Family("unloaded stiffness", ENDS, _on_path(lambda value: replace(_BACK, stiffness=value), returning)),
    Family(
        "unloading depth",
        ENDS,
        lambda family, value: PathCell(family, value, _BACK, returning(_BACK, float(value))),
    ),
    Family("lateral spring", ENDS, _on_path(lambda value: replace(_SIDE, lateral=value), lambda _: _SIDEWAYS)),
    Family(
        "spring against uplift",
        ENDS,
        _on_path(lambda value: SmallDeck(uplift=(value, "0.05")), lambda _: sweep(0.01, -1e-300, -0.03, -0.05, -0.06)),
    ),
    Family(
        "nodal stiffness", ENDS, _on_path(lambda value: SmallDeck(nodal=value, coefficients=("0.4", "0.7")), sliding)
    ),
    Family("nodal smoothing", ENDS, _on_path(lambda value: replace(_NODAL, smoothing=value), through_zone)),
    Family("slope", ANGLES, _on_path(lambda value: replace(_TILTED, slope=value), sliding, TILTED_BOUND)),
    Family(
        "slope of a plane",
        ANGLES,
        _on_path(lambda value: replace(_TILTED, slope=value, point=("3.0", "0.0", "0.0")), sliding, TILTED_BOUND),
    ),
    Family(
        "direction of a slope",
        HEADINGS,
        _on_path(lambda value: replace(_TILTED, direction=value), sliding, TILTED_BOUND),
    ),
    Family(
        "lateral on a slope",
        ANGLES,
        _on_path(lambda value: replace(_SIDE, slope=value, direction="30.0"), lambda _: _SIDEWAYS, TILTED_BOUND),
    ),
    Family(
        "point of a plane",
        PLACES,
        _on_path(lambda value: replace(_TILTED, point=(value, value, value)), sliding, TILTED_BOUND),
    ),
)
"""The ladder; to add to it, add a row."""


# --------------------------------------------------------------------------------------------------------- random decks


def random_cells(count: int) -> list[AnyCell]:
    """Random decks, the same in each run: every other one has one law, the rest all laws on a path."""
    rng = random.Random(_SEED)  # noqa: S311 - nothing secret about it
    return [_random_cell(rng, index) for index in range(count)]


def _random_cell(rng: random.Random, index: int) -> AnyCell:
    value = str(index + 1)
    if index % 2:
        return _random_path(rng, value)
    diameter = _number(rng, -6, 3)
    if index % 8 == 0:
        return _linear(RANDOM, value, diameter, _number(rng, -320, 308))
    return curve_cell(RANDOM, value, _random_curve(rng), diameter)


def _random_curve(rng: random.Random) -> Pairs:
    far = rng.choice((1, 9, 100, 308))
    return [(_signed(rng, far), _signed(rng, far)) for _ in range(rng.randint(2, 6))]


def _random_path(rng: random.Random, value: str) -> PathCell:
    """A deck with all laws, on a path on which its friction slips."""
    far = rng.choice((3, 30, 150, 307))

    def number() -> str:
        return _number(rng, -far, far)

    def maybe(made: Callable[[], str], share: float = 0.3) -> str:
        return made() if rng.random() < share else ""

    def pair() -> tuple[str, str]:
        return number(), number()

    smoothing = maybe(number)
    deck = SmallDeck(
        length=_number(rng, -min(far, 200), min(far, 200)),
        diameter=_number(rng, -6, 3),
        stiffness=number(),
        curve=_rising(rng, far) if not smoothing and rng.random() < 0.4 else (),
        nodal=maybe(number) if smoothing else "",
        smoothing=smoothing,
        form=rng.choice(("CENTRED", "ONE-SIDED")),
        unloading="" if smoothing else maybe(number, 0.5),
        coefficients=pair() if rng.random() < 0.8 else None,
        springs=pair(),
        criterion=rng.choice(("BOX", "ELLIPSE")),
        angle=maybe(lambda: repr(rng.uniform(-180.0, 180.0))),
        mobilisation=pair() if rng.random() < 0.3 else None,
        lateral=maybe(number),
        uplift=pair() if rng.random() < 0.2 else None,
        slope=maybe(lambda: repr(rng.uniform(-89.0, 89.0)), 0.5),
        direction=repr(rng.uniform(-360.0, 360.0)),
        point=(number(), "0.0", number()) if far < 150 and rng.random() < 0.3 else None,
    )
    depth = float(_number(rng, -min(far, 100), min(far, 100)))

    def path(made: SmallDeck) -> list[Place]:
        return [*sliding(made, depth), *returning(made, depth)]

    return _on_path(lambda _: deck, path, TILTED_BOUND)(RANDOM, value)


def _rising(rng: random.Random, far: int) -> Pairs:
    """A curve without forces below 0."""
    ratios, forces = (sorted(float(_number(rng, -far, far)) for _ in range(3)) for _ in range(2))
    return [("0", "0"), *((repr(ratio), repr(force)) for ratio, force in zip(ratios, forces, strict=True))]


def _signed(rng: random.Random, far: int) -> str:
    return rng.choice(("", "", "", "-")) + _number(rng, -far, far)


def _number(rng: random.Random, low: int, high: int) -> str:
    return f"{rng.uniform(1.0, 9.999):.{rng.choice((0, 3, 16))}f}E{rng.randint(low, high - 1)}"
