"""Force-embedment curves between their first and last points: columns, order, repeated points, falling forces."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, filterfalse
from typing import NamedTuple

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.checks.context import Found, Joined, LintContext, joint
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Code, Problem, Repair, Severity, Span, Where
from mudline.language.keywords.text import shown
from mudline.language.rules import rule
from mudline.language.syntax.rows import line_spans, row_fields
from mudline.model.scene.curves import SceneCurve, clashes_and_repeats
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices

CRV002 = Code("CRV002", "unsorted-points", Severity.INFO)
CRV004 = Code("CRV004", "repeated-point", Severity.WARNING)
CRV005 = Code("CRV005", "decreasing-force", Severity.WARNING)
CRV006 = Code("CRV006", "negative-ratio", Severity.WARNING)
CRV009 = Code("CRV009", "swapped-columns", Severity.WARNING)
CRV010 = Code("CRV010", "ratio-range", Severity.WARNING)

LARGEST_RATIO = 5.0
"""Largest embedment ratio in diameters; a larger one is a length or a percentage."""
_LIKE_A_FORCE = 10.0
_LIKE_A_RATIO = 2.0

_NO_PLAIN_NUMBERS = frozenset('["{')


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


def _exchange(text: TextOrigin, curve: SceneCurve) -> Repair | None:
    """Return a repair that exchanges the fields of each row; None for a curve not read whole, or very long."""
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
        if _free_above(curve.points):
            continue
        above = np.flatnonzero(curve.points[:, 0] < 0.0)[: 1 if is_upside_down(curve) else MOST_REPORTED]
        for index in above.tolist():
            ratio = float(curve.points[index, 0])
            drawn = " (a curve drawn for the invert starts at -0.5)" if ratio == -0.5 else ""
            drawn = ", as all of them do: are depths negative?" if is_upside_down(curve) else drawn
            message = f"ratio {ratio!r} lies above the mudline, and contact begins at 0: remove or correct it{drawn}"
            yield Problem(CRV006, message, where=curve.point(index))


def _free_above(points: Floats) -> bool:
    """Return True if a curve has no force above the mudline, up to a point at 0."""
    above = points[points[:, 0] <= 0.0]
    return bool((above[:, 0] == 0.0).any() and (above[:, 1] == 0.0).all())


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


class CurveRows(NamedTuple):
    """Lines of a table, without white space and line ends after them; `before` is the text of the curve above them."""

    source: str
    lines: list[Span]
    before: str

    def crosses_comment(self, order: Indices) -> bool:
        """Return True if a comment is next to a row that the new order moves, or that other rows pass."""
        settled = np.maximum.accumulate(order) == np.arange(len(order))  # up to here the rows stay among themselves
        stays = order == np.arange(len(order))
        if "mudline" in self.before.lower() and not stays[0]:  # a comment that speaks of the first row alone
            return True
        for place in range(len(order) - 1):
            between = self.source[self.lines[place].end : self.lines[place + 1].start]
            if between.strip() and not (settled[place] and stays[place] and stays[place + 1]):
                return True
        return False


def plain_rows(text: TextOrigin, curve: SceneCurve) -> CurveRows | None:
    """Return the rows of a curve; None if there are very many, or equations, whose parameters may change."""
    block = text.read.get((curve.where.section, curve.where.block))
    if block is None or len(curve.points) > MOST_REPORTED:
        return None
    source = text.source.unified
    runs = block.places.runs.get((*curve.where.path, "points"), [])
    lines = [
        Span(line.start, line.start + len(source[slice(*line)].rstrip()))
        for line in chain.from_iterable(line_spans(source, run) for _, run in runs)
    ]
    if not lines or any(not _NO_PLAIN_NUMBERS.isdisjoint(source[slice(*line)]) for line in lines):
        return None
    opening = block.places.find(curve.where.path).start
    if opening >= lines[0].start:  # rows of *EMBEDMENT that stand under no SET=
        opening = block.places.block.start
    return CurveRows(source, lines, source[opening : lines[0].start])


def sorting(text: TextOrigin, curve: SceneCurve) -> Repair | None:
    """Return a repair that sorts the rows by their ratios.

    None for a curve that is not read whole, is very long or has equations, or if a comment would then be next to
    another row.
    """
    if not curve.whole or (rows := plain_rows(text, curve)) is None or len(rows.lines) != len(curve.points):
        return None
    order = np.argsort(curve.points[:, 0], kind="stable")
    if rows.crosses_comment(order):
        return None
    edits = [
        (rows.lines[place], rows.source[slice(*rows.lines[row])])
        for place, row in enumerate(order.tolist())
        if place != row
    ]
    return Repair("safe", "put the points in order", tuple(edits)) if edits else None


def removal(rows: CurveRows, row: int) -> Repair:
    """Return a repair that removes a row."""
    line = rows.lines[row]
    following = rows.source.find("\n", line.end)
    end = len(rows.source) if following < 0 else following + 1
    return Repair("safe", "remove the point", ((Span(line.start, end), ""),))
