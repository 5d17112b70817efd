"""Columns that hold something else than ratio and force."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Code, Problem, Repair, Severity, Span
from mudline.keywords.text import shown
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.context import MOST_REPORTED
from mudline.scene.force_curves import SceneCurve
from mudline.syntax.rows import line_spans, row_fields

CRV009 = Code("CRV009", "swapped-columns", Severity.WARNING)
CRV010 = Code("CRV010", "ratio-range", Severity.WARNING)

LARGEST_RATIO = 5.0
_LIKE_A_FORCE = 10.0
_LIKE_A_RATIO = 1.0


def swapped(curve: SceneCurve) -> bool:
    """Whether all points other than (0, 0) have a first number above 10 and a second one below 1."""
    points = curve.points[(curve.points != 0.0).any(axis=1)]
    return bool(points.size and (points[:, 0] > _LIKE_A_FORCE).all() and (points[:, 1] < _LIKE_A_RATIO).all())


@rule(CRV009)
def swapped_columns(context: LintContext) -> Iterator[Problem]:
    """The columns of a curve seem to be exchanged: forces stand where the ratios belong.

    A point is the embedment ratio, then the force. Ratios above 10 with forces below 1 make no sense together; tables
    of soil springs, such as those of *P-Y, have the force first, and were perhaps copied. With the columns exchanged
    the seabed has next to no stiffness. Exchange them.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Clay
          0.0, 0.0
        - 1200.0, 0.1
        - 4200.0, 0.5
        + 0.1, 1200.0
        + 0.5, 4200.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Clay

    Finds: 3:2
    """
    for _, curve in context.odd_curves:
        if swapped(curve):
            message = (
                f"force and ratio of curve {shown(curve.name)} seem to be exchanged, as every ratio is above "
                f"{_LIKE_A_FORCE:g} and every force below {_LIKE_A_RATIO:g}: write the ratio first"
            )
            repair = _exchange(context.text, curve) if context.text else None
            yield Problem(CRV009, message, where=curve.where, repair=repair)


def _exchange(text: TextOrigin, curve: SceneCurve) -> Repair | None:
    """Each row with its fields exchanged; None for a curve that could not be read whole, or is very long."""
    block = text.read.get((curve.where.section, curve.where.block))
    runs = block.places.runs.get((*curve.where.path, "points"), []) if block else []
    if not runs or len(curve.points) > MOST_REPORTED or not curve.whole:
        return None
    source = text.source.unified
    edits: list[tuple[Span, str]] = []
    for line in (line for _, run in runs for line in line_spans(source, run)):
        first, second = (field.span for field in row_fields(source, line, 2))
        turned = source[slice(*second)] + source[first.end : second.start] + source[slice(*first)]
        edits.append((Span(first.start, second.end), turned))
    return Repair("unsafe", "exchange the columns", tuple(edits))


@rule(CRV010)
def ratio_range(context: LintContext) -> Iterator[Problem]:
    """The largest ratio of a curve is above 5.

    The ratio is the depth of the centreline divided by the external diameter, and no pipe sinks five diameters into
    the seabed. Depths in millimetres or percentages of the diameter look like this, and give a seabed that is far too
    soft. Write ratios.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Clay
          0.0, 0.0
        - 10.0, 1200.0
        - 50.0, 4200.0
        + 0.10, 1200.0
        + 0.50, 4200.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Clay

    Finds: 6:2
    """
    for _, curve in context.odd_curves:
        if not len(curve.points) or swapped(curve):
            continue
        last = int(np.argmax(curve.points[:, 0]))
        ratio = float(curve.points[last, 0])
        if ratio > LARGEST_RATIO:
            message = (
                f"a ratio of {ratio!r} is as many diameters deep: if this is a depth or a percentage, write the "
                "depth divided by the external diameter"
            )
            yield Problem(CRV010, message, where=curve.point(last))
