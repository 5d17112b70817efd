"""The force-embedment curves of a scene as tables: segments, stiffness, values at ratios, static embedment."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from mudline.curves import ForceCurve
from mudline.results.numbers import finite
from mudline.scene.force_curves import SceneCurve
from mudline.scene.model import Scene

_SIDES = {-1: "below", 0: None, 1: "above"}


def curve_rows(scene: Scene, ratios: tuple[float, ...] = (), weight: float | None = None) -> list[dict[str, Any]]:
    """Each usable curve with the keys of the contract; `static` only when a weight per unit length is given.

    Raises ValueError for a ratio at which a force overflows, and for a ratio or a weight that is not finite.
    """
    return [
        _row(entry.name, curve, diameters(scene, index), ratios, weight) for index, entry, curve in used_curves(scene)
    ]


def used_curves(scene: Scene) -> list[tuple[int, SceneCurve, ForceCurve]]:
    """The curves that can be evaluated, with their indices."""
    return [(index, entry, entry.curve) for index, entry in enumerate(scene.laws.curves) if entry.curve is not None]


def diameters(scene: Scene, curve: int) -> list[float]:
    """The different external diameters of the elements that follow a curve."""
    follows = np.array([grant.curve == curve for grant in scene.laws.set_laws] + [False])[scene.laws.of_element]
    found = scene.diameter[follows]
    return [float(value) for value in np.unique(found[~np.isnan(found)])]


def _row(
    name: str, curve: ForceCurve, sizes: list[float], ratios: tuple[float, ...], weight: float | None
) -> dict[str, Any]:
    points = np.column_stack([curve.ratios, curve.forces]).tolist()
    slopes = curve.slopes.tolist()
    row: dict[str, Any] = {
        "name": name,
        "points": points,
        "segments": [{"from": points[i][0], "to": points[i + 1][0], "slope": slope} for i, slope in enumerate(slopes)],
        "at": [_value_at(curve, ratio) for ratio in ratios],
    }
    if weight is not None:
        row["static"] = [_static(curve, ratio, sizes) for ratio in curve.ratios_at_force(weight)]
    return row


def _value_at(curve: ForceCurve, ratio: float) -> dict[str, Any]:
    """Force, slope, segment and whether the curve is extrapolated at a ratio."""
    force, slope = curve.evaluate(ratio)
    return {
        "ratio": ratio,
        "force": float(force),
        "slope": float(slope),
        "segment": int(curve.segment(ratio)),
        "extrapolated": _SIDES[int(curve.extrapolated(ratio))],
    }


def _static(curve: ForceCurve, ratio: float, sizes: list[float]) -> dict[str, Any]:
    """Static embedment: where the curve carries the weight; depth and stiffness there for each diameter."""
    values = _value_at(curve, ratio)
    slope = values["slope"]
    return {
        **values,
        "stiffness": [
            {"diameter": size, "depth": finite(ratio * size), "stiffness": finite(slope / size)} for size in sizes
        ],
    }


def point_table(rows: list[dict[str, Any]]) -> Iterator[tuple[object, ...]]:
    """The points of all curves, each with the slope of the segment that begins there, under a heading."""
    yield ("curve", "ratio", "force", "slope")
    for row in rows:
        slopes = [segment["slope"] for segment in row["segments"]]
        for (ratio, force), slope in zip(row["points"], [*slopes, None], strict=True):
            yield (row["name"], ratio, force, slope)


def value_table(rows: list[dict[str, Any]]) -> Iterator[tuple[object, ...]]:
    """The values of all curves at the ratios asked for, under a heading."""
    yield ("curve", "ratio", "force", "slope", "segment", "extrapolated")
    for row in rows:
        for value in row["at"]:
            yield (row["name"], *value.values())


def static_table(rows: list[dict[str, Any]]) -> Iterator[tuple[object, ...]]:
    """The static embedments of all curves, a row a diameter, under a heading."""
    yield ("curve", "ratio", "force", "slope", "segment", "extrapolated", "diameter", "depth", "stiffness")
    for row in rows:
        for static in row["static"]:
            *values, sizes = static.values()
            for each in sizes or [{"diameter": None, "depth": None, "stiffness": None}]:
                yield (row["name"], *values, *each.values())
