"""Two published curves of undrained penetration in closed form, and what sampling them at points costs.

D = 0.3 m, strength 5 kPa at the mudline; SI units. The ratio is z / D.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.interpolate import PchipInterpolator

from mudline.contact.arrays import FloatArray
from mudline.curves import ForceCurve
from mudline.study.picture import Picture, draw_lines, label, legend_below, panels
from mudline.study.report import Layout, Section, StudyOptions, grouped

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.figure import Figure

DIAMETER = 0.3
_STRENGTH = 5000.0
_GRADIENT = 1500.0
_SOIL_WEIGHT = 6000.0
_STIFFNESS = 200.0
DEEPEST = 0.5
"""Ratio up to which the curves are sampled."""
POINTS = (3, 5, 7, 10, 15, 20, 30, 50, 75, 100, 150, 200, 300)


class Backbone(NamedTuple):
    """A curve in closed form: force per unit length over the ratio."""

    name: str
    force: Callable[[FloatArray], FloatArray]


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


BACKBONES = (Backbone("DNV-RP-F114, model 2", f114), Backbone("Randolph and Quiggin 2009", randolph_quiggin))


def even(points: int) -> FloatArray:
    """Ratios at even distances."""
    return np.linspace(0.0, DEEPEST, points)


def graded(points: int) -> FloatArray:
    """Ratios that crowd towards the mudline, with the fourth power: where the curve bends most."""
    return DEEPEST * np.linspace(0.0, 1.0, points) ** 4


SPACINGS = {"even": even, "graded": graded}


class BackboneRow(NamedTuple):
    """A closed form sampled at points: the error of straight lines, and of PCHIP, between them."""

    backbone: str
    spacing: str
    points: int
    linear: float
    pchip: float


SAMPLES = Layout[BackboneRow](
    "backbones",
    "Closed forms sampled at points",
    {
        "backbone": lambda row: row.backbone,
        "points at distances": lambda row: row.spacing,
        "points": lambda row: row.points,
        "error of straight lines [of largest force]": lambda row: row.linear,
        "error of PCHIP [of largest force]": lambda row: row.pchip,
    },
    brief=False,
)


def study_backbones(options: StudyOptions) -> Section:
    """The closed forms against their samples, error against the number of points."""
    options.progress("closed-form curves")
    rows = list(sampled_backbones())
    caption = "Largest error of a sampled closed form, over its largest force, against the number of points."
    return Section([SAMPLES.table(rows)], [Picture("backbones", caption, partial(_draw, rows), (10.0, 5.2))])


def _draw(rows: Sequence[BackboneRow], figure: Figure) -> None:
    backbones = grouped(rows, lambda row: row.backbone)
    found = panels(figure, len(backbones), len(backbones), sharey=True)
    for axes, (name, sampled) in zip(found, backbones.items(), strict=True):
        lines = {}
        for spacing, part in grouped(sampled, lambda row: row.spacing).items():
            lines[f"{spacing} points, straight lines"] = [(row.points, row.linear) for row in part]
            lines[f"{spacing} points, PCHIP"] = [(row.points, row.pchip) for row in part]
        draw_lines(axes, lines)
        label(axes, name, "points on the curve [-]", "largest error / largest force [-]")
    legend_below(figure, found[0])


def sampled_backbones() -> Iterator[BackboneRow]:
    """The closed forms against their samples."""
    fine = DEEPEST * np.linspace(0.0, 1.0, 20_001)
    queries = np.unique(np.concatenate([fine, DEEPEST * np.linspace(0.0, 1.0, 20_001) ** 4]))
    for backbone in BACKBONES:
        true = backbone.force(queries)
        scale = float(true.max())
        for spacing, placed in SPACINGS.items():
            for points in POINTS:
                ratios = placed(points)
                curve = ForceCurve(np.column_stack([ratios, backbone.force(ratios)]))
                linear = curve.evaluate(queries, backend="numpy")[0]
                smooth = PchipInterpolator(curve.ratios, curve.forces)(queries)
                errors = (float(np.abs(forces - true).max() / scale) for forces in (linear, smooth))
                yield BackboneRow(backbone.name, spacing, points, *errors)
