"""Points that make no curve, or stand there for nothing."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.curves.repairs import plain_rows, removal
from mudline.scene.context import MOST_REPORTED
from mudline.scene.force_curves import clashes_and_repeats

CRV004 = Code("CRV004", "repeated-point", Severity.WARNING)


@rule(CRV004)
def repeated_point(context: LintContext) -> Iterator[Problem]:
    """The same point stands in a curve twice.

    It counts once, so nothing is wrong yet; but when one of the two is changed later, the curve has two forces at one
    ratio. Remove it.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Sand
          0.00, 0.0
        - 0.05, 1800.0
          0.05, 1800.0
          0.20, 9000.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Sand

    Finds: 6:2
    """
    for _, curve in context.odd_curves:
        repeats = clashes_and_repeats(curve.points)[1][:MOST_REPORTED].tolist()
        rows = plain_rows(context.text, curve) if context.text and repeats else None
        for index in repeats:
            ratio, force = curve.points[index].tolist()
            message = f"the point ({ratio!r}, {force!r}) stands here a second time: it counts once; remove it"
            repair = removal(rows, int(curve.rows[index])) if rows else None
            yield Problem(CRV004, message, where=curve.point(index), repair=repair)
