"""The cells of the ladder: decks of one element of 2 m, and a family for each thing that is taken to its ends."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

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


def all_cells() -> list[Cell]:
    """All cells whose results do not depend on motion, family by family."""
    return [
        *_linear("linear stiffness", powers(-3, 15)),
        *_slopes(),
        *_jumps("jump to stiffer", up=True),
        *_jumps("jump to softer", up=False),
        *_widths(),
        *_ratios(),
        *_diameters(),
        *_softening(),
        *_linear("tiny linear stiffness", TINY),
        *_linear("huge linear stiffness", HUGE),
        *_forces("tiny curve forces", TINY),
        *_forces("huge curve forces", HUGE),
        *_far("tiny curve ratios", TINY),
        *_far("huge curve ratios", HUGE),
    ]


def powers(first: int, last: int) -> list[str]:
    """Powers of ten, as a deck has them."""
    return [f"1E{power}" for power in range(first, last + 1)]


def _linear(family: str, values: Sequence[str]) -> Iterator[Cell]:
    for value in values:
        yield Cell(family, value, linear_deck(value), ExactLinear(float(value), float(DIAMETER)))


def _slopes() -> Iterator[Cell]:
    """The same slope on a curve of two points."""
    for value in powers(-3, 15):
        yield _curve("curve stiffness", value, [("0", "0"), ("1", value)])


def _jumps(family: str, *, up: bool) -> Iterator[Cell]:
    """Segments whose slopes are so many times apart."""
    for value in powers(0, 12):
        far = float(value) * 0.1
        rows = [("0", "0"), ("0.1", "0.1"), ("0.2", repr(0.1 + far)), ("0.3", repr(0.2 + far))]
        if not up:
            rows = [("0", "0"), ("0.1", repr(far)), ("0.2", repr(far + 0.1)), ("0.3", repr(far + 0.1 + far))]
        yield _curve(family, value, rows)


def _widths() -> Iterator[Cell]:
    """A rise of 1000 on a segment so wide, which begins at a ratio of 0.1."""
    for power in range(-1, -19, -1):
        end = "0." + str(10 ** (-power - 1) + 1).zfill(-power)
        if power == -1:
            end = "0.2"
        yield _curve("segment width", f"1E{power}", [("0", "0"), ("0.1", "1000"), (end, "2000"), ("0.5", "3000")])


def _ratios() -> Iterator[Cell]:
    """A curve from one end to the other."""
    for value in powers(0, 9):
        rows = [(f"-{value}", "-5000"), ("0", "0"), ("0.1", "1000"), (value, "9000")]
        yield _curve("ratios up to", value, rows)


def _diameters() -> Iterator[Cell]:
    rows = [("0", "0"), ("0.1", "2000"), ("0.3", "4500"), ("0.5", "6000")]
    for value in powers(-6, 3):
        yield _curve("diameter", value, rows, value)


def _softening() -> Iterator[Cell]:
    """A curve that falls behind its peak, the last segment this steep; it pulls in the end."""
    for value in powers(0, 9):
        fall = 1000.0 - 0.1 * float(value)
        yield _curve("softening slope", f"-{value}", [("0", "0"), ("0.1", "1000"), ("0.2", repr(fall))])


def _forces(family: str, values: Sequence[str]) -> Iterator[Cell]:
    for value in values:
        yield _curve(family, value, [("0", "0"), ("0.1", value), ("0.4", value)])


def _far(family: str, values: Sequence[str]) -> Iterator[Cell]:
    for value in values:
        yield _curve(family, value, [("0", "0"), (value, "1000")])


def _curve(family: str, value: str, rows: Pairs, diameter: str = DIAMETER) -> Cell:
    points = [(float(ratio), float(force)) for ratio, force in rows]
    usable = len({ratio for ratio, _ in points}) == len(points) and all(abs(n) < 1e309 for pair in points for n in pair)
    law = ExactCurve(points, float(diameter)) if usable else None
    return Cell(family, value, curve_deck(rows, diameter), law)


def random_cells(count: int) -> list[Cell]:
    """Random decks, always the same ones: a linear law to every three curves, of numbers of any size."""
    rng = random.Random(_SEED)  # noqa: S311 - nothing secret about it
    return [_random_cell(rng, index) for index in range(count)]


def _random_cell(rng: random.Random, index: int) -> Cell:
    diameter = _number(rng, -6, 3)
    value = str(index + 1)
    if index % 4 == 0:
        stiffness = _number(rng, -320, 308)
        return Cell("random", value, linear_deck(stiffness, diameter), ExactLinear(float(stiffness), float(diameter)))
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
