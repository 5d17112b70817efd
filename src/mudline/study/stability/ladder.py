"""A ladder of extremes: small decks with numbers at the ends of what numbers can be, against exact arithmetic.

Every deck is text, and goes through the whole program: read, resolved, evaluated. A result is right, within a stated
bound, or it is refused with a diagnostic that names a line of the deck; nothing else is accepted. There is a family of
cells for each thing that is taken to its ends.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from mudline.scene.model import Scene
from mudline.study.pictures import Picture
from mudline.study.report import Layout, Section, StudyOptions, columns_of, grouped
from mudline.study.stability.families import all_cells, judged, random_cells
from mudline.study.stability.judging import Judgement, Verdict
from mudline.study.stability.own_laws import own_cells
from mudline.study.stability.pull_out import suction_cells

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.figure import Figure


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


def study_ladder(scene: Scene, options: StudyOptions) -> Section:
    """The verdict on every cell, those on the deck's own laws included; in a full run on random decks too."""
    own, omissions = own_cells(scene)
    cells = [*all_cells(), *suction_cells(), *own]
    judgements = [judged(cell) for cell in options.each(cells, lambda cell: f"ladder of extremes, {cell.family}")]
    picture = _picture(grouped(judgements, lambda one: one.family))
    if options.full:
        decks = random_cells(RANDOM_DECKS)
        judgements += (judged(cell) for cell in options.each(decks, lambda _: f"{RANDOM_DECKS} random decks"))
    tables = BY_FAMILY.table(grouped(judgements, lambda one: one.family).values()), BY_CELL.table(judgements)
    rejected = [one for one in judgements if not one.verdict.acceptable]
    right = len(judgements) - len(rejected)
    summary = (
        f"{right} of {len(judgements)} cells of the ladder of extremes are right within their bound or refused with a "
        "line of the deck."
    )
    notes = [summary, *(f"{one.family} {one.value}: {one.verdict.value}: {one.message}" for one in rejected)]
    return Section(tables, [picture], notes, omissions)


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
