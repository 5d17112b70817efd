"""Friction of the nodes, and the trenches that elements lie in."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.input import LawAssignment, LawKind
from mudline.scene.deck_values import LARGEST_MOBILISATION
from mudline.scene.numbering import Floats, Indices, at_nodes, marked, touched

if TYPE_CHECKING:
    from mudline.keywords.library.seabed_trench import TrenchSet
    from mudline.scene.extensions import Extension
    from mudline.scene.resolved import ResolvedDeck

_LINE = (("start_y", "y0"), ("start_z", "z0"), ("end_y", "y1"), ("end_z", "z1"))


def node_friction(scene: ResolvedDeck, lateral: Indices) -> LawAssignment:
    """The friction of the nodes that have any.

    Nodes of elements with a lateral spring (`lateral` (k,)) have no transverse coefficient; nodes of a rigid seabed
    have no friction, as their normal reaction is that of a constraint.
    """
    ends, count = scene.element_nodes, len(scene.node_ids)
    springs = _of_properties(scene)
    active = (springs[0] > 0.0).any(axis=1)
    ellipse, angle = np.zeros(count, dtype=np.bool_), np.full(count, np.nan)
    extension = scene.extensions.get("SEABED FRICTION")
    if extension is not None:
        block = at_nodes(extension.of_element, ends, count)
        here = block >= 0
        springs = np.where(here[:, None], _of_keyword(extension, block), springs)
        active = active | here
        ellipse = marked((getattr(entry, "criterion", None) == "ELLIPSE" for entry in extension.entries), block)
        angle = extension.values(block, "directions")
    coefficients, stiffness, mobilisation = springs
    coefficients[np.unique(ends[lateral]), 1] = 0.0
    rows = np.flatnonzero(active & ~touched(scene.law == LawKind.RIGID, ends, count))
    parameters = {"elliptic": ellipse[rows], "angle": angle[rows]}
    for side, name in enumerate(("axial", "lateral")):
        parameters[f"{name}_coefficient"] = np.nan_to_num(coefficients[rows, side])
        parameters[f"{name}_stiffness"] = stiffness[rows, side]
        parameters[f"{name}_mobilisation"] = mobilisation[rows, side]
    return LawAssignment("friction", rows, parameters)


def _of_properties(scene: ResolvedDeck) -> Floats:
    """Coefficients, constant springs and mobilisation lengths (3, n, 2) by `FRICTION=`; NaN where there is none.

    The default length at a node is the least of its elements' lengths, up to a largest.
    """
    ends, count = scene.element_nodes, len(scene.node_ids)
    block = at_nodes(scene.resistance.of_element, ends, count)
    given = {
        name: np.array([*(getattr(entry, name) for entry in scene.resistance.values), (np.nan, np.nan)])[block]
        for name in ("friction", "mobilisation", "characteristic")
    }
    largest = np.fmin(given["characteristic"], np.inf)
    largest = np.where(np.isinf(largest), LARGEST_MOBILISATION.get(scene.units, np.inf), largest)
    default = np.fmin(_shortest(scene)[:, None], largest)
    length = np.where(given["mobilisation"] > 0.0, given["mobilisation"], default)
    return np.stack([given["friction"], np.full((count, 2), np.nan), np.where(np.isfinite(length), length, np.nan)])


def _shortest(scene: ResolvedDeck) -> Floats:
    """The least length of each node's elements; infinite where none is above 0."""
    shortest = np.full(len(scene.node_ids), np.inf)
    usable = np.isfinite(scene.length) & (scene.length > 0.0)
    for end in scene.element_nodes[usable].T:
        np.minimum.at(shortest, end, scene.length[usable])
    return shortest


def _of_keyword(extension: Extension, block: Indices) -> Floats:
    """As `_of_properties`, by `*SEABED FRICTION`: springs are given, and have no mobilisation length."""
    coefficients, stiffness = (
        np.column_stack([extension.values(block, part, name) for name in ("first", "second")])
        for part in ("coefficients", "stiffness")
    )
    stiffness[:, 1] = np.where(np.isnan(stiffness[:, 1]), stiffness[:, 0], stiffness[:, 1])
    return np.stack([coefficients, stiffness, np.full(stiffness.shape, np.nan)])


def trenches(scene: ResolvedDeck) -> list[LawAssignment]:
    """The elements in trenches with a peak resistance, a tabulated one, or sloped walls."""
    extension = scene.extensions["SEABED TRENCH"]
    entries = _trench_sets(scene)
    if not (extension.of_element >= 0).any():
        return []
    walls = np.array([entry.model == "WALL" for entry in entries])
    tabulated = np.array([_has_table(entry) for entry in entries])
    table = np.cumsum(tabulated) - 1.0
    found = []
    for law, blocks, name in (
        ("trench peak", ~walls & ~tabulated, "peak"),
        ("trench table", tabulated, "table"),
        ("trench wall", walls, "depth"),
    ):
        rows = np.flatnonzero((extension.of_element >= 0) & blocks[extension.of_element])
        block = extension.of_element[rows]
        path = ("geometry", "depth") if name == "depth" else ("peak",)
        parameters = {
            "bottom": extension.values(block, "geometry", "bottom_width"),
            "upper": extension.values(block, "geometry", "upper_width"),
            name: table[block] if name == "table" else extension.values(block, *path),
            **{ours: extension.values(block, "centreline", theirs) for ours, theirs in _LINE},
        }
        found.append(LawAssignment(law, rows, parameters))
    return found


def resistance_tables(scene: ResolvedDeck) -> list[Floats]:
    """The tables (k, 2) of the blocks that have one, in their order."""
    return [entry.table.values for entry in _trench_sets(scene) if _has_table(entry) and entry.table is not None]


def _has_table(entry: TrenchSet) -> bool:
    return entry.model != "WALL" and entry.peak == "TABLE"


def _trench_sets(scene: ResolvedDeck) -> list[TrenchSet]:
    return cast("list[TrenchSet]", scene.extensions["SEABED TRENCH"].entries)
