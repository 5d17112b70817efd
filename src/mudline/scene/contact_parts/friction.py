"""Friction of the nodes: `*SEABED FRICTION`, else `FRICTION=` of `*SEABED PROPERTIES` or of the legacy surface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.input import LawAssignment, LawKind
from mudline.scene.contact_parts.picking import at_nodes, marked, picked, touched
from mudline.scene.contact_parts.units import LARGEST_MOBILISATION
from mudline.scene.given import number
from mudline.scene.numbering import Floats, Indices, Mask

if TYPE_CHECKING:
    from mudline.scene.extensions import Extension
    from mudline.scene.model import Scene

KEYWORD = "SEABED FRICTION"
_PAIR = ("first", "second")


@dataclass(frozen=True, slots=True, eq=False)
class _Springs:
    """Coefficients, constant springs and mobilisation lengths (n, 2); NaN where there is none."""

    coefficients: Floats
    stiffness: Floats
    mobilisation: Floats


def node_friction(scene: Scene, lateral: Indices) -> LawAssignment:
    """The friction of the nodes that have any.

    Nodes of elements with a lateral spring (`lateral` (k,)) have no transverse coefficient; nodes of a rigid seabed
    have no friction, as their normal reaction is that of a constraint.
    """
    ends, count = scene.element_nodes, len(scene.node_ids)
    springs = _of_properties(scene)
    active = (springs.coefficients > 0.0).any(axis=1)
    ellipse, angle = np.zeros(count, dtype=np.bool_), np.full(count, np.nan)
    extension = scene.extensions.get(KEYWORD)
    if extension is not None:
        block = at_nodes(extension.of_element, ends, count)
        here = block >= 0
        springs = _replaced(springs, _of_keyword(extension, block), here)
        active = active | here
        ellipse = marked((getattr(entry, "criterion", None) == "ELLIPSE" for entry in extension.entries), block)
        angle = picked((number(entry, "directions") for entry in extension.entries), block)
    springs.coefficients[np.unique(ends[lateral]), 1] = 0.0
    rows = np.flatnonzero(active & ~touched(scene.law == LawKind.RIGID, ends, count))
    parameters = {"elliptic": ellipse[rows], "angle": angle[rows]}
    for side, name in enumerate(("axial", "lateral")):
        parameters[f"{name}_coefficient"] = np.nan_to_num(springs.coefficients[rows, side])
        parameters[f"{name}_stiffness"] = springs.stiffness[rows, side]
        parameters[f"{name}_mobilisation"] = springs.mobilisation[rows, side]
    return LawAssignment("friction", rows, parameters)


def _of_properties(scene: Scene) -> _Springs:
    """Springs by mobilisation length; the default at a node is the least of its elements' lengths, up to a largest."""
    ends, count = scene.element_nodes, len(scene.node_ids)
    block = at_nodes(scene.bed.of_element, ends, count)
    given = {
        name: np.array([*(getattr(entry, name) for entry in scene.bed.values), (np.nan, np.nan)])[block]
        for name in ("friction", "mobilisation", "characteristic")
    }
    largest = np.fmin(given["characteristic"], np.inf)
    largest = np.where(np.isinf(largest), LARGEST_MOBILISATION.get(scene.units, np.inf), largest)
    default = np.fmin(_shortest(scene)[:, None], largest)
    length = np.where(given["mobilisation"] > 0.0, given["mobilisation"], default)
    return _Springs(given["friction"], np.full((count, 2), np.nan), np.where(np.isfinite(length), length, np.nan))


def _shortest(scene: Scene) -> Floats:
    """The least length of each node's elements; infinite where none is above 0."""
    shortest = np.full(len(scene.node_ids), np.inf)
    usable = np.isfinite(scene.length) & (scene.length > 0.0)
    for end in scene.element_nodes[usable].T:
        np.minimum.at(shortest, end, scene.length[usable])
    return shortest


def _of_keyword(extension: Extension, block: Indices) -> _Springs:
    columns = [
        [picked((number(getattr(entry, part, None), name) for entry in extension.entries), block) for name in _PAIR]
        for part in ("coefficients", "stiffness")
    ]
    coefficients, stiffness = (np.column_stack(pair) for pair in columns)
    stiffness[:, 1] = np.where(np.isnan(stiffness[:, 1]), stiffness[:, 0], stiffness[:, 1])
    return _Springs(coefficients, stiffness, np.full(stiffness.shape, np.nan))


def _replaced(springs: _Springs, other: _Springs, where: Mask) -> _Springs:
    at = where[:, None]
    return _Springs(
        np.where(at, other.coefficients, springs.coefficients),
        np.where(at, other.stiffness, springs.stiffness),
        np.where(at, other.mobilisation, springs.mobilisation),
    )
