"""Curve evaluation: that of mudline and common alternatives, error against time per point.

Errors are measured against exact rational arithmetic on the float64 values of points and ratios, without any rounding.
Two published curves of undrained penetration in closed form are sampled at points, and their errors measured too: for
D = 0.3 m and a strength of 5 kPa at the mudline, in SI units; the ratio is z / D.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator, PPoly

from mudline.contact.arrays import FloatArray
from mudline.curves import ForceCurve
from mudline.scene.model import Scene
from mudline.study.exact import ExactCurve
from mudline.study.pictures import Picture, draw_lines, legend_below, panels, shortened
from mudline.study.report import Layout, Omission, Section, StudyOptions, columns_of, grouped
from mudline.study.timing import timed

if TYPE_CHECKING:  # only drawing needs matplotlib
    from matplotlib.figure import Figure

FORCE_ERROR, BEYOND_ERROR = "error [of largest force]", "error beyond the points [of largest force]"
LINE_ERROR, PCHIP_ERROR = "error of straight lines [of largest force]", "error of PCHIP [of largest force]"
"""Headings of the tables."""
Evaluation = Callable[[FloatArray], NDArray[np.floating]]
TABLES = tuple(4**power for power in range(2, 9))
"""Entries of the uniform tables: 16 to 65536."""
_MOST_CURVES = 2
_CHECKED = 1500
_TIMED = 100_000
_BEYOND = 1.1
_FLOOR = 1e-17
"""Smaller errors, zero included, are drawn here."""


class CurveRow(NamedTuple):
    """A method on a curve: errors are the largest of all ratios, over the largest force of the curve.

    family: methods of one family are one line of a picture.
    """

    curve: Annotated[str, "curve"]
    method: Annotated[str, "method"]
    family: str
    error: Annotated[float, FORCE_ERROR]
    beyond: Annotated[float, BEYOND_ERROR]
    nanoseconds: Annotated[float, "best time [ns/point]"]
    median: Annotated[float, "median time [ns/point]"]


CURVES = Layout("curves", "Curve evaluation against exact rational arithmetic", columns_of(CurveRow))


def study_curves(scene: Scene, options: StudyOptions) -> Section:
    """Every method on the curves of a scene, the first two without a full run."""
    named = list(scene.curves.items())
    most = len(named) if options.full else _MOST_CURVES
    omissions = [Omission(f"curve {name}", f"only {most} curves are shown without --full") for name, _ in named[most:]]
    curves: dict[str, list[CurveRow]] = {}
    for name, curve in named[:most]:
        options.progress(f"curve {name}")
        curves[name] = list(evaluate_methods(name, curve, options, omissions))
    caption = "Largest error of a curve evaluation, over the largest force, against the time per point."
    picture = Picture("curves", caption, partial(_draw, curves), (max(8.0, 4.6 * len(curves)), 5.6))
    table = CURVES.table(row for rows in curves.values() for row in rows)
    return Section([table], [picture] if curves else [], omissions=omissions)


def _draw(curves: Mapping[str, Sequence[CurveRow]], figure: Figure) -> None:
    found = panels(figure, len(curves), len(curves), sharey=True)
    slowest = max(row.nanoseconds for rows in curves.values() for row in rows)
    for axes, (name, rows) in zip(found, curves.items(), strict=True):
        families = grouped(rows, lambda row: row.family)
        lines = {f: [(max(row.error, _FLOOR), row.nanoseconds) for row in part] for f, part in families.items()}
        draw_lines(axes, lines, shortened(name), "largest error / largest force [-]", "time per point [ns]")
        axes.set_xlim(_FLOOR / 3.0, 3.0)
        axes.set_ylim(0.5, max(100.0, 2.0 * slowest))
    legend_below(figure, found[0])


def evaluate_methods(
    name: str, curve: ForceCurve, options: StudyOptions, omissions: list[Omission]
) -> Iterator[CurveRow]:
    """Every method on one curve."""
    first, last = float(curve.ratios[0]), float(curve.ratios[-1])
    rng = np.random.default_rng(20)
    inside = np.concatenate([rng.uniform(first, last, _CHECKED), curve.ratios[:_CHECKED]])
    beyond = last + (last - first) * (_BEYOND - 1.0) * rng.uniform(0.0, 1.0, 100)
    exact_inside, exact_beyond = exact_forces(curve, inside), exact_forces(curve, beyond)
    scale = float(np.abs(curve.forces).max()) or 1.0
    query = rng.uniform(first, last, _TIMED)
    for method in methods():
        try:
            evaluation = method.prepare(curve)
        except ImportError as error:
            omissions.append(Omission(f"{method.name} on {name}", f"not installed: {error}"))
            continue
        with np.errstate(all="ignore"):
            wrong = largest_error(np.asarray(evaluation(inside), np.float64), exact_inside, scale)
            outside = largest_error(np.asarray(evaluation(beyond), np.float64), exact_beyond, scale)
            evaluation(query)  # to warm up
            taken = timed(partial(evaluation, query), runs=31 if options.full else 9)
        per_point = 1e9 / _TIMED
        times = taken.best * per_point, taken.median * per_point
        yield CurveRow(name, method.name, method.family, wrong, outside, *times)


def exact_forces(curve: ForceCurve, ratios: FloatArray) -> list[Fraction]:
    """The forces at `ratios` (n,): linear between the points, the end segments continued."""
    law = ExactCurve(list(zip(curve.ratios.tolist(), curve.forces.tolist(), strict=True)), 1.0)
    return [law.spring(Fraction(0), Fraction(ratio)).force for ratio in ratios.tolist()]


def largest_error(forces: FloatArray, exact: list[Fraction], scale: float) -> float:
    """Largest |force - exact| over `scale`, rounded once at the end; inf where a force is not finite."""
    if not np.isfinite(forces).all():
        return float("inf")
    errors = (abs(Fraction(force) - true) for force, true in zip(forces.tolist(), exact, strict=True))
    return float(max(errors) / Fraction(scale))


class Method(NamedTuple):
    """A method that evaluates a curve.

    family: methods of one family are one line of a picture.
    prepare: takes the curve and returns what evaluates it.
    """

    name: str
    family: str
    prepare: Callable[[ForceCurve], Evaluation]


def methods(tables: tuple[int, ...] = TABLES) -> Iterator[Method]:
    """All methods; "fast" needs its extra when it is prepared."""
    for name, prepare in _METHODS.items():
        yield Method(name, name, prepare)
    for entries in tables:
        yield Method(f"table of {entries}", "uniform tables, 16 to 65536", partial(_table, entries=entries))


def _fast(curve: ForceCurve) -> Evaluation:
    curve.evaluate(curve.ratios, backend="fast")
    return lambda ratios: curve.evaluate(ratios, backend="fast")[0]


def _float32(curve: ForceCurve) -> Evaluation:
    ratios, forces, slopes = (array.astype(np.float32) for array in (curve.ratios, curve.forces, curve.slopes))

    def evaluate(query: FloatArray) -> NDArray[np.floating]:
        single = query.astype(np.float32)
        left = np.searchsorted(ratios[1:-1], single, side="right")
        return forces[left] + slopes[left] * (single - ratios[left])

    return evaluate


_METHODS: dict[str, Callable[[ForceCurve], Evaluation]] = {
    "mudline, numpy": lambda curve: lambda ratios: curve.evaluate(ratios, backend="numpy")[0],
    "mudline, fast": _fast,
    "np.interp": lambda curve: lambda ratios: np.interp(ratios, curve.ratios, curve.forces),
    "scipy PPoly": lambda curve: PPoly(np.array([curve.slopes, curve.forces[:-1]]), curve.ratios),
    "scipy PCHIP": lambda curve: PchipInterpolator(curve.ratios, curve.forces),
    "float32": _float32,
}


def _table(curve: ForceCurve, entries: int) -> Evaluation:
    """A lookup table: the curve resampled at even distances, with straight lines between."""
    first, last = float(curve.ratios[0]), float(curve.ratios[-1])
    forces = curve.evaluate(np.linspace(first, last, entries), backend="numpy")[0]
    slopes = np.diff(forces)
    scale = (entries - 1) / (last - first)

    def evaluate(query: FloatArray) -> NDArray[np.floating]:
        place = (query - first) * scale
        left = np.clip(place, 0, entries - 2).astype(np.intp)
        return forces[left] + slopes[left] * (place - left)

    return evaluate


DIAMETER = 0.3
_STRENGTH = 5000.0
_GRADIENT = 1500.0
_SOIL_WEIGHT = 6000.0
_STIFFNESS = 200.0
DEEPEST = 0.5
"""Ratio up to which the curves are sampled."""
POINTS = (3, 5, 7, 10, 15, 20, 30, 50, 75, 100, 150, 200, 300)


def f114(ratio: FloatArray) -> FloatArray:
    """DNV-RP-F114, undrained penetration, model 2: bearing of the pipe and buoyancy in the soil, constant strength."""
    bearing = np.minimum(6.0 * ratio**0.25, 3.4 * np.sqrt(10.0 * ratio))
    width = 2.0 * np.sqrt(np.maximum(ratio - ratio**2, 0.0))
    angle = np.arcsin(np.minimum(width, 1.0))
    shallow = 0.25 * (angle - width * np.cos(angle))
    area = np.where(ratio < 0.5, shallow, np.pi / 8.0 + ratio - 0.5) * DIAMETER**2
    return bearing * DIAMETER * _STRENGTH + 1.5 * _SOIL_WEIGHT * area


def randolph_quiggin(ratio: FloatArray) -> FloatArray:
    """Randolph and Quiggin (OMAE2009-79259), first penetration: H Nc su D, H = zeta / (1 + zeta), zeta = 200 z / D."""
    bearing = 6.0 * np.where(ratio < 0.1, 0.1**0.25 * np.sqrt(10.0 * ratio), ratio**0.25)
    zeta = _STIFFNESS * ratio
    return zeta / (1.0 + zeta) * bearing * (_STRENGTH + _GRADIENT * ratio * DIAMETER) * DIAMETER


BACKBONES = {"DNV-RP-F114, model 2": f114, "Randolph and Quiggin 2009": randolph_quiggin}
"""Curves in closed form: force per unit length over the ratio."""


def even(points: int) -> FloatArray:
    """Ratios at even distances."""
    return np.linspace(0.0, DEEPEST, points)


def graded(points: int) -> FloatArray:
    """Ratios graded towards the mudline with the fourth power, where the curve bends most."""
    return DEEPEST * np.linspace(0.0, 1.0, points) ** 4


SPACINGS = {"even": even, "graded": graded}


class BackboneRow(NamedTuple):
    """A closed form sampled at points: the error of straight lines, and of PCHIP, between them."""

    backbone: Annotated[str, "backbone"]
    spacing: Annotated[str, "points at distances"]
    points: Annotated[int, "points"]
    linear: Annotated[float, LINE_ERROR]
    pchip: Annotated[float, PCHIP_ERROR]


SAMPLES = Layout("backbones", "Closed forms sampled at points", columns_of(BackboneRow), brief=False)


def study_backbones(_: Scene, options: StudyOptions) -> Section:
    """The closed forms against their samples, error against the number of points."""
    options.progress("closed-form curves")
    rows = list(sampled_backbones())
    caption = "Largest error of a sampled closed form, over its largest force, against the number of points."
    return Section([SAMPLES.table(rows)], [Picture("backbones", caption, partial(_draw_samples, rows), (10.0, 5.2))])


def _draw_samples(rows: Sequence[BackboneRow], figure: Figure) -> None:
    backbones = grouped(rows, lambda row: row.backbone)
    found = panels(figure, len(backbones), len(backbones), sharey=True)
    for axes, (name, sampled) in zip(found, backbones.items(), strict=True):
        lines = {}
        for spacing, part in grouped(sampled, lambda row: row.spacing).items():
            lines[f"{spacing} points, straight lines"] = [(row.points, row.linear) for row in part]
            lines[f"{spacing} points, PCHIP"] = [(row.points, row.pchip) for row in part]
        draw_lines(axes, lines, name, "points on the curve [-]", "largest error / largest force [-]")
    legend_below(figure, found[0])


def sampled_backbones() -> Iterator[BackboneRow]:
    """The closed forms against their samples."""
    queries = np.unique(np.concatenate([placed(20_001) for placed in SPACINGS.values()]))
    for name, force in BACKBONES.items():
        true = force(queries)
        scale = float(true.max())
        for spacing, placed in SPACINGS.items():
            for points in POINTS:
                ratios = placed(points)
                curve = ForceCurve(np.column_stack([ratios, force(ratios)]))
                linear = curve.evaluate(queries, backend="numpy")[0]
                smooth = PchipInterpolator(curve.ratios, curve.forces)(queries)
                errors = (float(np.abs(forces - true).max() / scale) for forces in (linear, smooth))
                yield BackboneRow(name, spacing, points, *errors)
