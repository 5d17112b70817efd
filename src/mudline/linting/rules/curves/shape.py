"""What a curve does between its points."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.curves.repairs import sorting
from mudline.scene.context import MOST_REPORTED
from mudline.scene.force_curves import SceneCurve, clashes_and_repeats
from mudline.scene.model import Scene
from mudline.scene.numbering import Floats, Indices

CRV002 = Code("CRV002", "unsorted-points", Severity.INFO)
CRV005 = Code("CRV005", "decreasing-force", Severity.WARNING)
CRV006 = Code("CRV006", "negative-ratio", Severity.WARNING)


@rule(CRV002)
def unsorted_points(context: LintContext) -> Iterator[Problem]:
    """The points of a curve are not in the order of their ratios.

    This is legal: they are sorted before anything else. A reader of the deck sees another curve than the one that
    holds, though, and a point out of order is sometimes a slip in its ratio. Put the points in order.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Sand
          0.00, 0.0
        + 0.05, 1800.0
          0.20, 9000.0
        - 0.05, 1800.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Sand

    Finds: 6:2
    """
    for _, curve in context.odd_curves:
        ratios = curve.points[:, 0]
        for index in (np.flatnonzero(ratios[1:] < ratios[:-1])[:1] + 1).tolist():
            before, ratio = ratios[index - 1 : index + 1].tolist()
            message = f"ratio {ratio!r} comes after {before!r}: legal, the points are sorted; put them in order"
            repair = sorting(context.text, curve) if context.text else None
            yield Problem(CRV002, message, where=curve.point(index), repair=repair)


@rule(CRV005)
def decreasing_force(context: LintContext) -> Iterator[Problem]:
    """The force falls while the pipe sinks deeper.

    The stiffness of the seabed is negative there: the bed does not hold the pipe but lets it snap through, unless the
    pipe itself holds against it. Equilibrium needs a structural stiffness above |slope| / D for each unit of length,
    D being the external diameter. Softening soil is real, but a static run rarely converges on it; give the curve a
    force that does not fall, or keep this one knowingly.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Crust
          0.00, 0.0
        - 0.10, 3000.0
        + 0.10, 2400.0
          0.20, 2400.0
          0.50, 5000.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Crust

    Finds: 6:2
    """
    for number, curve in context.odd_curves:
        order = _distinct(curve)
        ratios, forces = curve.points[order].T
        falling = np.flatnonzero((forces[1:] < forces[:-1]) & (ratios[1:] > 0.0))[:MOST_REPORTED]
        for segment in falling.tolist():
            first, last = ratios[segment : segment + 2].tolist()
            with np.errstate(over="ignore"):
                fall = forces[segment] - forces[segment + 1]
                slope = -float(fall / (ratios[segment + 1] - ratios[segment]))
            if np.isfinite(slope):
                message = (
                    f"force falls between ratio {first!r} and {last!r}, slope {slope:.6g}: equilibrium needs a "
                    f"structural stiffness per unit length above {_needed(context.scene, number, slope)}"
                )
                yield Problem(CRV005, message, where=curve.point(int(order[segment + 1])))


def _distinct(curve: SceneCurve) -> Indices:
    """Indices of the points in the order of their ratios, one for each ratio."""
    clashing, repeated = clashes_and_repeats(curve.points)
    order = np.argsort(curve.points[:, 0], kind="stable")
    return order[~np.isin(order, np.concatenate([clashing, repeated]))]


def _needed(scene: Scene, curve: int, slope: float) -> str:
    """|slope| / D, for the smallest diameter on the curve."""
    diameters = scene.diameter[scene.laws.followers(curve)]
    known = diameters[~np.isnan(diameters)]
    if not known.size:
        return f"|slope| / D = {-slope:.6g} / D"
    smallest, largest = float(known.min()), float(known.max())
    which = f"D = {smallest:g}" if smallest == largest else f"the smallest D = {smallest:g}"
    with np.errstate(over="ignore"):
        return f"|slope| / D = {float(np.float64(-slope) / smallest):.6g} ({which})"


@rule(CRV006)
def negative_ratio(context: LintContext) -> Iterator[Problem]:
    """A point of a curve lies above the mudline.

    The embedment ratio is measured at the centreline of the pipe, and contact begins where it is positive: evaluation
    never reaches such a point. A curve drawn for the invert, which touches the bed half a diameter earlier, begins at
    -0.5; its part above 0 is lost, and the force jumps when contact begins. Remove the point, or draw the curve for the
    centreline. A curve that has the force 0 up to ratio 0 loses nothing, and is not told.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Clay
        - -0.5, 0.0
        - 0.0, 2100.0
        + 0.0, 0.0
        + 0.1, 900.0
          0.5, 4800.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Clay

    Finds: 4:2
    """
    for _, curve in context.odd_curves:
        if _free_above(curve.points):
            continue
        for index in np.flatnonzero(curve.points[:, 0] < 0.0)[:MOST_REPORTED].tolist():
            ratio = float(curve.points[index, 0])
            drawn = " (a curve drawn for the invert starts at -0.5)" if ratio == -0.5 else ""
            message = f"ratio {ratio!r} lies above the mudline, and contact begins at 0: remove or correct it{drawn}"
            yield Problem(CRV006, message, where=curve.point(index))


def _free_above(points: Floats) -> bool:
    """Whether a curve says no more of the part above the mudline than that there is no force, up to a point at 0."""
    above = points[points[:, 0] <= 0.0]
    return bool((above[:, 0] == 0.0).any() and (above[:, 1] == 0.0).all())
