"""A ladder of extremes: small decks with numbers at the ends of what numbers can be, against exact arithmetic.

Every deck is text, and goes through the whole program: read, resolved, evaluated. A result is right, within a stated
bound, or it is refused with a diagnostic that names a line of the deck; nothing else is accepted. There is a family of
cells for each thing that is taken to its ends.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from mudline.scene.model import Scene
from mudline.short_repr import cut
from mudline.study.pictures import Picture, drawn
from mudline.study.report import Layout, Section, StudyOptions, columns_of, grouped
from mudline.study.stability.families import all_cells, judge, random_cells
from mudline.study.stability.judging import Judgement, Verdict
from mudline.study.stability.own_laws import is_own, own_cells
from mudline.study.stability.pull_out import suction_cells

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


RANDOM_DECKS = 4000
"""Random decks in a full run."""
_MOST_ROWS = 32
"""Families of a picture in one column."""
_LABEL_WIDTH = 4.0
_LONG, _LONGEST_NAME = 7, 44
_NINES = re.compile("9{4,}")
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
    judgements = [judge(cell) for cell in options.each(cells, lambda cell: f"ladder of extremes, {cell.family}")]
    pictures = _pictures(judgements)
    if options.full:
        decks = random_cells(RANDOM_DECKS)
        judgements += (judge(cell) for cell in options.each(decks, lambda _: f"{RANDOM_DECKS} random decks"))
    tables = BY_FAMILY.table(grouped(judgements, lambda one: one.family).values()), BY_CELL.table(judgements)
    rejected = [one for one in judgements if not one.verdict.acceptable]
    right = len(judgements) - len(rejected)
    summary = (
        f"{right} of {len(judgements)} cells of the ladder of extremes are right within their bound or refused with a "
        "line of the deck."
    )
    notes = [summary, *(f"{one.family} {one.value}: {one.verdict.value}: {one.message}" for one in rejected)]
    return Section(tables, pictures, notes, omissions)


def _pictures(judgements: Sequence[Judgement]) -> list[Picture]:
    """A square for each cell, in a row for each family; those on the deck's own laws in a picture of their own."""
    families = grouped(judgements, lambda one: one.family)
    found = []
    for name, own in (("ladder", False), ("ladder-deck", True)):
        shown = {family: part for family, part in families.items() if is_own(family) is own}
        if shown:
            of = "on the laws of the deck" if own else "of extremes"
            half = -(-len(shown) // 2) if len(shown) > _MOST_ROWS else len(shown)
            size = (18.0 if half < len(shown) else 12.0, 1.4 + 0.29 * half)
            caption = f"Verdict on each cell of the ladder {of}."
            found.append(Picture(name, caption, partial(_draw, shown, half), size))
    return found


def _draw(families: Mapping[str, Sequence[Judgement]], half: int, figure: Figure) -> None:
    """Draw so many families in a column, the rest in a second one."""
    from matplotlib.patches import Patch  # noqa: PLC0415 - only who draws loads it

    names = list(families)
    columns = [names[:half], names[half:]] if half < len(names) else [names]
    widths = [max(len(families[name]) for name in column) + _LABEL_WIDTH for column in columns]
    for axes, column in zip(
        figure.subplots(1, len(columns), squeeze=False, width_ratios=widths).flat, columns, strict=True
    ):
        _draw_column(axes, {name: families[name] for name in column}, half)
    counts = {verdict: sum(_count(part, verdict) for part in families.values()) for verdict in Verdict}
    named = [Patch(facecolor=_COLORS[one], label=f"{one.value}: {count}") for one, count in counts.items() if count]
    figure.legend(handles=named, loc="outside lower center", ncols=len(named), fontsize="medium")
    figure.suptitle("What comes out of decks with the number in the cell; 9(4) are four nines", fontsize="large")


def _draw_column(axes: Axes, families: Mapping[str, Sequence[Judgement]], rows: int) -> None:
    from matplotlib.patches import Rectangle  # noqa: PLC0415 - only who draws loads it

    for row, judgements in enumerate(families.values()):
        for column, one in enumerate(judgements):
            square = Rectangle((column, row), 1, 1, facecolor=_COLORS[one.verdict], edgecolor="white", linewidth=1.5)
            axes.add_patch(square)
            text = drawn(_short(one.value))
            size = 7.0 if len(text) <= _LONG else 7.0 * _LONG / len(text)
            axes.text(column + 0.5, row + 0.5, text, ha="center", va="center", fontsize=size)
    axes.set_xlim(0, max(map(len, families.values())))
    axes.set_ylim(rows, 0)
    axes.set_yticks(np.arange(len(families)) + 0.5, [drawn(cut(name, _LONGEST_NAME)) for name in families])
    axes.set_xticks([])
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _short(value: str) -> str:
    """The value of a cell so that it fits: 9(14) are fourteen nines."""
    text = _NINES.sub(lambda found: f"9({len(found[0])})", value)
    return text.replace("1.7976931348623157E308", "1.8E308")
