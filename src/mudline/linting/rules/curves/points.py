"""Points that make no curve, or stand there for nothing."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.codes import CRV001, CRV003, CRV011
from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.curves.repairs import plain_rows, removal
from mudline.scene.context import MOST_TOLD
from mudline.scene.force_curves import clashes_and_repeats

CRV004 = Code("CRV004", "repeated-point", Severity.WARNING)


@rule(CRV001)
def too_few_points(context: LintContext) -> Iterator[Problem]:
    """A curve has fewer than two points.

    The slope of the curve is the stiffness of the seabed, and one point has no slope. The same point twice counts once.
    Give the curve a second point; a straight line through the origin is the constant stiffness of a STIFFNESS= number.

    Bad:
        $MODEL
        *SEABED STIFFNESS
         CURVE=Rock
         0.01, 25000.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Rock

    Good:
        $MODEL
        *SEABED STIFFNESS
         CURVE=Rock
         0.0, 0.0
         0.01, 25000.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Rock

    Finds: 3:2
    """
    yield from context.told(CRV001)


@rule(CRV003)
def duplicate_ratio(context: LintContext) -> Iterator[Problem]:
    """Two points of a curve have one embedment ratio and different forces.

    The curve would rise at once, with an infinite stiffness, and no solver can follow it. Often the ratios were rounded
    to too few digits. Give the points different ratios, or remove one.

    Bad:
        $MODEL
        *SEABED STIFFNESS
         CURVE=Sand
         0.00, 0.0
         0.05, 1800.0
         0.05, 2100.0
         0.20, 9000.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Sand

    Good:
        $MODEL
        *SEABED STIFFNESS
         CURVE=Sand
         0.00, 0.0
         0.048, 1800.0
         0.054, 2100.0
         0.20, 9000.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Sand

    Finds: 6:2
    """
    yield from context.told(CRV003)


@rule(CRV004)
def repeated_point(context: LintContext) -> Iterator[Problem]:
    """The same point stands in a curve twice.

    It counts once, so nothing is wrong yet; but when one of the two is changed later, the curve has two forces at one
    ratio. Remove it.

    Bad:
        $MODEL
        *SEABED STIFFNESS
         CURVE=Sand
         0.00, 0.0
         0.05, 1800.0
         0.05, 1800.0
         0.20, 9000.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Sand

    Good:
        $MODEL
        *SEABED STIFFNESS
         CURVE=Sand
         0.00, 0.0
         0.05, 1800.0
         0.20, 9000.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Sand

    Finds: 6:2
    """
    for _, curve in context.odd_curves:
        repeats = clashes_and_repeats(curve.points)[1][:MOST_TOLD].tolist()
        rows = plain_rows(context.text, curve) if context.text and repeats else None
        for index in repeats:
            ratio, force = curve.points[index].tolist()
            message = f"the point ({ratio!r}, {force!r}) stands here a second time: it counts once; remove it"
            repair = removal(rows, int(curve.rows[index])) if rows else None
            yield Problem(CRV004, message, where=curve.point(index), repair=repair)


@rule(CRV011)
def slope_overflow(context: LintContext) -> Iterator[Problem]:
    """The distance or the slope between two points cannot be held by a floating-point number.

    Numbers reach to 1.8E308 and down to 2.2E-308. Beyond them a slope would become infinite or lose its digits, and
    with it the stiffness. An exponent has a digit too many, as a rule: correct the point.

    Bad:
        $MODEL
        *SEABED STIFFNESS
         CURVE=Clay
         0.0, 0.0
         0.0001, 1.2E305
         0.1, 1.4E305
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Clay

    Good:
        $MODEL
        *SEABED STIFFNESS
         CURVE=Clay
         0.0, 0.0
         0.0001, 1.2E3
         0.1, 1.4E3
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Clay

    Finds: 5:2
    """
    yield from context.told(CRV011)
