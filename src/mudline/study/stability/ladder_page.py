"""The part of the page on stability that is about the ladder of extremes, from its tables."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from mudline.study.exact import BOUND
from mudline.study.pages import Record, Tables, filled, grouped_digits, listed, markdown_table, rounded
from mudline.study.stability.families import RANDOM
from mudline.study.stability.judging import Verdict
from mudline.study.stability.ladder import RANDOM_DECKS
from mudline.study.stability.own_laws import is_own
from mudline.study.stability.paths import TILTED_BOUND
from mudline.study.stability.pull_out import SUCTION_BOUND

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
    """What is allowed, and how much of it is taken up."""
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
        return "The deck has no law that could be scaled."
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
