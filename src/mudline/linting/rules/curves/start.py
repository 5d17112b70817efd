"""Where contact begins, and where the seabed would pull."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.curves import ForceCurve, QueryError
from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule

CRV007 = Code("CRV007", "force-at-zero", Severity.WARNING)
CRV012 = Code("CRV012", "curve-pulls", Severity.WARNING)

_SMALL = 0.01
"""Part of the largest force of a curve that counts as none."""


def _at_zero(curve: ForceCurve) -> float:
    """The force at ratio 0; 0 where it is small beside the largest force of the curve, or overflows."""
    try:
        force = float(curve.evaluate(np.zeros(1))[0][0])
    except QueryError:
        return 0.0
    return force if abs(force) > _SMALL * float(np.abs(curve.forces).max()) else 0.0


@rule(CRV007)
def force_at_zero(context: LintContext) -> Iterator[Problem]:
    """The force at ratio 0 is not 0.

    Contact begins at ratio 0, when the centreline reaches the mudline. With a force there, the seabed pushes with all
    of it at once as soon as the pipe touches, and lets go at once when it rises: the solver sees a jump and finds no
    equilibrium near it. Below its first point a curve goes on with its first slope, so a curve without the point (0, 0)
    may have such a force too. More than a hundredth of the largest force of the curve is told. Add the point 0, 0.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Clay
        + 0.00, 0.0
          0.05, 800.0
          0.10, 1200.0
          0.50, 4200.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Clay

    Finds: 3:2
    """
    for _, entry in context.odd_curves:
        curve = entry.curve
        if curve is None or not entry.whole or not (force := _at_zero(curve)):
            continue
        given = np.flatnonzero(entry.points[:, 0] == 0.0)
        if given.size:
            message = f"the force at ratio 0 is {force:.6g}: contact begins with a jump; give it the force 0"
            yield Problem(CRV007, message, where=entry.point(int(given[0])))
            continue
        slope = "between the points beside it" if curve.ratios[0] < 0.0 else "with the slope of the first two points"
        advice = "correct the points about 0" if curve.ratios[0] < 0.0 else "add the point 0, 0"
        message = f"the force at ratio 0 is {force:.6g} ({slope}): contact begins with a jump; {advice}"
        yield Problem(CRV007, message, where=entry.where)


@rule(CRV012)
def curve_pulls(context: LintContext) -> Iterator[Problem]:
    """The force of a curve is negative at a ratio above 0.

    A pipe that has sunk would be pulled down by the seabed. A slip in a sign does this, and so does a curve that goes
    on falling behind its last point, or one whose first slope is so steep that it crosses 0 too late. Suction belongs
    into *SEABED SUCTION or SUCTION=, where it acts on a pipe that rises. Correct the force.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Clay
          0.0, 0.0
        - 0.1, -1200.0
        + 0.1, 1200.0
          0.5, 4200.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Clay

    Finds: 5:2
    """
    for _, entry in context.odd_curves:
        negative = np.flatnonzero((entry.points[:, 0] > 0.0) & (entry.points[:, 1] < 0.0))
        if negative.size:
            ratio, force = entry.points[negative[0]].tolist()
            more = f" (as at {negative.size - 1} more of its points)" if negative.size > 1 else ""
            message = f"the force at ratio {ratio!r} is {force!r}{more}: the seabed pulls the pipe down; correct it"
            yield Problem(CRV012, message, where=entry.point(int(negative[0])))
        elif entry.curve is not None and entry.whole:
            if (force := _at_zero(entry.curve)) < 0.0:
                message = f"the force just above ratio 0 is {force:.6g}: the seabed pulls the pipe down; correct it"
                yield Problem(CRV012, message, where=entry.where)
            if entry.curve.slopes[-1] < 0.0:
                last = int(np.argmax(entry.points[:, 0]))
                message = (
                    "the force goes on falling behind the last point, and the seabed pulls the pipe down in the end: "
                    "add a point with a force that does not fall"
                )
                yield Problem(CRV012, message, where=entry.point(last))
