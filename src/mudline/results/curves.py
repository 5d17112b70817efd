"""The force-embedment curves of a scene as tables: segments, stiffness, values at ratios, static embedment."""

from __future__ import annotations

from typing import Any

import numpy as np

from mudline.curves import ForceCurve
from mudline.scene.force_curves import SceneCurve
from mudline.scene.model import Scene

_SIDES = {-1: "below", 0: None, 1: "above"}


def curve_rows(scene: Scene, ratios: tuple[float, ...] = (), weight: float | None = None) -> list[dict[str, Any]]:
    """Each usable curve with the keys of the contract; `static` only when a weight per unit length is given.

    Raises ValueError for a ratio at which a force overflows.
    """
    return [
        _row(entry.name, curve, diameters(scene, index), ratios, weight) for index, entry, curve in used_curves(scene)
    ]


def used_curves(scene: Scene) -> list[tuple[int, SceneCurve, ForceCurve]]:
    """The curves that can be evaluated, with their indices."""
    return [(index, entry, entry.curve) for index, entry in enumerate(scene.laws.curves) if entry.curve is not None]


def diameters(scene: Scene, curve: int) -> list[float]:
    """The different external diameters of the elements that follow a curve."""
    follows = np.array([grant.curve == curve for grant in scene.laws.grants] + [False])[scene.laws.of_element]
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
        "at": [value_at(curve, ratio) for ratio in ratios],
    }
    if weight is not None:
        row["static"] = [_static(curve, ratio, sizes) for ratio in curve.ratios_at_force(weight)]
    return row


def value_at(curve: ForceCurve, ratio: float) -> dict[str, Any]:
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
    """Static embedment: where the curve carries the weight; the stiffness there for each diameter."""
    values = value_at(curve, ratio)
    return {
        "ratio": ratio,
        "slope": values["slope"],
        "extrapolated": values["extrapolated"],
        "stiffness": [{"diameter": size, "depth": ratio * size, "stiffness": values["slope"] / size} for size in sizes],
    }
