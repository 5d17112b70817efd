"""The ladder of extremes: small decks with the largest and smallest numbers, against exact arithmetic.

Every deck is text, and goes through the whole program: read, resolved, evaluated. A result is right, within a stated
bound, or it is refused with a diagnostic that names a line of the deck; nothing else is accepted. There is a family of
cells for each number that is set to extreme values. The section of the page about it is made here too.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mudline.scene.model import Scene
from mudline.short_repr import cut
from mudline.study.exact import BOUND
from mudline.study.pages import Record, Tables, filled, grouped_digits, listed, markdown_table, rounded
from mudline.study.pictures import Picture, drawn
from mudline.study.report import Layout, Section, StudyOptions, columns_of, grouped
from mudline.study.stability.families import RANDOM, all_cells, judge, random_cells
from mudline.study.stability.judging import Judgement, Verdict
from mudline.study.stability.own_laws import is_own, own_cells
from mudline.study.stability.paths import TILTED_BOUND
from mudline.study.stability.pull_out import SUCTION_BOUND, suction_cells

if TYPE_CHECKING:  # only drawing needs matplotlib
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
    """Draw the first `half` families in a column, the rest in a second one."""
    from matplotlib.patches import Patch  # noqa: PLC0415 - only drawing needs it

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
    figure.suptitle("Verdicts on decks with the number in the cell; 9(4) stands for four nines", fontsize="large")


def _draw_column(axes: Axes, families: Mapping[str, Sequence[Judgement]], rows: int) -> None:
    from matplotlib.patches import Rectangle  # noqa: PLC0415 - only drawing needs it

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
    """The value of a cell, shortened: 9(14) stands for fourteen nines."""
    text = _NINES.sub(lambda found: f"9({len(found[0])})", value)
    return text.replace("1.7976931348623157E308", "1.8E308")


# ----------------------------------------------------------------------------------------------------------------- page

_CODE = re.compile(r"line \d+: ([A-Z]{3}\d{3})")
_FOR = {
    0.0: "decks that are all refused",
    BOUND: "laws, along the axes",
    TILTED_BOUND: "directions that are no axes: slopes, angles, the ellipse",
    SUCTION_BOUND: "powers in the suction",
}
"""What each bound is for."""
_ERROR, _BOUND = "largest error [2^-53]", "bound [2^-53]"


def ladder_part(tables: Tables) -> str:
    """The text, with its heading; raises MissingTableError."""
    every = tables.rows("ladder")
    fixed = [row for row in every if not is_own(row.text("family")) and row.text("family") != RANDOM]
    own = [row for row in every if is_own(row.text("family"))]
    return filled(
        Path(__file__).with_name("ladder.md"),
        {
            "cells": _sum(fixed, "cells"),
            "families": str(len(fixed)),
            "numbers": _sum(every, "numbers compared"),
            "verdict": _verdict(tables, every),
            "right": _sum(fixed, "right"),
            "beyond": _sum(fixed, "refused beyond"),
            "refused": _sum(fixed, "refused"),
            "codes": listed(f"`{code}`" for code in _codes(tables)),
            "bounds": _bounds(every),
            "own": _own(own),
            "random": _random(every),
        },
    )


def _sum(rows: Sequence[Record], heading: str) -> str:
    return grouped_digits(sum(row.number(heading) for row in rows))


def _verdict(tables: Tables, rows: Sequence[Record]) -> str:
    wrong = sum(row.number("anything else") for row in rows)
    if not wrong:
        return "All decks are right within their bound, or refused with a line; nothing in between was found."
    accepted = {verdict.value for verdict in Verdict if verdict.acceptable}
    bad = [one for one in tables.rows("ladder-cells") if one.text("verdict") not in accepted]
    names = listed(f"{one.text('family')} {one.text('value')}" for one in bad)
    return f"**{grouped_digits(wrong)} decks are neither right nor refused with a line: {names}.**"


def _codes(tables: Tables) -> list[str]:
    """The codes of the refusals on the ladder."""
    found = (_CODE.match(one.text("told")) for one in tables.rows("ladder-cells", verdict=Verdict.REFUSED.value))
    return sorted({match[1] for match in found if match})


def _bounds(rows: Sequence[Record]) -> str:
    """The bounds, and the largest errors found."""
    lines = []
    for bound in sorted({row.number(_BOUND) for row in rows}):
        # of random decks each has its own bound
        held = [row for row in rows if row.number(_BOUND) == bound and row.text("family") != RANDOM]
        if held:
            worst = max(held, key=lambda row: row.number(_ERROR))
            families, error = str(len(held)), rounded(worst.number(_ERROR))
            lines.append((rounded(bound), _FOR[bound], families, error, worst.text("family")))
    return markdown_table(("bound", "for", "families", "largest error", "in"), lines)


def _own(rows: Sequence[Record]) -> str:
    if not rows:
        return "The deck has no law that can be scaled."
    lines = [
        (
            row.text("family"),
            *(_sum([row], heading) for heading in ("cells", "right", "refused beyond", "refused", "anything else")),
            rounded(row.number(_ERROR)),
            rounded(row.number(_BOUND)),
        )
        for row in rows
    ]
    headings = ("numbers", "decks", "right", "refused beyond", "refused", "anything else", "largest error", "bound")
    return (
        "The same with the numbers of the deck that was studied: of each of its contacts all forces, all depths, the "
        "diameter, the length of\nthe element, the coefficients of friction and the suction are multiplied by powers "
        "of ten.\n\n![Verdicts on the laws of the deck](stability-ladder-deck.png)\n\n"
        + markdown_table(headings, lines)
    )


def _random(rows: Sequence[Record]) -> str:
    found = [row for row in rows if row.text("family") == RANDOM]
    if not found:
        decks = grouped_digits(RANDOM_DECKS)
        return f"`--full` adds {decks} random decks that combine all of these, with numbers of any size."
    right, beyond, refused = (_sum(found, heading) for heading in ("right", "refused beyond", "refused"))
    return (
        f"Of {_sum(found, 'cells')} random decks that combine all of these, with numbers of any size, {right} are "
        f"right, {beyond} right\nwith a refusal beyond, {refused} refused."
    )
