"""Force-embedment curves at ratio 0, above it and beyond their last point, and the curves of soil springs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mudline.checks.context import Found, Joined, LintContext, joint
from mudline.checks.rules.coordinates import UNT006
from mudline.checks.rules.curve_shape import LARGEST_RATIO, is_upside_down
from mudline.checks.rules.seabed_position import DEEPEST
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.table import Table
from mudline.language.keywords.text import shown
from mudline.language.rules import rule
from mudline.model.curves import ForceCurve
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.deck_values import number
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Mask, looked_up
from mudline.model.scene.seabed import SeabedKind

CRV007 = Code("CRV007", "force-at-zero", Severity.WARNING)
CRV008 = Code("CRV008", "steep-extrapolation", Severity.WARNING)
CRV012 = Code("CRV012", "curve-pulls", Severity.WARNING)
CRV013 = Code("CRV013", "flat-last-segment", Severity.WARNING)
CRV014 = Code("CRV014", "beyond-curve", Severity.INFO)
CRV015 = Code("CRV015", "repeated-depth", Severity.WARNING)
CRV016 = Code("CRV016", "soil-gains-again", Severity.INFO)


STEEPEST = 100.0
"""Ratio of the last two slopes of a curve."""
FEWEST_POINTS, MOST_ROUND, ROUNDING = 3, 0.5, 1e-3
"""Limits for a curve that seems to be given over metres.

FEWEST_POINTS: number of points.
MOST_ROUND: share of its points whose ratios may be round numbers.
ROUNDING: relative rounding of a depth.
"""
_SMALL = 0.01
"""Share of the largest force of a curve below which a force counts as none."""


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


@rule(CRV014)
def beyond_curve(context: LintContext) -> Iterator[Problem]:
    """Elements lie deeper, in the deck's coordinates, than their curve reaches.

    The force there is extrapolated with the last slope, and nothing was measured or calculated for it. Perhaps the
    coordinates have another datum than the seabed, X = 0; otherwise add points down to the depth of the elements.
    Nothing is reported in models whose seabed is not flat.

    Example on clay:
         $MODEL
        |*NODE
        - 1, -0.25, 0.0
        - 5, -0.25, 40.0
        + 1, -0.05, 0.0
        + 5, -0.05, 40.0
        | GEN=1, 5
        |*ELEMENT
        | 1, 1, 2
        | GEN=1, 4
        |*GEOMETRIC SETS
        | OPTION=RIGID
        | SET=ALL
        | 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 14:2
    """
    scene = context.scene
    if scene.seabed.kind is not SeabedKind.FLAT:
        return
    heights = np.append(scene.coordinates[:, 0], np.nan)[scene.element_nodes]  # -1, an unknown node, is the last one
    with np.errstate(over="ignore"):
        ratios = -(0.5 * heights[:, 0] + 0.5 * heights[:, 1]) / scene.diameter
    deepest_of_all = np.fmax.reduce(ratios, initial=-np.inf)
    if deepest_of_all > DEEPEST and not context.in_soil:
        return  # SBD022 reports the datum
    for index, entry in enumerate(scene.laws.curves):
        if entry.curve is None or not entry.whole or is_upside_down(entry) or deepest_of_all <= entry.curve.ratios[-1]:
            continue
        elements = scene.laws.followers(index)
        last = float(entry.curve.ratios[-1])
        beyond = elements[ratios[elements] > last]
        if beyond.size:
            deepest = int(beyond[np.argmax(ratios[beyond])])
            which = "an element lies" if beyond.size == 1 else f"{beyond.size} elements lie"
            message = (
                f"{which} beyond the last ratio {last!r} of curve {shown(entry.name)}, element "
                f"{scene.element_ids[deepest]} at {ratios[deepest]:.4g}: add points down to there"
            )
            yield Problem(CRV014, message, where=entry.where)


def curves_over_lengths(context: LintContext) -> Iterator[Problem]:
    """Yield the problems of UNT006 in curves: depths instead of ratios."""
    for curve, diameter in _in_lengths(context.scene):
        message = (
            f"every ratio of this curve is a round number of diameters of {diameter:.4g} (the last one "
            f"{curve.points[:, 0].max() / diameter:.3g}): if these are depths, write them divided by the diameter"
        )
        yield Problem(UNT006, message, where=curve.where)


def _in_lengths(scene: Scene) -> Iterator[tuple[SceneCurve, float]]:
    """Yield the curves whose ratios all become round numbers when multiplied by the diameter, with the diameter.

    Most of the ratios themselves are not round numbers. All elements on the curve must have one diameter.
    """
    laws = scene.laws
    candidates = [index for index, curve in enumerate(laws.curves) if _may_be_in_lengths(curve)]
    if not candidates:
        return
    curve_of_law = np.array([*(grant.curve for grant in laws.set_laws), -1], dtype=np.intp)
    of_element = looked_up(curve_of_law, laws.of_element)
    smallest, largest = np.full(len(laws.curves) + 1, np.inf), np.full(len(laws.curves) + 1, -np.inf)
    with np.errstate(invalid="ignore"):  # an element without a diameter makes both NaN
        np.minimum.at(smallest, of_element, scene.diameter)
        np.maximum.at(largest, of_element, scene.diameter)
    for index in candidates:
        curve, diameter = laws.curves[index], float(smallest[index])
        if diameter == largest[index] and _is_round(_ratios(curve) / diameter).all():
            yield curve, diameter


def _may_be_in_lengths(curve: SceneCurve) -> bool:
    """Return True if most ratios of a curve are not round numbers, and CRV010 reports none of them."""
    if not curve.usable or np.count_nonzero(curve.points[:, 0]) < FEWEST_POINTS:
        return False
    ratios = _ratios(curve)
    if ratios.max() > LARGEST_RATIO:
        return False
    return bool(_is_round(ratios).mean() < MOST_ROUND)


def _ratios(curve: SceneCurve) -> Floats:
    ratios: Floats = curve.points[curve.points[:, 0] != 0.0, 0]
    return ratios


def _is_round(values: Floats) -> Mask:
    """Return a mask of the numbers with two significant digits, within the rounding of the deck."""
    with np.errstate(divide="ignore", over="ignore", under="ignore", invalid="ignore"):
        digits = np.abs(values) / 10.0 ** np.floor(np.log10(np.abs(values)))  # inf for the smallest floats
        return np.abs(digits - digits.round(1)) <= ROUNDING * digits


# --------------------------------------------------------------------------------------------------------- soil springs


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
