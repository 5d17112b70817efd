"""The force-embedment curves of a scene as tables, and the static embedment of its elements."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray
from mudline.contact.input import LawAssignment, LawKind
from mudline.contact.laws.linear import penetration_under, smoothed_reaction
from mudline.curves import ForceCurve
from mudline.results.quantities import finite
from mudline.scene.assignments import element_smoothing, nodal_springs
from mudline.scene.force_curves import SceneCurve
from mudline.scene.model import Scene
from mudline.scene.numbering import Floats, Indices, summed
from mudline.scene.resolved import LawArrays

_SIDES = {-1: "below", 0: None, 1: "above"}


def curve_rows(scene: Scene, ratios: tuple[float, ...] = (), weight: float | None = None) -> list[dict[str, Any]]:
    """Each usable curve with the keys of the contract; `static` only when a weight per unit length is given.

    Raises ValueError for a ratio at which a force overflows, and for a ratio or a weight that is not finite.
    """
    return [
        _curve_row(entry.name, curve, diameters(scene, index), ratios, weight)
        for index, entry, curve in used_curves(scene)
    ]


def used_curves(scene: Scene) -> list[tuple[int, SceneCurve, ForceCurve]]:
    """The curves that can be evaluated, with their indices."""
    return [(index, entry, entry.curve) for index, entry in enumerate(scene.laws.curves) if entry.curve is not None]


def followers(scene: Scene, curve: int) -> BoolArray:
    """The elements (m,) that follow a curve."""
    found: BoolArray = np.array([grant.curve == curve for grant in scene.laws.set_laws] + [False])[
        scene.laws.of_element
    ]
    return found


def diameters(scene: Scene, curve: int) -> list[float]:
    """The different external diameters of the elements that follow a curve."""
    found = scene.diameter[followers(scene, curve)]
    return [float(value) for value in np.unique(found[~np.isnan(found)])]


def _curve_row(
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


_MOST = 100
"""Rows: what a table can show."""


class _Case(NamedTuple):
    """Elements that share a law, a weight per length and a diameter; the index of one of them."""

    set_name: str | None
    law: str
    weight: float
    element: int


def static_embedment(scene: Scene) -> list[dict[str, Any]]:
    """A row for each set, law, weight per length and diameter of elements whose weight is known, up to 100 rows.

    `penetration` is where the law, smoothed as it is evaluated, carries the weight, `stiffness` that of the law there.
    Of a curve that does so at several ratios it is the smallest that is not negative. For nodal laws there is a row for
    the node that carries least and one for the node that carries most; `stiffness` is then Kn, force per length.
    """
    weight = scene.submerged_weight
    known = np.flatnonzero((weight > 0.0) & np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR)))
    arrays, zones = scene.law_arrays(), _Zones.of_elements(scene)
    rows = [_of_element(scene, arrays, zones, case) for case in _cases(scene, weight, zones, known)]
    return [*rows, *_of_nodes(scene, weight)][:_MOST]


class _Zones(NamedTuple):
    """Quadratic zones of all elements, or of all nodes: half widths, and which lie below the mudline only."""

    half_width: Floats
    one_sided: Floats

    @classmethod
    def of(cls, law: LawAssignment | None, count: int) -> _Zones:
        """Return the zones that a law gives its rows."""
        half_width, one_sided = np.zeros(count), np.zeros(count)
        if law is not None:
            half_width[law.rows] = law.parameters["half_width"]
            one_sided[law.rows] = law.parameters["one_sided"]
        return cls(half_width, one_sided)

    @classmethod
    def of_elements(cls, scene: Scene) -> _Zones:
        """Return the zones of linear laws."""
        smoothing = element_smoothing(scene) if "SEABED CONTACT" in scene.extensions else None
        return cls.of(smoothing, len(scene.element_ids))


def _cases(scene: Scene, weight: Floats, zones: _Zones, elements: Indices) -> list[_Case]:
    if not elements.size:
        return []
    sizes = np.nan_to_num(scene.diameter[elements])
    width, side = zones.half_width[elements], zones.one_sided[elements]
    keys = np.column_stack([scene.laws.of_element[elements], weight[elements], sizes, width, side])
    firsts = np.sort(np.unique(keys, axis=0, return_index=True)[1])[:_MOST]
    found = elements[firsts].tolist()
    return [_Case(scene.law_sets[at], scene.law_names[at], float(weight[at]), at) for at in found]


def _of_element(scene: Scene, arrays: LawArrays, zones: _Zones, case: _Case) -> dict[str, Any]:
    diameter = float(scene.diameter[case.element])
    with np.errstate(all="ignore"):
        if scene.law[case.element] == LawKind.LINEAR:
            stiffness = float(arrays.linear_stiffness[case.element])
            law = stiffness, zones.half_width[case.element], zones.one_sided[case.element]
            depth = float(penetration_under(np.float64(case.weight), *law))
            slope = float(smoothed_reaction(depth, diameter, *law)[1])
            return _row(case, float(np.divide(depth, diameter)), depth, slope, None)
        curve_index = int(arrays.curve_index[case.element])
        found = arrays.curves[curve_index].ratios_at_force(case.weight) if curve_index >= 0 else ()
        ratio = next((each for each in found if each >= 0.0), None)
        if ratio is None:
            return _row(case, np.nan, np.nan, np.nan, None)
        curve = arrays.curves[curve_index]
        slope = float(curve.evaluate(ratio)[1])
        side = _SIDES[int(curve.extrapolated(ratio))]
        return _row(case, ratio, ratio * diameter, float(np.divide(slope, diameter)), side)


def _of_nodes(scene: Scene, weight: Floats) -> list[dict[str, Any]]:
    """The least and the most that a node with a spring of its own carries, by set."""
    if not scene.nodal.any() or (scene.element_nodes < 0).any():
        return []
    extension = scene.extensions["SEABED CONTACT"]
    ends, count = scene.element_nodes, len(scene.node_ids)
    springs = nodal_springs(scene)
    stiffness, zones = np.full(count, np.nan), _Zones.of(springs, count)
    stiffness[springs.rows] = springs.parameters["stiffness"]
    with np.errstate(all="ignore"):
        carried = summed(0.5 * weight * scene.length, ends, count)
        depth = penetration_under(carried, stiffness, *zones)
        slope = smoothed_reaction(depth, 0.0, stiffness, *zones)[1]
    rows = []
    for block in np.unique(extension.of_element[scene.nodal]).tolist():
        elements = np.flatnonzero(scene.nodal & (extension.of_element == block))
        nodes = np.unique(ends[elements])
        usable = nodes[(carried[nodes] > 0.0) & np.isfinite(depth[nodes])]
        order = usable[np.argsort(depth[usable], kind="stable")]
        for node in dict.fromkeys([*order[:1].tolist(), *order[-1:].tolist()]):
            at = int(elements[(ends[elements] == node).any(axis=1)][0])
            case = _Case(scene.law_sets[at], "nodal", float(weight[at]), at)
            ratio = float(np.divide(depth[node], scene.diameter[at]))
            rows.append(_row(case, ratio, float(depth[node]), float(slope[node]), None))
    return rows


def _row(case: _Case, ratio: float, penetration: float, stiffness: float, side: str | None) -> dict[str, Any]:
    return {
        "set": case.set_name,
        "weight": case.weight,
        "law": case.law,
        "ratio": finite(ratio),
        "penetration": finite(penetration),
        "stiffness": finite(stiffness),
        "extrapolated": side,
    }
