"""Curve evaluation: that of mudline and common alternatives, error against time per point; and sampled closed forms.

Errors are measured against exact rational arithmetic on the float64 values of points and ratios, without any rounding.
Two published curves of undrained penetration in closed form are sampled at points, and their errors measured too: for
D = 0.3 m and a strength of 5 kPa at the mudline, in SI units; the ratio is z / D.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial
from timeit import repeat

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator, PPoly

from mudline.model.contact.arrays import FloatArray
from mudline.model.curves import ForceCurve
from tests.benchmarks.studies.laws import CLAY, DIAMETER
from tests.benchmarks.tables import load, save, table
from tests.model.contact.exact import ExactCurve

CURVES, BACKBONES = "precision-curves", "precision-backbones"
Evaluation = Callable[[FloatArray], NDArray[np.floating]]
_CHECKED, _TIMED, _BEYOND = 1500, 100_000, 0.1
_STRENGTH, _GRADIENT, _SOIL_WEIGHT, _STIFFNESS = 5000.0, 1500.0, 6000.0, 200.0
DEEPEST = 0.5
"""Ratio up to which the closed forms are sampled."""
POINTS = (3, 5, 7, 10, 15, 20, 30, 50, 75, 100, 150, 200, 300)


def _table(entries: int, curve: ForceCurve) -> Evaluation:
    """A lookup table: the curve resampled at even distances, with straight lines between."""
    first, last = float(curve.ratios[0]), float(curve.ratios[-1])
    forces = curve.evaluate(np.linspace(first, last, entries))[0]
    slopes, scale = np.diff(forces), (entries - 1) / (last - first)

    def evaluate(query: FloatArray) -> NDArray[np.floating]:
        place = (query - first) * scale
        left = np.clip(place, 0, entries - 2).astype(np.intp)
        return forces[left] + slopes[left] * (place - left)

    return evaluate


METHODS: dict[str, Callable[[ForceCurve], Evaluation]] = {
    "mudline": lambda curve: lambda ratios: curve.evaluate(ratios)[0],
    "np.interp": lambda curve: lambda ratios: np.interp(ratios, curve.ratios, curve.forces),
    "scipy PPoly": lambda curve: PPoly(np.array([curve.slopes, curve.forces[:-1]]), curve.ratios),
    "scipy PCHIP": lambda curve: PchipInterpolator(curve.ratios, curve.forces),
    **{f"table of {4**power}": partial(_table, 4**power) for power in range(2, 9)},
}


def largest_error(curve: ForceCurve, evaluation: Evaluation, ratios: FloatArray) -> float:
    """The largest difference from the exact forces, over the largest force of the curve."""
    law = ExactCurve(list(zip(curve.ratios.tolist(), curve.forces.tolist(), strict=True)), 1.0)
    found = np.asarray(evaluation(ratios), np.float64).tolist()
    exact = (law.spring(Fraction(0), Fraction(ratio)).force for ratio in ratios.tolist())
    errors = (abs(Fraction(force) - true) for force, true in zip(found, exact, strict=True))
    return float(max(errors) / Fraction(float(np.abs(curve.forces).max())))


def methods(curve: ForceCurve) -> Iterator[tuple[str, float, float, float]]:
    """Every method: its error between the points, within a tenth of their range beyond them, and its ns per point."""
    first, last = float(curve.ratios[0]), float(curve.ratios[-1])
    rng = np.random.default_rng(20)
    inside = np.concatenate([rng.uniform(first, last, _CHECKED), curve.ratios])
    beyond = last + (last - first) * _BEYOND * rng.uniform(0.0, 1.0, 100)
    query = rng.uniform(first, last, _TIMED)
    for name, prepare in METHODS.items():
        evaluation = prepare(curve)
        errors = [largest_error(curve, evaluation, ratios) for ratios in (inside, beyond)]
        taken = min(repeat(partial(evaluation, query), number=1, repeat=9))
        yield name, errors[0], errors[1], 1e9 * taken / _TIMED


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


FORMS = {"DNV-RP-F114, model 2": f114, "Randolph and Quiggin 2009": randolph_quiggin}
"""Curves in closed form: force per unit length over the ratio."""
SPACINGS: dict[str, Callable[[int], FloatArray]] = {
    "even": lambda points: np.linspace(0.0, DEEPEST, points),
    "graded": lambda points: DEEPEST * np.linspace(0.0, 1.0, points) ** 4,
}
"""Ratios at even distances, and graded towards the mudline, where the curves bend most."""


def backbones() -> Iterator[tuple[str, str, int, float, float]]:
    """Curve, spacing, points; the error of straight lines and of PCHIP between them, over the largest force."""
    queries = np.unique(np.concatenate([placed(20_001) for placed in SPACINGS.values()]))
    for name, force in FORMS.items():
        true = force(queries)
        for spacing, placed in SPACINGS.items():
            for points in POINTS:
                ratios = placed(points)
                curve = ForceCurve(np.column_stack([ratios, force(ratios)]))
                smooth = PchipInterpolator(curve.ratios, curve.forces)(queries)
                found = (curve.evaluate(queries)[0], smooth)
                straight, rounded = (float(np.abs(forces - true).max() / true.max()) for forces in found)
                yield name, spacing, points, straight, rounded


def run(progress: Callable[[str], None]) -> None:
    """Write tables."""
    progress("curves")
    save(CURVES, ("method", "largest error [-]", "beyond the last point [-]", "time [ns/point]"), methods(CLAY))
    heads = ("curve", "points at distances", "points", "straight lines [-]", "PCHIP [-]")
    save(BACKBONES, heads, backbones())


def _sampled() -> str:
    rows = load(BACKBONES)
    shown = [row for row in rows if row["points"] in {"10", "100"}]
    even = [row for row in shown if row["points at distances"] == "even"]
    graded = [row for row in shown if row["points at distances"] == "graded"]
    head = ["curve", "points", "even points", "graded points", "graded points, PCHIP"]
    return table(
        head,
        [
            [a["curve"], a["points"], *(f"{100.0 * float(one[how]):.2g} %" for one, how in cells)]
            for a, b in zip(even, graded, strict=True)
            for cells in [((a, "straight lines [-]"), (b, "straight lines [-]"), (b, "PCHIP [-]"))]
        ],
    )


TABLES = {"backbones": _sampled}
