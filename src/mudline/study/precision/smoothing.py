"""The quadratic zone around the mudline: what its half width h costs in error and saves, or costs, in iterations."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.scene.model import Scene
from mudline.study.laws import ElasticContact, LinearLaw, smoothed_spring
from mudline.study.pictures import Picture, Points, draw_lines, drawn
from mudline.study.precision.drop import Drop, drop_case, reference_drop
from mudline.study.precision.integration import row
from mudline.study.report import Layout, Section, StudyOptions, columns_of, grouped
from mudline.study.schemes import SCHEMES, Newton

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.figure import Figure

SHARES = (0.0, *(10.0 ** (power / 2.0) for power in range(-6, 7)))
"""Half widths over the static penetration of the kinked law."""
WIDTHS = (0.0, 1e-6, 1e-4, 1e-3, 1e-2)
"""Half widths of the published case, m."""
_IMPACT_SHARES = (0.0, *(10.0 ** (power / 2.0) for power in range(-8, 1)))
_IMPACT_SCHEMES = ("newmark", "generalised-alpha-0.5", "backward-euler")
_IMPACT_STEPS = (0.1, 0.5)


_NONE = 1e-5
"""Where h = 0 stands on a logarithmic axis."""


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


def study_smoothing(scene: Scene, contacts: Sequence[ElasticContact], options: StudyOptions) -> Section:
    """At rest on the published case and on the scene's stiffest law as if it were linear; and the published impact."""
    options.progress("smoothing")
    widths = np.unique([float(f"{width:.4g}") for width in (*WIDTHS, *(share * 1e-5 for share in SHARES))])
    rest = list(at_rest(PUBLISHED, widths))
    for contact in contacts[:1]:
        stiffness, start = contact.stiffness, 0.7 * contact.diameter
        own = Rest(contact.law.name, stiffness, 2e-5 * stiffness, contact.weight, start)
        rest += at_rest(own, np.array(SHARES) * own.kinked)
    hits = list(impacts(weightless(reference_drop())))
    tables = SMOOTHING.table(rest, scene.units), IMPACTS.table(hits)
    caption = "Smoothing: Newton iterations and errors against the half width h of the zone; h = 0 stands far left."
    return Section(tables, [Picture("smoothing", caption, partial(_draw, rest, hits), (11.5, 9.0))])


def _draw(rest: Sequence[RestRow], hits: Sequence[ImpactRow], figure: Figure) -> None:
    """At rest: iterations and error; at an impact: error of the rebound and iterations."""
    (iterations, error), (rebound, effort) = figure.subplots(2, 2)
    tries: dict[str, Points] = {}
    wrong: dict[str, Points] = {}
    for name, rows in grouped(sorted(rest, key=_share), lambda row: drawn(row.case)).items():
        tries[f"{name}, from above"] = [(_share(row), row.from_above) for row in rows]
        tries[f"{name}, from below"] = [(_share(row), row.from_below) for row in rows]
        wrong[name] = [(_share(row), row.error) for row in rows if row.error > 1e-15]
    x = "h / static penetration [-]; h = 0 far left"
    draw_lines(iterations, tries, "at rest", x, "Newton iterations [-]")
    draw_lines(error, wrong, "at rest", x, "relative error of the penetration [-]")
    runs = grouped(hits, lambda row: f"{SCHEMES[row.scheme].title}, omega dt = {row.omega_dt:g}")
    speeds = {name: [(_share(r), r.rebound) for r in rows if r.rebound is not None] for name, rows in runs.items()}
    tries = {name: [(_share(row), row.iterations) for row in rows] for name, rows in runs.items()}
    x = "h / deepest penetration [-]; h = 0 far left"
    draw_lines(rebound, speeds, "impact", x, "relative error of the rebound speed [-]")
    draw_lines(effort, tries, "impact", x, "Newton iterations per step [-]")
    for axes in (iterations, effort):
        axes.set_yscale("linear")
    for axes in (iterations, error, rebound):
        axes.legend(fontsize="x-small", loc="best")


def _share(row: RestRow | ImpactRow) -> float:
    """The half width over the penetration, where it is drawn."""
    return max(row.share, _NONE)


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
    """The same fall on seabeds of growing zones: how fast the mass leaves, and how many iterations a step takes."""
    stiffness = drop.law.steepest(0.0)
    for share in _IMPACT_SHARES:
        width = share * drop.deepest
        law = LinearLaw(f"h = {width:g}", stiffness, width)
        case = drop_case("smoothed", law.name, replace(drop, law=law))
        for name in _IMPACT_SCHEMES:
            for omega_dt in _IMPACT_STEPS:
                found = row(case, SCHEMES[name], omega_dt)
                yield ImpactRow(name, omega_dt, width, share, found.speed, found.iterations, found.reason)


def weightless(drop: Drop) -> Drop:
    """The same without gravity, so that nothing but the impact is seen."""
    deepest = drop.speed * math.sqrt(drop.mass / drop.law.steepest(0.0))
    return replace(drop, weight=0.0, deepest=deepest)
