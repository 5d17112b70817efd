"""Decks by chance: curves and linear laws of numbers of any size, always the same ones."""

from __future__ import annotations

import random

from mudline.study.stability.ladder.cells import Cell
from mudline.study.stability.ladder.decks import curve_deck, linear_deck
from mudline.study.stability.ladder.exact import ExactCurve, ExactLinear

_SEED = 20040503


def chance_cells(count: int) -> list[Cell]:
    """So many cells, one linear law to every three curves."""
    rng = random.Random(_SEED)  # noqa: S311 - nothing secret about it
    return [_cell(rng, index) for index in range(count)]


def _cell(rng: random.Random, index: int) -> Cell:
    diameter = _number(rng, -6, 3)
    value = str(index + 1)
    if index % 4 == 0:
        stiffness = _number(rng, -320, 308)
        return Cell(
            "by chance", value, linear_deck(stiffness, diameter), ExactLinear(float(stiffness), float(diameter))
        )
    far = rng.choice((1, 9, 100, 308))
    rows = [(_signed(rng, far), _signed(rng, far)) for _ in range(rng.randint(2, 6))]
    points = [(float(ratio), float(force)) for ratio, force in rows]
    usable = len({ratio for ratio, _ in points}) == len(points)
    law = ExactCurve(points, float(diameter)) if usable else None
    return Cell("by chance", value, curve_deck(rows, diameter), law)


def _signed(rng: random.Random, far: int) -> str:
    return rng.choice(("", "", "", "-")) + _number(rng, -far, far)


def _number(rng: random.Random, low: int, high: int) -> str:
    return f"{rng.uniform(1.0, 9.999):.{rng.choice((0, 3, 16))}f}E{rng.randint(low, high - 1)}"
