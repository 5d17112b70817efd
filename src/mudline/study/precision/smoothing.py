"""The quadratic zone around the mudline: error and iterations against its half width h."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.scene.deck_values import FOOT
from mudline.scene.model import Scene
from mudline.study.laws import LinearLaw, smoothed_spring
from mudline.study.newton import Newton
from mudline.study.pictures import LineStyle, Picture, Points, drawn, label, line_style, zero_place, zero_tick
from mudline.study.precision.contacts import contacts_of
from mudline.study.precision.exact_motions import Drop, drop_case, reference_drop
from mudline.study.precision.integration import TRIED, row
from mudline.study.report import Layout, Section, StudyOptions, columns_of, grouped
from mudline.study.schemes import SCHEMES, STYLES

if TYPE_CHECKING:  # only drawing needs matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SHARES = (0.0, *(10.0 ** (power / 2.0) for power in range(-6, 7)))
"""Half widths over the static penetration of the kinked law."""
WIDTHS = (0.0, 1e-6, 1e-4, 1e-3, 1e-2)
"""Half widths of the published case, m."""
_IMPACT_SHARES = (0.0, *(10.0 ** (power / 2.0) for power in range(-8, 1)))
_IMPACT_SCHEMES = ("newmark", "generalised-alpha-0.5", "backward-euler")
_IMPACT_STEPS = (0.1, 0.5)


_EXACT = 1e-15
"""Smaller errors at rest are drawn here."""
_COLORS = ("#332288", "#999933")
"""Of the cases at rest; schemes have their own."""


class Rest(NamedTuple):
    """A node at rest between a structural spring, a load and a linear seabed: k_b z + F(z) = load."""

    name: str
    stiffness: float
    spring: float
    load: float
    start: float

    @property
    def kinked(self) -> float:
        """Penetration without smoothing."""
        return self.load / (self.stiffness + self.spring)


PUBLISHED = Rest("published case", 5e7, 1e3, 500.0, 0.2)


class RestRow(NamedTuple):
    """Penetration and Newton iterations from above and from below; the error is relative to the kinked law."""

    case: Annotated[str, "case"]
    half_width: Annotated[float, "half width h [{length}]"]
    share: Annotated[float, "h / static penetration"]
    penetration: Annotated[float, "penetration [{length}]"]
    error: Annotated[float, "error of penetration [relative]"]
    from_above: Annotated[int, "iterations from above"]
    from_below: Annotated[int, "iterations from below"]


class ImpactRow(NamedTuple):
    """A drop on a smoothed seabed: half width over the penetration of the kinked law, and the errors of a scheme."""

    scheme: Annotated[str, "scheme"]
    omega_dt: Annotated[float, "omega dt"]
    half_width: Annotated[float, "half width h [m]"]
    share: Annotated[float, "h / deepest penetration"]
    rebound: Annotated[float | None, "error of rebound speed [relative]"]
    iterations: Annotated[float, "Newton iterations per step"]
    reason: Annotated[str, "reason"]


SMOOTHING = Layout("smoothing", "Smoothing at rest: Newton iterations and error", columns_of(RestRow))
IMPACTS = Layout("impacts", "Smoothing at an impact", columns_of(ImpactRow), brief=False)


def study_smoothing(scene: Scene, options: StudyOptions) -> Section:
    """At rest on the published case and on the scene's stiffest law as if it were linear; and the published impact."""
    options.progress("smoothing")
    widths = np.unique([float(f"{width:.4g}") for width in (*WIDTHS, *(share * 1e-5 for share in SHARES))])
    unit = FOOT if scene.units == "imperial" else 1.0
    rest = [
        row._replace(half_width=row.half_width / unit, penetration=row.penetration / unit)
        for row in at_rest(PUBLISHED, widths)
    ]
    for contact in contacts_of(scene).contacts[:1]:
        stiffness, start = contact.stiffness, 0.7 * contact.diameter
        own = Rest(contact.law.name, stiffness, 2e-5 * stiffness, contact.weight, start)
        rest += at_rest(own, np.array(SHARES) * own.kinked)
    hits = list(impacts(weightless(reference_drop())))
    tables = SMOOTHING.table(rest, scene.units), IMPACTS.table(hits)
    caption = (
        "Smoothing: Newton iterations and errors against the half width h of the zone; h = 0 has a tick of its own."
    )
    return Section(tables, [Picture("smoothing", caption, partial(_draw, rest, hits), (11.5, 9.0))])


def _draw(rest: Sequence[RestRow], hits: Sequence[ImpactRow], figure: Figure) -> None:
    """At rest: iterations and error; at an impact: error of the rebound and iterations."""
    (iterations, error), (rebound, effort) = figure.subplots(2, 2)
    for (name, rows), color in zip(grouped(rest, lambda row: drawn(row.case)).items(), _COLORS, strict=False):
        found = sorted(rows, key=lambda row: row.share)
        for words, marker, field in (("above", "v", "from_above"), ("below", "^", "from_below")):
            tries = [(row.share, float(getattr(row, field))) for row in found]
            _through(iterations, tries, line_style(color, marker), f"{name}, from {words}")
        _through(error, [(row.share, max(row.error, _EXACT)) for row in found], line_style(color, "o"), name)
    for (scheme, omega_dt), runs in grouped(hits, lambda row: (row.scheme, row.omega_dt)).items():
        title = SCHEMES[scheme].title
        large = {"linestyle": "--", "fillstyle": "none"} if omega_dt > min(_IMPACT_STEPS) else {"linestyle": "-"}
        look, name = STYLES[title] | large, f"{title}, omega dt = {omega_dt:g}"
        _through(rebound, [(row.share, row.rebound) for row in runs if row.rebound is not None], look, name)
        _through(effort, [(row.share, row.iterations) for row in runs], look, name)
    label(iterations, "at rest", "h / static penetration [-]", "Newton iterations [-]")
    label(error, "at rest", "h / static penetration [-]", "relative error of the penetration [-]")
    label(rebound, "impact", "h / deepest penetration [-]", "relative error of the rebound speed [-]")
    label(effort, "impact", "h / deepest penetration [-]", "Newton iterations per step [-]")
    for axes, shares in ((iterations, rest), (error, rest), (rebound, hits), (effort, hits)):
        axes.set_xscale("log")
        zero_tick(axes, zero_place(row.share for row in shares))
    for axes in (error, rebound):
        axes.set_yscale("log")
    for axes in (iterations, error, rebound):
        axes.legend(fontsize="x-small", loc="best")


def _through(axes: Axes, points: Points, look: LineStyle, name: str) -> None:
    """A line through points; the point at h = 0 is drawn separately."""
    above = [point for point in points if point[0] > 0.0]
    axes.plot([x for x, _ in above], [y for _, y in above], label=name, **look)
    at_zero = [y for x, y in points if x == 0.0]
    axes.plot([zero_place(x for x, _ in points)] * len(at_zero), at_zero, **(look | {"linestyle": "none"}))


def at_rest(rest: Rest, widths: FloatArray) -> Iterator[RestRow]:
    """Solve for every half width, from above the seabed and from below."""
    count = len(widths)
    both = np.concatenate([widths, widths])

    def residual(z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        force, slope = smoothed_spring(z, rest.stiffness, both)
        return rest.spring * z + force - rest.load, rest.spring + slope, np.abs(force) + rest.load

    start = np.concatenate([np.full(count, -rest.start), np.full(count, rest.start)])
    solution = Newton(most=200).solve(residual, start)
    above, below = solution.iterations[:count], solution.iterations[count:]
    for index, width in enumerate(widths.tolist()):
        z = float(solution.root[index])
        error = abs(z / rest.kinked - 1.0)
        yield RestRow(rest.name, width, width / rest.kinked, z, error, int(above[index]), int(below[index]))


def impacts(drop: Drop) -> Iterator[ImpactRow]:
    """The same drop on seabeds with wider and wider zones: rebound speed, and iterations of a step."""
    stiffness = drop.law.steepest(0.0)
    for share in _IMPACT_SHARES:
        width = share * drop.deepest
        law = LinearLaw(f"h = {width:g}", stiffness, width)
        case = drop_case("smoothed", law.name, replace(drop, law=law))
        for name in _IMPACT_SCHEMES:
            for omega_dt in _IMPACT_STEPS:
                found = row(case, TRIED[name], omega_dt)
                yield ImpactRow(name, omega_dt, width, share, found.speed, found.iterations, found.reason)


def weightless(drop: Drop) -> Drop:
    """The same drop without gravity, for the impact alone."""
    deepest = drop.speed * math.sqrt(drop.mass / drop.law.steepest(0.0))
    return replace(drop, weight=0.0, deepest=deepest)
