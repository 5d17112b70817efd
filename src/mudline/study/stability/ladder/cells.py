"""The cells of the ladder: decks of one element of 2 m, and a family for each thing that is taken to its ends."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from mudline.study.exact import ExactCurve, ExactLaw, ExactLinear

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
_SEED = 20040503
TINY = ("1E-3", "1E-100", "1E-300", "2.3E-308", "2.2E-308", "1E-310", "5E-324", "1E-400")
HUGE = ("1E3", "1E20", "1E100", "1E200", "1E300", "1E307", "1E308", "1.7976931348623157E308", "1E309", "1E400")


@dataclass(frozen=True, slots=True)
class Cell:
    """A deck, where it stands on the ladder, and the law that it should give; None where the deck holds no law."""

    family: str
    value: str
    text: str
    law: ExactLaw | None


class Family(NamedTuple):
    """What is taken to its ends: the values, as decks have them, and how a cell is made of the family and a value."""

    name: str
    values: Sequence[str]
    cell: Callable[[str, str], Cell]


def powers(first: int, last: int) -> list[str]:
    """Powers of ten from the first on to the last, as a deck has them."""
    return [f"1E{power}" for power in range(first, last + 1)]


def all_cells() -> list[Cell]:
    """All cells whose results do not depend on motion, family by family."""
    return [family.cell(family.name, value) for family in FAMILIES for value in family.values]


def _linear(family: str, value: str, diameter: str = DIAMETER, stiffness: str = "") -> Cell:
    law = ExactLinear(float(stiffness or value), float(diameter))
    return Cell(family, value, linear_deck(stiffness or value, diameter), law)


def _curve(family: str, value: str, rows: Pairs, diameter: str = DIAMETER) -> Cell:
    points = [(float(ratio), float(force)) for ratio, force in rows]
    usable = len({ratio for ratio, _ in points}) == len(points) and all(abs(n) < 1e309 for pair in points for n in pair)
    law = ExactCurve(points, float(diameter)) if usable else None
    return Cell(family, value, curve_deck(rows, diameter), law)


def _curves(rows: Callable[[str], Pairs]) -> Callable[[str, str], Cell]:
    """Cells on curves whose points follow from the value."""
    return lambda family, value: _curve(family, value, rows(value))


def _stiffer(value: str) -> Pairs:
    """Segments whose slopes are so many times apart."""
    far = float(value) * 0.1
    return [("0", "0"), ("0.1", "0.1"), ("0.2", repr(0.1 + far)), ("0.3", repr(0.2 + far))]


def _softer(value: str) -> Pairs:
    far = float(value) * 0.1
    return [("0", "0"), ("0.1", repr(far)), ("0.2", repr(far + 0.1)), ("0.3", repr(far + 0.1 + far))]


def _narrow(value: str) -> Pairs:
    """A rise of 1000 on a segment so wide, which begins at a ratio of 0.1."""
    power = int(value.removeprefix("1E-"))
    end = "0.2" if power == 1 else "0." + str(10 ** (power - 1) + 1).zfill(power)
    return [("0", "0"), ("0.1", "1000"), (end, "2000"), ("0.5", "3000")]


def _softening(value: str) -> Pairs:
    """A curve that falls behind its peak, the last segment this steep; it pulls in the end."""
    return [("0", "0"), ("0.1", "1000"), ("0.2", repr(1000.0 + 0.1 * float(value)))]


_MIDDLING = [("0", "0"), ("0.1", "2000"), ("0.3", "4500"), ("0.5", "6000")]
_FORCES = _curves(lambda value: [("0", "0"), ("0.1", value), ("0.4", value)])
_RATIOS = _curves(lambda value: [("0", "0"), (value, "1000")])
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
    Family("diameter", powers(-6, 3), lambda family, value: _curve(family, value, _MIDDLING, value)),
    Family("softening slope", [f"-{value}" for value in powers(0, 9)], _curves(_softening)),
    Family("tiny linear stiffness", TINY, _linear),
    Family("huge linear stiffness", HUGE, _linear),
    Family("tiny curve forces", TINY, _FORCES),
    Family("huge curve forces", HUGE, _FORCES),
    Family("tiny curve ratios", TINY, _RATIOS),
    Family("huge curve ratios", HUGE, _RATIOS),
)
"""The ladder; to add to it, add a row."""


def random_cells(count: int) -> list[Cell]:
    """Random decks, always the same ones: a linear law to every three curves, of numbers of any size."""
    rng = random.Random(_SEED)  # noqa: S311 - nothing secret about it
    return [_random_cell(rng, index) for index in range(count)]


def _random_cell(rng: random.Random, index: int) -> Cell:
    diameter = _number(rng, -6, 3)
    value = str(index + 1)
    if index % 4 == 0:
        return _linear("random", value, diameter, _number(rng, -320, 308))
    far = rng.choice((1, 9, 100, 308))
    rows = [(_signed(rng, far), _signed(rng, far)) for _ in range(rng.randint(2, 6))]
    return _curve("random", value, rows, diameter)


def _signed(rng: random.Random, far: int) -> str:
    return rng.choice(("", "", "", "-")) + _number(rng, -far, far)


def _number(rng: random.Random, low: int, high: int) -> str:
    return f"{rng.uniform(1.0, 9.999):.{rng.choice((0, 3, 16))}f}E{rng.randint(low, high - 1)}"


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
