"""Curve evaluation: mudline's own way and those that people use instead, error against time per point.

Errors are measured against exact rational arithmetic: points and ratios as the doubles they are, no rounding at all.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator, PPoly

from mudline.contact.arrays import FloatArray
from mudline.curves import ForceCurve
from mudline.scene.model import Scene
from mudline.study.exact import ExactCurve
from mudline.study.picture import Picture, draw_lines, label, legend_below, panels, shortened
from mudline.study.report import Layout, Omission, Section, StudyOptions, grouped
from mudline.study.timing import timed

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.figure import Figure

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
    nanoseconds, median: best and middle time per point.
    """

    curve: str
    method: str
    family: str
    error: float
    beyond: float
    nanoseconds: float
    median: float


CURVES = Layout[CurveRow](
    "curves",
    "Curve evaluation against exact rational arithmetic",
    {
        "curve": lambda row: row.curve,
        "method": lambda row: row.method,
        "error [of largest force]": lambda row: row.error,
        "error beyond the points [of largest force]": lambda row: row.beyond,
        "best time [ns/point]": lambda row: row.nanoseconds,
        "median time [ns/point]": lambda row: row.median,
    },
)


def study_curves(scene: Scene, options: StudyOptions) -> Section:
    """Every method on the curves of a scene, the first two without a full run."""
    named = list(scene.curves.items())
    most = len(named) if options.full else _MOST_CURVES
    omissions = [Omission(f"curve {name}", f"only {most} curves are shown without --full") for name, _ in named[most:]]
    rows: list[CurveRow] = []
    for name, curve in named[:most]:
        options.progress(f"curve {name}")
        rows += evaluate_methods(name, curve, options, omissions)
    return Section([CURVES.table(rows)], [_picture(rows)] if rows else [], omissions=omissions)


def _picture(rows: Sequence[CurveRow]) -> Picture:
    curves = grouped(rows, lambda row: row.curve)
    caption = "Largest error of a curve evaluation, over the largest force, against the time per point."
    return Picture("curves", caption, partial(_draw, curves), (max(8.0, 4.6 * len(curves)), 5.6))


def _draw(curves: Mapping[str, Sequence[CurveRow]], figure: Figure) -> None:
    found = panels(figure, len(curves), len(curves), sharey=True)
    slowest = max(row.nanoseconds for rows in curves.values() for row in rows)
    for axes, (name, rows) in zip(found, curves.items(), strict=True):
        families = grouped(rows, lambda row: row.family)
        draw_lines(axes, {f: [(max(r.error, _FLOOR), r.nanoseconds) for r in part] for f, part in families.items()})
        label(axes, shortened(name), "largest error / largest force [-]", "time per point [ns]")
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
    """A way to evaluate a curve.

    family: methods of one family are one line of a picture.
    prepare: takes the curve and returns what evaluates it.
    """

    name: str
    family: str
    prepare: Callable[[ForceCurve], Evaluation]


def methods(tables: tuple[int, ...] = TABLES) -> Iterator[Method]:
    """All of them; "fast" needs its extra when it is prepared."""
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
    """The curve resampled at even distances, and straight lines between: what a lookup table does."""
    first, last = float(curve.ratios[0]), float(curve.ratios[-1])
    forces = curve.evaluate(np.linspace(first, last, entries), backend="numpy")[0]
    slopes = np.diff(forces)
    scale = (entries - 1) / (last - first)

    def evaluate(query: FloatArray) -> NDArray[np.floating]:
        place = (query - first) * scale
        left = np.clip(place, 0, entries - 2).astype(np.intp)
        return forces[left] + slopes[left] * (place - left)

    return evaluate
