"""Published curves of penetration, sampled at points: errors of lines between them, over the largest force.

They are those of `mudline backbone` for a pipe of 0.3 m and a strength of 5 kPa at the mudline.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from scipy.interpolate import PchipInterpolator

from mudline.model.contact.arrays import FloatArray
from mudline.model.curves import ForceCurve
from mudline.model.curves.backbones import MODELS, Backbone, Soil
from tests.benchmarks.studies.laws import DIAMETER
from tests.benchmarks.tables import load, save, table

BACKBONES = "precision-backbones"
DEEPEST = 0.5
"""Ratio up to which the closed forms are sampled."""
POINTS = (5, 10, 100, 300)
_SOILS = {"f114": Soil(DIAMETER, 5000.0, weight=6000.0), "randolph-quiggin": Soil(DIAMETER, 5000.0, 1500.0)}
SPACINGS: dict[str, Callable[[int], FloatArray]] = {
    "even": lambda points: np.linspace(0.0, DEEPEST, points),
    "graded": lambda points: DEEPEST * np.linspace(0.0, 1.0, points) ** 4,
}
"""Ratios at even distances, and graded towards the mudline, where the curves bend most."""


def backbones() -> Iterator[tuple[str, str, int, float, float]]:
    """Curve, spacing, points; the error of straight lines and of PCHIP between them, over the largest force."""
    queries = np.unique(np.concatenate([placed(20_001) for placed in SPACINGS.values()]))
    for model, soil in _SOILS.items():
        backbone = Backbone(MODELS[model], soil)
        true = backbone.force(queries)
        for spacing, placed in SPACINGS.items():
            for points in POINTS:
                ratios = placed(points)
                curve = ForceCurve(np.column_stack([ratios, backbone.force(ratios)]))
                smooth = PchipInterpolator(curve.ratios, curve.forces)(queries)
                found = (curve.evaluate(queries)[0], smooth)
                straight, rounded = (float(np.abs(forces - true).max() / true.max()) for forces in found)
                yield backbone.model.title, spacing, points, straight, rounded


def run(progress: Callable[[str], None]) -> None:
    """Write the table."""
    progress("curves")
    save(BACKBONES, ("curve", "points at distances", "points", "straight lines [-]", "PCHIP [-]"), backbones())


def _sampled() -> str:
    even, graded = (
        [row for row in load(BACKBONES) if row["points at distances"] == spacing] for spacing in ("even", "graded")
    )
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
