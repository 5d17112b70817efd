"""Soil springs: the depths of their curves, and the resistance along each curve."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mudline.checks.context import LintContext
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.table import Table
from mudline.language.rules import rule
from mudline.model.scene.deck_values import number

CRV015 = Code("CRV015", "repeated-depth", Severity.WARNING)
CRV016 = Code("CRV016", "soil-gains-again", Severity.INFO)


@rule(CRV015)
def repeated_depth(context: LintContext) -> Iterator[Problem]:
    """A soil spring has two curves at one depth, or a depth above the one before it.

    The resistance is interpolated between the given depths: at a depth that is given twice it jumps, or one of its
        curves is not used at all. Mostly the second curve was copied and kept the depth of the first. Depths that do
        not ascend are an info, as nothing says that they must. Correct the depth.

    Example on pipe:
          STIFFNESS=50000.0
        |*P-Y
        | SET=ALL
        | DEPTH=0.0
        | 0.0, 0.0
        | 2000.0, 0.05
        - DEPTH=0.0
        + DEPTH=5.0
        | 0.0, 0.0
        | 20000.0, 0.05

    Finds: 22:8
    """
    for place, curves in _springs(context):
        before: list[float] = []
        for at, curve in enumerate(curves):
            depth = number(curve, "depth", math.inf)  # one that is not known is deeper than all others
            where = place.inside(at, "depth")
            if depth in before and depth < math.inf:
                yield Problem(CRV015, f"there is already a curve at depth {depth:g}: correct one", where=where)
            elif before and depth < max(before):
                message = f"depth {depth:g} follows {max(before):g}: write the curves from the mudline downwards"
                yield Problem(CRV015, message, where=where, severity=Severity.INFO)
            before.append(depth)


@rule(CRV016)
def soil_gains_again(context: LintContext) -> Iterator[Problem]:
    """The resistance of a soil spring falls, and rises again at larger displacements.

    Softening soil falls to a residual resistance and stays there; it does not regain strength at larger displacements.
    A curve that rises again mostly has a wrong digit in one point, or two points exchanged. Correct it, or leave it if
    it was measured so. Each side of a curve is checked by itself.

    Example on pipe:
          STIFFNESS=50000.0
        |*P-Y
        | SET=ALL
        | DEPTH=5.0
        | 0.0, 0.0
        | 9000.0, 0.01
        - 1500.0, 0.05
        + 15000.0, 0.05
        | 18000.0, 0.2

    Finds: 22:2
    """
    for place, curves in _springs(context):
        for at, curve in enumerate(curves):
            if isinstance(curve.points, Table) and (lowest := _gains_again(curve.points)) is not None:
                resistance, displacement = (float(curve.points.column(each)[lowest]) for each in (0, 1))
                message = (
                    f"resistance falls to {resistance:g} at {displacement:g} and rises again farther out, as no soil "
                    "does that has softened: correct a point, or leave it if it was measured"
                )
                yield Problem(CRV016, message, where=place.inside(at, "points", lowest))


def _springs(context: LintContext) -> Iterator[tuple[Where, list[Any]]]:
    """Yield the place and the curves of each set of soil springs."""
    for where, block in context.scene.deck.blocks_with("soil_springs"):
        for index, entry in enumerate(block.sets):
            yield where.inside("sets", index, "curves"), entry.curves


def _gains_again(points: Table) -> int | None:
    """Return the row to which resistance falls before it rises again, on either side of a curve; None without one."""
    resistance, displacement = points.column(0), points.column(1)
    for side in (1.0, -1.0):
        rows = np.flatnonzero((side * displacement >= 0.0) & np.isfinite(resistance))
        rows = rows[np.argsort(np.abs(displacement[rows]), kind="stable")]
        steps = np.diff(np.abs(resistance[rows]))
        falls = np.flatnonzero(steps < 0.0)
        rises = np.flatnonzero(steps > 0.0)
        if falls.size and rises.size and rises[-1] > falls[0]:
            again = rises[rises > falls[0]][0]
            return int(rows[again])
    return None
