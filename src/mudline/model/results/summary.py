"""Contents of a deck in figures: counts, sets, curves, diameters, laws, static embedment."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mudline.basics.quantities import finite
from mudline.language.deck.loading import coverage_of, extent
from mudline.language.deck.model import Opaque
from mudline.language.keywords.model import Block
from mudline.model.contact.arrays import summed
from mudline.model.contact.input import LawAssignment, LawKind
from mudline.model.contact.laws.linear import penetration_under, smoothed_reaction
from mudline.model.scene.assignments import element_smoothing, nodal_springs
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.resolved import LawArrays
from mudline.model.scene.seabed import SeabedKind, SeabedShape
from mudline.model.scene.sheet import sheet_of
from mudline.model.scene.weights import contents, contents_case

CURVE_SIDES = {-1: "below", 0: None, 1: "above"}
"""Side of a curve on which a value is extrapolated; None between its points."""


def summarise(scene: Scene) -> dict[str, Any]:
    """Return sections, keywords, counts, sets, curves, diameters and laws of a deck."""
    deck, known, sheet = scene.deck, scene.length[~np.isnan(scene.length)], sheet_of(scene)
    return {
        "file": deck.file,
        "units": deck.units,
        "continues": [base.deck.file for base in deck.bases],
        "sections": [
            {"name": section.name, "keywords": [_keyword(block) for block in section.blocks]}
            for section in deck.own_sections
        ],
        "keywords": asdict(coverage_of(deck)),
        "nodes": len(scene.node_ids),
        "elements": len(scene.element_ids),
        "length": _sum(known) if known.size else None,
        "sets": _sets(scene),
        "curves": _curves(scene),
        "diameters": _diameters(scene),
        "laws": _laws(scene),
        "seabed": sorted(name.lower() for name in scene.laws.types),
        "floor": floor_summary(scene.seabed),
        "bed": bed_summary(scene),
        "extensions": extension_summary(scene),
        "static_embedment": static_embedment(scene),
        "sheet": list(sheet.rows),
        "weights_without": list(sheet.left_out),
        "contents_case": contents_case(scene),
    }


def _keyword(block: Block | Opaque) -> dict[str, Any]:
    """Return a keyword, whether its lines are read, and whether some of them were skipped."""
    coverage = extent(block)
    return {"keyword": block.keyword, "read": coverage != "unread", "partly": coverage == "partly"}


def _sum(lengths: NDArray[np.float64]) -> float | None:
    """Return the sum of lengths; None if it overflows, or a length is unknown."""
    with np.errstate(over="ignore", invalid="ignore"):
        return finite(float(lengths.sum()))


def _sets(scene: Scene) -> list[dict[str, Any]]:
    rows = []
    for entry in scene.set_table.named.values():
        count = len(entry.elements)
        length = _sum(scene.length[entry.elements]) if count else None
        rows.append({"name": entry.name, "elements": count, "length": length, "open": entry.open})
    return rows


def _curves(scene: Scene) -> list[dict[str, Any]]:
    rows = []
    for index, entry in enumerate(scene.laws.curves):
        curve = entry.curve
        rows.append(
            {
                "name": entry.name,
                "keyword": entry.keyword,
                "points": len(entry.points),
                "ratios": None if curve is None else [float(curve.ratios[0]), float(curve.ratios[-1])],
                "forces": None if curve is None else [float(curve.forces.min()), float(curve.forces.max())],
                "elements": len(scene.followers(index)),
                "open": any(grant.curve == index and grant.set_.open for grant in scene.laws.set_laws),
            }
        )
    return rows


def _diameters(scene: Scene) -> list[dict[str, Any]]:
    known = scene.diameter[~np.isnan(scene.diameter)]
    values, counts = np.unique(known, return_counts=True)
    rows = [
        {"diameter": value, "elements": count} for value, count in zip(values.tolist(), counts.tolist(), strict=True)
    ]
    missing = len(scene.diameter) - len(known)
    return [*rows, {"diameter": None, "elements": missing}] if missing else rows


def _laws(scene: Scene) -> list[dict[str, Any]]:
    """Return the laws with their numbers of elements, linear laws by stiffness; then laws of extension keywords."""
    rows: list[dict[str, Any]] = []
    own = scene.law == scene.laws_given
    for index, grant in enumerate(scene.laws.set_laws):
        count = int(((scene.laws.of_element == index) & own).sum())
        if count:
            law = scene.law_name(grant)
            stiffness = grant.stiffness if grant.kind is LawKind.LINEAR else None
            rows.append({"law": law, "set": grant.set_.name, "elements": count, "stiffness": stiffness})
    replaced = Counter((scene.law_names[at], scene.law_sets[at]) for at in np.flatnonzero(~own).tolist())
    rows += [{"law": law, "set": name, "elements": count, "stiffness": None} for (law, name), count in replaced.items()]
    free = int(((scene.laws.of_element < 0) & own).sum())
    return [*rows, {"law": "none", "set": None, "elements": free, "stiffness": None}] if free else rows


_PAIRS = ("friction", "mobilisation")
_SINGLE = ("lateral", "suction", "extent")


def floor_summary(seabed: SeabedShape) -> dict[str, Any]:
    """Return the shape of the seabed; null for values that its kind lacks."""
    slope = seabed.kind is SeabedKind.SLOPING
    from_points = seabed.kind in (SeabedKind.PROFILE, SeabedKind.SURFACE)
    return {
        "kind": seabed.kind.value,
        "slope": finite(seabed.slope) if slope else None,
        "direction": finite(seabed.direction) if slope or from_points else None,
        "interpolation": seabed.interpolation if from_points else None,
        "points": len(seabed.points) if from_points and not seabed.missing else None,
        "planes": len(seabed.planes) or None,
        "file": seabed.file or None,
        "missing": seabed.missing or None,
    }


def bed_summary(scene: Scene) -> list[dict[str, Any]]:
    """Return friction, mobilisation, lateral stiffness and suction by block, with the number of elements.

    Friction coefficients and mobilisation lengths are longitudinal and transverse. Blocks without any of these values
    are left out.
    """
    rows = []
    for index, (values, where) in enumerate(zip(scene.resistance.values, scene.resistance.places, strict=True)):
        pairs = {name: [finite(value) for value in getattr(values, name)] for name in _PAIRS}
        single = {name: finite(getattr(values, name)) for name in _SINGLE}
        if any(v is not None for v in (*single.values(), *(v for pair in pairs.values() for v in pair))):
            name = getattr(scene.deck.at(where), "set_name", None) or "ALL"
            rows.append({"set": name, "elements": int((scene.resistance.of_element == index).sum()), **pairs, **single})
    return rows


def extension_summary(scene: Scene) -> list[dict[str, Any]]:
    """Return the blocks of the extension keywords, with the number of elements that follow each."""
    return [
        {
            "keyword": keyword,
            "set": getattr(entry, "set_name", None),
            "elements": int((extension.of_element == index).sum()),
        }
        for keyword, extension in scene.extensions.items()
        for index, entry in enumerate(extension.entries)
    ]


# ------------------------------------------------------------------------------------------------ static embedment

_TABLE_ROWS = 100
"""Largest number of rows of a table."""


def static_embedment(scene: Scene) -> list[dict[str, Any]]:
    """Return a row for each set, law, weight per length and diameter of elements with known weight, up to 100 rows.

    Keys of a row:

    * `element`: the first element; of a row for a node, the first element that ends there;
    * `penetration`: depth at which the law, smoothed as evaluated, carries the weight; if a curve does so at several
      ratios, the smallest that is not negative;
    * `stiffness`: stiffness of the law there; for nodal laws Kn, force per length;
    * `filled`: whether contents are included. If the last load case fills pipes, there are rows of all elements without
      contents, and of those that have contents.

    For nodal laws there is a row for the node that carries least and one for the node that carries most.
    """
    weights = [scene.submerged_weight]
    if (inside := contents(scene)) and inside[-1].mass.any():
        weights.append(scene.submerged_weight + inside[-1].mass * scene.surroundings.gravity)
    own = np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR))
    smoothing = element_smoothing(scene) if "SEABED CONTACT" in scene.extensions else None
    arrays, zones = scene.law_arrays(), _zones(smoothing, len(scene.element_ids))
    rows = []
    for filled, weight in enumerate(weights):
        known = np.flatnonzero((weight > 0.0) & own & ((weight != weights[0]) | (not filled)))
        for at in _unlike(scene, weight, zones, known):
            row = _row(scene, at, weight, scene.law_names[at], filled=bool(filled))
            rows.append(row | _of_element(scene, arrays, zones, at, float(weight[at])))
        rows += _of_nodes(scene, weight, filled=bool(filled))
    return rows[:_TABLE_ROWS]


def _zones(law: LawAssignment | None, count: int) -> Floats:
    """Return the quadratic zones (2, count) of all elements or nodes: half widths, and 1 if only below the mudline."""
    zones = np.zeros((2, count))
    if law is not None:
        zones[0, law.rows] = law.parameters["half_width"]
        zones[1, law.rows] = law.parameters["one_sided"]
    return zones


def _unlike(scene: Scene, weight: Floats, zones: Floats, elements: Indices) -> list[int]:
    """Return the first of the elements that share a law, a weight per length and a diameter."""
    if not elements.size:
        return []
    sizes = np.nan_to_num(scene.diameter[elements])
    keys = np.column_stack([scene.laws.of_element[elements], weight[elements], sizes, *zones[:, elements]])
    begins = np.flatnonzero(np.append(True, (keys[1:] != keys[:-1]).any(axis=1)))
    firsts = np.sort(np.unique(keys[begins], axis=0, return_index=True)[1])[:_TABLE_ROWS]
    shown: list[int] = elements[begins[firsts]].tolist()
    return shown


def _of_element(scene: Scene, arrays: LawArrays, zones: Floats, at: int, weight: float) -> dict[str, Any]:
    diameter = float(scene.diameter[at])
    with np.errstate(all="ignore"):
        if scene.law[at] == LawKind.LINEAR:
            law = float(arrays.linear_stiffness[at]), *zones[:, at]
            depth = float(penetration_under(np.float64(weight), *law))
            slope = float(smoothed_reaction(depth, diameter, *law)[1])
            return _embedment(float(np.divide(depth, diameter)), depth, slope)
        curve_index = int(arrays.curve_index[at])
        ratios = arrays.curves[curve_index].ratios_at_force(weight) if curve_index >= 0 else ()
        ratio = next((each for each in ratios if each >= 0.0), None)
        if ratio is None:
            return _embedment(np.nan, np.nan, np.nan)
        curve = arrays.curves[curve_index]
        slope = float(curve.evaluate(ratio)[1])
        side = CURVE_SIDES[int(curve.extrapolated(ratio))]
        return _embedment(ratio, ratio * diameter, float(np.divide(slope, diameter)), side)


def _of_nodes(scene: Scene, weight: Floats, *, filled: bool) -> list[dict[str, Any]]:
    """Return rows for the least and the most loaded node with a spring of its own, by set."""
    if not scene.nodal.any() or (scene.element_nodes < 0).any():
        return []
    extension = scene.extensions["SEABED CONTACT"]
    ends, count = scene.element_nodes, len(scene.node_ids)
    springs = nodal_springs(scene)
    stiffness, zones = np.full(count, np.nan), _zones(springs, count)
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
            ratio = float(np.divide(depth[node], scene.diameter[at]))
            row = _row(scene, at, weight, "nodal", filled=filled)
            rows.append(row | _embedment(ratio, float(depth[node]), float(slope[node])))
    return rows


def _row(scene: Scene, at: int, weight: Floats, law: str, *, filled: bool) -> dict[str, Any]:
    element, value = int(scene.element_ids[at]), float(weight[at])
    return {"set": scene.law_sets[at], "element": element, "filled": filled, "weight": value, "law": law}


def _embedment(ratio: float, penetration: float, stiffness: float, side: str | None = None) -> dict[str, Any]:
    return {
        "ratio": finite(ratio),
        "penetration": finite(penetration),
        "stiffness": finite(stiffness),
        "extrapolated": side,
    }
