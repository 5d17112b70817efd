"""Points of force-embedment curves: columns, order, repeated points, falling forces, and forces at both ends."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, filterfalse

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.checks.context import Found, Joined, LintContext, joint
from mudline.checks.rules.curve_text import _exchange, plain_rows, removal, sorting
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.text import shown
from mudline.language.rules import rule
from mudline.model.curves import ForceCurve
from mudline.model.scene.curves import SceneCurve, clashes_and_repeats
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Indices

CRV002 = Code("CRV002", "unsorted-points", Severity.INFO)
CRV004 = Code("CRV004", "repeated-point", Severity.WARNING)
CRV005 = Code("CRV005", "decreasing-force", Severity.WARNING)
CRV006 = Code("CRV006", "negative-ratio", Severity.WARNING)
CRV007 = Code("CRV007", "force-at-zero", Severity.WARNING)
CRV008 = Code("CRV008", "steep-extrapolation", Severity.WARNING)
CRV009 = Code("CRV009", "swapped-columns", Severity.WARNING)
CRV010 = Code("CRV010", "ratio-range", Severity.WARNING)
CRV012 = Code("CRV012", "curve-pulls", Severity.WARNING)
CRV013 = Code("CRV013", "flat-last-segment", Severity.WARNING)

LARGEST_RATIO = 5.0
"""Largest embedment ratio in diameters; a larger one is a length or a percentage."""
_LIKE_A_FORCE = 10.0
_LIKE_A_RATIO = 2.0
STEEPEST = 100.0
"""Ratio of the last two slopes of a curve."""
_SMALL = 0.01
"""Share of the largest force of a curve below which a force counts as none."""


def swapped(curve: SceneCurve) -> bool:
    """Return True if all points except (0, 0) have a first number above 10 and a second number below 2."""
    ratios, forces = curve.points.T
    exchanged = (ratios > _LIKE_A_FORCE) & (forces < _LIKE_A_RATIO)
    return bool(exchanged.any() and (exchanged | ((ratios == 0.0) & (forces == 0.0))).all())


@rule(CRV009)
def swapped_columns(context: LintContext) -> Iterator[Problem]:
    """The columns of a curve seem to be exchanged: forces are where the ratios belong.

    A point is the embedment ratio, then the force. Ratios above 10 with forces below 2 make no sense together; tables
    of soil springs, such as those of *P-Y, have the force first, and were perhaps copied. With the columns exchanged
    the seabed has next to no stiffness. Exchange them.

    Example on clay:
        - 1200.0, 0.1
        - 4200.0, 0.5
        + 0.1, 1200.0
        + 0.5, 4200.0

    Finds: 3:2
    """
    for curve in context.scene.laws.curves:
        if swapped(curve):
            message = (
                f"force and ratio of curve {shown(curve.name)} seem to be exchanged, as every ratio is above "
                f"{_LIKE_A_FORCE:g} and every force below {_LIKE_A_RATIO:g}: write the ratio first"
            )
            repair = _exchange(context.text, curve) if context.text else None
            yield Problem(CRV009, message, where=curve.where, repair=repair)


@rule(CRV010)
def ratio_range(context: LintContext) -> Iterator[Problem]:
    """The largest ratio of a curve is above 5.

    The ratio is the depth of the centreline divided by the external diameter, and no pipe sinks five diameters into
    the seabed. Depths in millimetres or percentages of the diameter look like this, and give a seabed that is far too
    soft. Write ratios.

    Example on clay:
        - 10.0, 1200.0
        - 50.0, 4200.0
        + 0.1, 1200.0
        + 0.5, 4200.0

    Finds: 6:2
    """
    for curve in context.scene.laws.curves:
        if not len(curve.points) or swapped(curve):
            continue
        last = int(np.argmax(curve.points[:, 0]))
        ratio = float(curve.points[last, 0])
        if ratio > LARGEST_RATIO:
            message = (
                f"ratio {ratio!r} means a depth of as many diameters: if this is a depth or a percentage, write the "
                "depth divided by the external diameter"
            )
            yield Problem(CRV010, message, where=curve.point(last))


@rule(CRV002)
def unsorted_points(context: LintContext) -> Iterator[Problem]:
    """Points of a curve are not in ascending order.

    This is legal: the points are sorted by ratio, or by another abscissa, before they are used. A reader of the deck
    sees another curve than the one in use, though, and a point out of order sometimes has a wrong ratio. Put the
    points in order.

    Example on clay:
        + 0.1, 1200.0
          0.5, 4200.0
        - 0.1, 1200.0

    Finds: 6:2
    """
    scene = context.scene
    for curve in chain(filterfalse(is_upside_down, scene.laws.curves), scene.other_curves):
        over = curve.points[:, 0]
        if not curve.of_seabed and not (over[1:] > over[:-1]).any():
            continue  # it is written from its other end
        for index in (np.flatnonzero(over[1:] < over[:-1])[:1] + 1).tolist():
            before, value = over[index - 1 : index + 1].tolist()
            what = f"{curve.axes[0]} {value!r} comes after {before!r}"
            repair = sorting(context.text, curve) if context.text and curve.of_seabed else None
            message = f"{what}: legal, the points are sorted; put them in order"
            yield Problem(CRV002, message, where=curve.point(index), repair=repair)


@joint(CRV009, CRV010, CRV005)
def of_one_curve(_: LintContext, found: Found) -> Iterator[Joined]:
    """Join the findings of a curve under one cause: a point that is far off, exchanged columns, or falling forces."""
    of_curve: dict[Where, dict[str, list[Problem]]] = {}
    for code, problems in found.items():
        for problem in problems if code.startswith("CRV") else ():
            if problem.where is not None and "points" in problem.where.path:
                curve = problem.where._replace(path=problem.where.path[: problem.where.path.index("points")])
                of_curve.setdefault(curve, {}).setdefault(code, []).append(problem)
    for by_code in of_curve.values():
        falls = len(by_code.get("CRV005", ())) == 1 and {"CRV007", "CRV012"} <= by_code.keys()
        code = next((code for code in ("CRV009", "CRV010") if code in by_code), "CRV005" if falls else "")
        if code:
            first = by_code[code][0]
            joined = [problem for problems in by_code.values() for problem in problems if problem is not first]
            yield Joined(first, joined)


@rule(CRV005)
def decreasing_force(context: LintContext) -> Iterator[Problem]:
    """The force decreases while the pipe penetrates deeper.

    The stiffness of the seabed is negative there: the seabed does not support the pipe but lets it snap through, unless
    the pipe itself resists. Equilibrium needs a structural stiffness above |slope| / D for each unit of length, D
    being the external diameter. Softening soil is real, but a static run rarely converges on it. Give the curve a
    force that does not decrease, or keep the curve knowingly. Neighbouring segments are one finding, at the first
    of them.

    Example on clay:
          0.5, 4200.0
        - 0.7, 3900.0
        + 0.7, 4800.0
        | 1.0, 6000.0

    Finds: 7:2
    """
    for number, curve in enumerate(context.scene.laws.curves):
        order = _distinct(curve)
        ratios, forces = curve.points[order].T
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            slopes = (forces[1:] - forces[:-1]) / (ratios[1:] - ratios[:-1])
        falling = np.flatnonzero((forces[1:] < forces[:-1]) & (ratios[1:] > 0.0) & np.isfinite(slopes))
        runs = np.split(falling, np.flatnonzero(np.diff(falling) > 1) + 1) if falling.size else []
        for run in runs[:MOST_REPORTED]:
            first, last, slope = float(ratios[run[0]]), float(ratios[run[-1] + 1]), float(slopes[run].min())
            message = (
                f"force decreases between ratio {first!r} and {last!r}, {'steepest ' * (len(run) > 1)}slope "
                f"{slope:.6g}: equilibrium needs a structural stiffness per unit length above "
                f"{_needed(context.scene, number, slope)}"
            )
            yield Problem(CRV005, message, where=curve.point(int(order[run[0] + 1])))


def is_upside_down(curve: SceneCurve) -> bool:
    """Return True if the depths of a curve seem to be negative: no ratio is above 0, some are below (CRV006)."""
    ratios = curve.points[:, 0]
    return bool(ratios.size and ratios.max() <= 0.0 and ratios.min() < 0.0)


def _distinct(curve: SceneCurve) -> Indices:
    """Return the indices of the points in the order of their ratios, one point for each ratio."""
    clashing, repeated = clashes_and_repeats(curve.points)
    order = np.argsort(curve.points[:, 0], kind="stable")
    return order[~np.isin(order, np.concatenate([clashing, repeated]))]


def _needed(scene: Scene, curve: int, slope: float) -> str:
    """Return |slope| / D in words, for the smallest diameter on the curve."""
    diameters = scene.diameter[scene.followers(curve)]
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

    The embedment ratio is measured at the centreline of the pipe, and contact begins at ratio 0: evaluation never
    reaches a point above the mudline. A curve drawn for the invert, which touches the seabed half a diameter earlier,
    begins at -0.5; its part above the mudline is lost, and the force jumps when contact begins. Remove the point, or
    draw the curve for the centreline. A curve with the force 0 up to ratio 0 loses nothing, and is not reported.

    Example on clay:
        - -0.5, 0.0
        - 0.0, 2100.0
        + 0.0, 0.0
        + 0.1, 1200.0

    Finds: 4:2
    """
    for curve in context.scene.laws.curves:
        until = curve.points[curve.points[:, 0] <= 0.0]
        if (until[:, 0] == 0.0).any() and (until[:, 1] == 0.0).all():
            continue
        above = np.flatnonzero(curve.points[:, 0] < 0.0)[: 1 if is_upside_down(curve) else MOST_REPORTED]
        for index in above.tolist():
            ratio = float(curve.points[index, 0])
            drawn = " (a curve drawn for the invert starts at -0.5)" if ratio == -0.5 else ""
            drawn = ", as all of them do: are depths negative?" if is_upside_down(curve) else drawn
            message = f"ratio {ratio!r} lies above the mudline, and contact begins at 0: remove or correct it{drawn}"
            yield Problem(CRV006, message, where=curve.point(index))


@rule(CRV004)
def repeated_point(context: LintContext) -> Iterator[Problem]:
    """A curve has the same point twice.

    It counts once, so nothing is wrong yet. If one of the two is changed later, the curve has two forces at one ratio.
    Remove one of them.

    Example on clay:
        - 0.1, 1200.0
          0.1, 1200.0

    Finds: 6:2
    """
    for curve in chain(context.scene.laws.curves, context.scene.other_curves):
        repeats = clashes_and_repeats(curve.points)[1][:MOST_REPORTED].tolist()
        rows = plain_rows(context.text, curve) if context.text and repeats and curve.of_seabed else None
        for index in repeats:
            over, value = curve.points[index].tolist()
            message = f"the point ({over!r}, {value!r}) is given twice and counts once: remove it"
            is_next = bool((curve.points[index - 1] == curve.points[index]).all())
            repair = removal(rows, int(curve.rows[index])) if rows and is_next else None
            yield Problem(CRV004, message, where=curve.point(index), repair=repair)


# -------------------------------------------------------------------------------------------------- the ends of curves


@joint(CRV012)
def falls_where_it_pulls(_: LintContext, found: Found) -> Iterator[Joined]:
    """Join a falling force to the negative force at the same point."""
    falling = {problem.where: problem for problem in found.get("CRV005", ())}
    for problem in found["CRV012"]:
        if fall := falling.get(problem.where):
            yield Joined(problem, [fall], fall.message)


def _at_zero(curve: ForceCurve) -> float:
    """Return the force at ratio 0; 0 if it overflows, or is small compared with the largest force of the curve."""
    try:
        force = float(curve.evaluate(np.zeros(1))[0][0])
    except ValueError:
        return 0.0
    return force if abs(force) > _SMALL * float(np.abs(curve.forces).max()) else 0.0


def _deepest(curve: SceneCurve) -> int:
    """Return the index of the point with the largest ratio."""
    return int(np.argmax(curve.points[:, 0]))


@rule(CRV007)
def force_at_zero(context: LintContext) -> Iterator[Problem]:
    """The force at ratio 0 is not 0.

    Contact begins at ratio 0, when the centreline reaches the mudline. With a force there, the full reaction acts as
    soon as the pipe touches, and vanishes as soon as it lifts off: the solver sees a jump and finds no equilibrium near
    it. Below its first point a curve continues with its first slope, so a curve without the point (0, 0) may have a
    force at ratio 0 too. A force above a hundredth of the largest force of the curve is reported. Add the point 0, 0.

    Example on clay:
        + 0.0, 0.0

    Finds: 3:2
    """
    for entry in context.scene.laws.curves:
        curve = entry.curve
        if curve is None or not (force := _at_zero(curve)):
            continue
        at_zero, where = np.flatnonzero(entry.points[:, 0] == 0.0), entry.where
        if at_zero.size:
            slope, advice, where = "", "give it the force 0", entry.point(int(at_zero[0]))
        elif curve.ratios[0] < 0.0:
            slope, advice = " (between the points beside it)", "correct the points about 0"
        else:
            slope, advice = " (with the slope of the first two points)", "add the point 0, 0"
        if at_zero.size or entry.whole:
            message = f"the force at ratio 0 is {force:.6g}{slope}: contact begins with a jump; {advice}"
            yield Problem(CRV007, message, where=where)


@rule(CRV012)
def curve_pulls(context: LintContext) -> Iterator[Problem]:
    """The force of a curve is negative at a ratio above 0.

    An embedded pipe would be pulled down by the seabed. A wrong sign does this, and so does a curve that keeps
    decreasing beyond its last point, or one whose first slope is so steep that it crosses 0 too late. Suction belongs
    in *SEABED SUCTION or SUCTION=, where it acts on a rising pipe. Correct the force.

    Example on clay:
        - 0.1, -1200.0
        + 0.1, 1200.0

    Finds: 5:2
    """
    for entry in context.scene.laws.curves:
        negative = np.flatnonzero((entry.points[:, 0] > 0.0) & (entry.points[:, 1] < 0.0))
        if negative.size:
            ratio, force = entry.points[negative[0]].tolist()
            more = f" (as at {negative.size - 1} more of its points)" if negative.size > 1 else ""
            message = f"the force at ratio {ratio!r} is {force!r}{more}: the seabed pulls the pipe down; correct it"
            yield Problem(CRV012, message, where=entry.point(int(negative[0])))
        elif entry.curve is not None and entry.whole and not is_upside_down(entry):
            if (force := _at_zero(entry.curve)) < 0.0:
                message = f"the force just above ratio 0 is {force:.6g}: the seabed pulls the pipe down; correct it"
                yield Problem(CRV012, message, where=entry.where)
            if entry.curve.slopes[-1] < 0.0:
                message = (
                    "the force keeps decreasing beyond the last point, until the seabed pulls the pipe down: "
                    "add a point whose force does not decrease"
                )
                yield Problem(CRV012, message, where=entry.point(_deepest(entry)))


@rule(CRV008)
def steep_extrapolation(context: LintContext) -> Iterator[Problem]:
    """The last segment of a curve is over 100 times steeper than the one before it.

    A curve continues beyond its last point with its last slope, so this segment alone gives the stiffness at every
    greater depth. A rounded ratio or two points very close together make such a slope by accident. Correct the last
    point, or remove it. Flat segments are left out of the comparison.

    Example on clay:
          0.5, 4200.0
        - 0.5001, 4400.0
        + 0.6, 5200.0

    Finds: 7:2
    """
    for entry in context.scene.laws.curves:
        if entry.curve is None or not entry.whole or entry.curve.slopes[-1] == 0.0:
            continue
        slopes = np.abs(entry.curve.slopes[entry.curve.slopes != 0.0])
        if len(slopes) > 1 and slopes[-1] / STEEPEST > slopes[-2]:
            last, before = entry.curve.slopes[-1], slopes[-2]
            message = (
                f"the last slope, {last:.6g}, is over {STEEPEST:g} times as steep as the one before, {before:.6g}, and "
                "it holds at every greater depth: correct the point, or remove it"
            )
            yield Problem(CRV008, message, where=entry.point(_deepest(entry)))


@rule(CRV013)
def flat_last_segment(context: LintContext) -> Iterator[Problem]:
    """The last segment of a curve is flat.

    A curve continues beyond its last point with its last slope, which is zero here. A pipe that is heavier than the
    last force sinks without end, and a static run does not converge. Add a point with a larger force.

    Example on clay:
          0.5, 4200.0
        - 1.0, 4200.0
        + 1.0, 4600.0

    Finds: 7:2
    """
    for entry in context.scene.laws.curves:
        if entry.curve is not None and entry.whole and entry.curve.slopes[-1] == 0.0:
            force = float(entry.curve.forces[-1])
            message = (
                f"the force stays at {force!r} at every greater depth and does not support a heavier pipe: add a "
                "point with a larger force"
            )
            yield Problem(CRV013, message, where=entry.point(_deepest(entry)))
