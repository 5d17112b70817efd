"""Static embedment: how deep the submerged weight alone presses the elements of each set into its law."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from mudline.contact.inputs import LawKind
from mudline.results.numbers import finite
from mudline.scene.contact_parts.nodal import nodal_stiffness
from mudline.scene.contact_parts.picking import summed
from mudline.scene.model import LawArrays, Scene
from mudline.scene.numbering import Floats, Indices
from mudline.scene.section_weight import submerged_weight

_SIDES = {-1: "below", 0: None, 1: "above"}
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

    `penetration` is where the law carries the weight, `stiffness` that of the law there. Of a curve that does so at
    several ratios it is the smallest that is not negative. For nodal laws there is a row for the node that carries
    least and one for the node that carries most; `stiffness` is then Kn, force per length.
    """
    weight = submerged_weight(scene)
    known = np.flatnonzero((weight > 0.0) & np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR)))
    arrays = scene.law_arrays()
    rows = [_of_element(scene, arrays, case) for case in _cases(scene, weight, known)]
    return [*rows, *_of_nodes(scene, weight)][:_MOST]


def _cases(scene: Scene, weight: Floats, elements: Indices) -> list[_Case]:
    if not elements.size:
        return []
    sizes = np.nan_to_num(scene.diameter[elements])
    keys = np.column_stack([scene.laws.of_element[elements], weight[elements], sizes])
    firsts = np.sort(np.unique(keys, axis=0, return_index=True)[1])[:_MOST]
    found = elements[firsts].tolist()
    return [_Case(scene.law_sets[at], scene.law_names[at], float(weight[at]), at) for at in found]


def _of_element(scene: Scene, arrays: LawArrays, case: _Case) -> dict[str, Any]:
    diameter = float(scene.diameter[case.element])
    with np.errstate(all="ignore"):
        if scene.law[case.element] == LawKind.LINEAR:
            stiffness = float(arrays.linear_stiffness[case.element])
            depth = float(np.divide(case.weight, stiffness))
            return _row(case, float(np.divide(depth, diameter)), depth, stiffness, None)
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
    stiffness = nodal_stiffness(scene, extension)
    with np.errstate(all="ignore"):
        carried = summed(0.5 * weight * scene.length, ends, count)
        depth = carried / stiffness
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
            rows.append(_row(case, ratio, float(depth[node]), float(stiffness[node]), None))
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
