"""Curve evaluation: error against exact arithmetic and against closed forms, and time per point."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.interpolate import PchipInterpolator

from mudline.contact.arrays import FloatArray
from mudline.curves import ForceCurve
from mudline.study.precision.backbones import BACKBONES, DEEPEST, SPACINGS
from mudline.study.precision.exact import exact_forces, largest_error
from mudline.study.precision.methods import Method, methods
from mudline.study.report import Omission, StudyOptions
from mudline.study.timing import timed

_CHECKED = 1500
_TIMED = 100_000
_BEYOND = 1.1
POINTS = (3, 5, 7, 10, 15, 20, 30, 50, 75, 100, 150, 200, 300)


class CurveRow(NamedTuple):
    """A method on a curve: errors are the largest of all ratios, over the largest force of the curve."""

    curve: str
    method: str
    family: str
    error: float
    beyond: float
    nanoseconds: float
    median: float


class BackboneRow(NamedTuple):
    """A closed form sampled at points: the error of straight lines, and of PCHIP, between them."""

    backbone: str
    spacing: str
    points: int
    linear: float
    pchip: float


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
        yield CurveRow(name, *_words(method), wrong, outside, taken.best * per_point, taken.median * per_point)


def _words(method: Method) -> tuple[str, str]:
    return method.name, method.family


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
                yield BackboneRow(
                    backbone.name, spacing, points, _largest(linear - true, scale), _largest(smooth - true, scale)
                )


def _largest(difference: FloatArray, scale: float) -> float:
    return float(np.abs(difference).max() / scale)
