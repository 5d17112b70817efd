"""The curves of a deck by kind, as they are evaluated: points, slopes, values at ratios, static embedment."""

from __future__ import annotations

from typing import Any

import numpy as np

from mudline.basics.quantities import finite
from mudline.basics.units import UNITS
from mudline.language.deck.parameters import folded
from mudline.model.curves import ForceCurve
from mudline.model.results.summary import CURVE_SIDES
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.model import Scene


def curve_rows(scene: Scene, ratios: tuple[float, ...], weight: float | None) -> list[dict[str, Any]]:
    """Return a row of each usable curve; `static` only if a weight per unit length is given.

    `units` are those of abscissa and ordinate. `ends` is the behaviour beyond the points, and `reach` the range of the
    abscissa in which the curve is known, None for no end.

    Raises ValueError for a ratio at which a force overflows, and for a ratio or a weight that is not finite.
    """
    seabed = [(entry, curve, diameters_on(scene, index)) for index, entry, curve in used_curves(scene)]
    others = sorted(scene.other_curves, key=lambda source: (source.kind, source.keyword))
    of_others = [(source, source.curve, None) for source in others if source.curve]
    return [_curve_row(scene, *each, ratios, weight) for each in (*seabed, *of_others)]


def used_curves(scene: Scene) -> list[tuple[int, SceneCurve, ForceCurve]]:
    """Return the curves that can be evaluated, with their indices."""
    return [(index, entry, entry.curve) for index, entry in enumerate(scene.laws.curves) if entry.curve is not None]


def diameters_on(scene: Scene, curve: int) -> list[float]:
    """Return the distinct external diameters of the elements that follow a curve.

    If the deck does not list its elements, as with `*LINES`, they are the diameters of sections with the names of the
    sets that follow the curve, or of all sections if no name matches.
    """
    follow = scene.followers(curve)
    diameters = scene.diameter[follow]
    if not len(follow) and scene.context.external_definers:
        sets = {folded(grant.set_.name) for grant in scene.laws.set_laws if grant.curve == curve}
        sections = scene.section_table.sections if sets else ()
        of_sets = [section.diameter for section in sections if folded(section.name) in sets]
        diameters = np.array(of_sets or [section.diameter for section in sections])
    return [float(value) for value in np.unique(diameters[~np.isnan(diameters)])]


def _curve_row(
    scene: Scene,
    entry: SceneCurve,
    curve: ForceCurve,
    sizes: list[float] | None,
    ratios: tuple[float, ...],
    weight: float | None,
) -> dict[str, Any]:
    """Return the row of a curve; `sizes` are the diameters on a curve of the seabed, None for another curve."""
    points = np.column_stack([curve.ratios, curve.forces]).tolist()
    slopes = curve.slopes.tolist()
    row: dict[str, Any] = {
        "name": entry.name,
        "points": points,
        "segments": [{"from": points[i][0], "to": points[i + 1][0], "slope": slope} for i, slope in enumerate(slopes)],
        "at": [_value_at(curve, entry, ratio) for ratio in ratios],
    }
    if weight is not None and sizes is not None:
        row["static"] = [_static(curve, entry, ratio, sizes) for ratio in curve.ratios_at_force(weight)]
    return row | {
        "kind": entry.kind,
        "keyword": entry.keyword,
        "axes": list(entry.axes),
        "units": [UNITS[scene.units].text(unit) for unit in entry.units],
        "ends": entry.ends,
        "reach": [finite(end) for end in entry.reach],
    }


def _value_at(curve: ForceCurve, entry: SceneCurve, ratio: float) -> dict[str, Any]:
    """Return force, slope, segment and extrapolation at a ratio; None where a curve is unknown."""
    force, slope = curve.evaluate(ratio)
    values = {
        "ratio": ratio,
        "force": float(force),
        "slope": float(slope),
        "segment": int(curve.segment(ratio)),
        "extrapolated": CURVE_SIDES[int(curve.extrapolated(ratio))],
    }
    low, high = entry.reach
    if not low <= ratio <= high:
        return dict.fromkeys(values) | {"ratio": ratio, "extrapolated": CURVE_SIDES[1 if ratio > high else -1]}
    if values["extrapolated"] is not None and entry.ends == "value":
        values |= {"force": float(curve.forces[0 if values["extrapolated"] == "below" else -1]), "slope": 0.0}
    return values


def _static(curve: ForceCurve, entry: SceneCurve, ratio: float, sizes: list[float]) -> dict[str, Any]:
    """Return the static embedment, where the curve carries the weight, with depth and stiffness for each diameter.

    It is stable if the force increases with depth; otherwise the pipe sinks further.
    """
    values = _value_at(curve, entry, ratio)
    slope = values["slope"]
    return {
        **values,
        "stable": slope > 0.0,
        "stiffness": [
            {"diameter": size, "depth": finite(ratio * size), "stiffness": finite(slope / size)} for size in sizes
        ],
    }
