"""A ladder of extremes: small decks with numbers at the ends of what numbers can be, against exact arithmetic.

Every deck is text, and goes through the whole program: read, resolved, evaluated. A result is right, within a stated
bound, or it is refused with a diagnostic that names a line of the deck; nothing else is accepted. There is a family of
cells for each thing that is taken to its ends.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.scene.model import Scene
from mudline.study.exact import ExactCurve, ExactLinear
from mudline.study.pictures import Picture
from mudline.study.report import Layout, Section, StudyOptions, columns_of, grouped
from mudline.study.stability.judging import (
    DIAMETER,
    Cell,
    Judgement,
    Pairs,
    Verdict,
    curve_deck,
    judge,
    judge_suction,
    linear_deck,
    suction_cells,
)

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.figure import Figure


_SEED = 20040503
TINY = ("1E-3", "1E-100", "1E-300", "2.3E-308", "2.2E-308", "1E-310", "5E-324", "1E-400")
HUGE = ("1E3", "1E20", "1E100", "1E200", "1E300", "1E307", "1E308", "1.7976931348623157E308", "1E309", "1E400")


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


RANDOM_DECKS = 4000
"""Random decks in a full run."""
_COLORS = {
    Verdict.RIGHT: "#9ecae1",
    Verdict.RIGHT_UNTIL_REFUSED: "#c7e9c0",
    Verdict.REFUSED: "#fdd49e",
    Verdict.WRONG: "#b2182b",
    Verdict.NO_LINE: "#67001f",
    Verdict.WARNED: "#3f007d",
}


def _count(part: Sequence[Judgement], *verdicts: Verdict) -> int:
    return sum(one.verdict in verdicts for one in part)


BY_FAMILY = Layout[Sequence[Judgement]](
    "ladder",
    "Ladder of extremes, by family",
    {
        "family": lambda part: part[0].family,
        "cells": len,
        "right": lambda part: _count(part, Verdict.RIGHT),
        "refused beyond": lambda part: _count(part, Verdict.RIGHT_UNTIL_REFUSED),
        "refused": lambda part: _count(part, Verdict.REFUSED),
        "anything else": lambda part: sum(not one.verdict.acceptable for one in part),
        "numbers compared": lambda part: sum(one.results for one in part),
        "largest error [2^-53]": lambda part: max(one.error for one in part),
        "bound [2^-53]": lambda part: max(one.bound for one in part),
    },
)
BY_CELL = Layout("ladder-cells", "Ladder of extremes, cell by cell", columns_of(Judgement), brief=False)


def study_ladder(_: Scene, options: StudyOptions) -> Section:
    """The verdict on every cell, and in a full run on random decks."""
    options.progress("ladder of extremes")
    judgements = [*map(judge, all_cells()), *map(judge_suction, suction_cells())]
    picture = _picture(grouped(judgements, lambda one: one.family))
    if options.full:
        options.progress(f"{RANDOM_DECKS} random decks")
        judgements += map(judge, random_cells(RANDOM_DECKS))
    tables = BY_FAMILY.table(grouped(judgements, lambda one: one.family).values()), BY_CELL.table(judgements)
    rejected = [one for one in judgements if not one.verdict.acceptable]
    right = len(judgements) - len(rejected)
    summary = (
        f"{right} of {len(judgements)} cells of the ladder of extremes are right within their bound or refused with a "
        "line of the deck."
    )
    notes = [summary, *(f"{one.family} {one.value}: {one.verdict.value}: {one.message}" for one in rejected)]
    return Section(tables, [picture], notes)


def _picture(families: Mapping[str, Sequence[Judgement]]) -> Picture:
    """A square for each cell, in a row for each family."""
    caption = "Verdict on each cell of the ladder of extremes."
    return Picture("ladder", caption, partial(_draw, families), (13.0, 1.8 + 0.36 * len(families)))


def _draw(families: Mapping[str, Sequence[Judgement]], figure: Figure) -> None:
    from matplotlib.patches import Patch, Rectangle  # noqa: PLC0415 - only who draws loads it

    axes = figure.subplots()
    for row, judgements in enumerate(families.values()):
        for column, judged in enumerate(judgements):
            color = _COLORS[judged.verdict]
            axes.add_patch(Rectangle((column, row), 1, 1, facecolor=color, edgecolor="white", linewidth=1.5))
            text = judged.value.replace("1.7976931348623157E308", "1.8E308")
            axes.text(column + 0.5, row + 0.5, text, ha="center", va="center", fontsize=6.5)
    axes.set_xlim(0, max(map(len, families.values())))
    axes.set_ylim(len(families), 0)
    axes.set_yticks(np.arange(len(families)) + 0.5, list(families))
    axes.set_xticks([])
    axes.set_xlabel("rungs of each ladder; the number is that of the deck, in its own units (SI)")
    axes.set_title("What comes out of decks with extreme numbers", fontsize="medium")
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
    counts = {verdict: sum(_count(part, verdict) for part in families.values()) for verdict in Verdict}
    named = [Patch(facecolor=_COLORS[one], label=f"{one.value}: {count}") for one, count in counts.items() if count]
    figure.legend(handles=named, loc="outside lower center", ncols=len(named), fontsize="small")
