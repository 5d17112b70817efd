"""What sets the rows of a curve right: their order, and a row too many."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain

import numpy as np

from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Repair, Span
from mudline.scene.context import MOST_REPORTED
from mudline.scene.force_curves import SceneCurve
from mudline.scene.numbering import Indices
from mudline.syntax.rows import line_spans

_NO_PLAIN_NUMBERS = frozenset('["{')


@dataclass(frozen=True, slots=True)
class PlainRows:
    """The lines of a table, without blanks and line ends behind them; `before` is what its curve has above them."""

    source: str
    lines: list[Span]
    before: str

    def parted_by(self, order: Indices) -> bool:
        """Whether a comment stands before or behind a row that the order puts elsewhere, or that others pass."""
        settled = np.maximum.accumulate(order) == np.arange(len(order))  # up to here the rows stay among themselves
        stays = order == np.arange(len(order))
        if "mudline" in self.before.lower() and not stays[0]:  # a comment that speaks of the first row alone
            return True
        for place in range(len(order) - 1):
            between = self.source[self.lines[place].end : self.lines[place + 1].start]
            if between.strip() and not (settled[place] and stays[place] and stays[place + 1]):
                return True
        return False


def plain_rows(text: TextOrigin, curve: SceneCurve) -> PlainRows | None:
    """The rows of a curve; None where they are very many or have equations, which other parameters would change."""
    block = text.read.get((curve.where.section, curve.where.block))
    if block is None or len(curve.points) > MOST_REPORTED:
        return None
    source = text.source.unified
    runs = block.places.runs.get((*curve.where.path, "points"), [])
    lines = [
        Span(line.start, line.start + len(source[slice(*line)].rstrip()))
        for line in chain.from_iterable(line_spans(source, run) for _, run in runs)
    ]
    if not lines or any(not _NO_PLAIN_NUMBERS.isdisjoint(source[slice(*line)]) for line in lines):
        return None
    opening = block.places.find(curve.where.path).start
    if opening >= lines[0].start:  # rows of *EMBEDMENT that stand under no SET=
        opening = block.places.block.start
    return PlainRows(source, lines, source[opening : lines[0].start])


def sorting(text: TextOrigin, curve: SceneCurve) -> Repair | None:
    """The rows in the order of their ratios.

    None for a curve that could not be read whole, is very long or has equations, and where a comment would come to
    stand beside another row than now.
    """
    if not curve.whole or (rows := plain_rows(text, curve)) is None or len(rows.lines) != len(curve.points):
        return None
    order = np.argsort(curve.points[:, 0], kind="stable")
    if rows.parted_by(order):
        return None
    edits = [
        (rows.lines[place], rows.source[slice(*rows.lines[row])])
        for place, row in enumerate(order.tolist())
        if place != row
    ]
    return Repair("safe", "put the points in order", tuple(edits)) if edits else None


def removal(rows: PlainRows, row: int) -> Repair:
    """A row less."""
    line = rows.lines[row]
    following = rows.source.find("\n", line.end)
    end = len(rows.source) if following < 0 else following + 1
    return Repair("safe", "remove the point", ((Span(line.start, end), ""),))
