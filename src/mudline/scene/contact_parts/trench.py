"""`*SEABED TRENCH`: the trenches of the nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.extras import NodeFriction, NodeTrench
from mudline.contact.friction.trench import TrenchLaw
from mudline.scene.contact_parts.picking import at_nodes, picked, refuse, refuse_entry
from mudline.scene.given import number
from mudline.scene.numbering import Floats, Indices

if TYPE_CHECKING:
    from mudline.scene.extensions import Extension
    from mudline.scene.model import Scene

KEYWORD = "SEABED TRENCH"


def node_trench(scene: Scene, friction: NodeFriction | None) -> NodeTrench | None:
    """Widths and peak forces of the nodes; None where no element lies in a trench.

    A node's peak counts half of the lengths of those of its elements that follow the node's own block.

    Raises RefusedError: a geometry that is none, or elements without a lateral friction spring.
    """
    extension = scene.extensions[KEYWORD]
    _check_geometry(extension)
    if not (extension.of_element >= 0).any():
        return None
    ends, count = scene.element_nodes, len(scene.node_ids)
    block = at_nodes(extension.of_element, ends, count)
    _check_springs(scene, extension, block, friction)
    geometry = [getattr(entry, "geometry", None) for entry in extension.entries]
    peak = picked((number(entry, "peak") for entry in extension.entries), block)
    law = TrenchLaw(
        picked((number(each, "bottom_width") for each in geometry), block),
        picked((number(each, "upper_width") for each in geometry), block),
        peak * _lengths(scene, extension, block),
    )
    lines = [getattr(entry, "centreline", None) for entry in extension.entries]
    straight = [picked((number(line, name) for line in lines), block) for name in ("y0", "z0", "y1", "z1")]
    return NodeTrench(law, np.column_stack(straight))


def _check_geometry(extension: Extension) -> None:
    for entry, where in zip(extension.entries, extension.places, strict=True):
        geometry, line = getattr(entry, "geometry", None), getattr(entry, "centreline", None)
        bottom, upper = number(geometry, "bottom_width"), number(geometry, "upper_width")
        if not 0.0 < bottom < upper:
            refuse_entry(where, "geometry", "the widths of the trench must be above 0, the upper one larger")
        if all(number(line, f"{axis}0") == number(line, f"{axis}1") for axis in "yz"):
            refuse_entry(where, "centreline", "the two points of the centreline are one")


def _check_springs(scene: Scene, extension: Extension, block: Indices, friction: NodeFriction | None) -> None:
    """A trench raises the limit of a lateral spring, so there must be one."""
    bare = block >= 0
    if friction is not None:
        law = friction.law
        bare = bare & ~(law.active & (law.constant[:, 1] | (law.coefficients[:, 1] > 0.0)))
    elements = (extension.of_element >= 0) & bare[scene.element_nodes].any(axis=1)
    refuse(extension, elements, scene.element_ids, "a trench needs a lateral friction spring: give *SEABED FRICTION")


def _lengths(scene: Scene, extension: Extension, block: Indices) -> Floats:
    """Half of the lengths of a node's elements that follow its block."""
    total = np.zeros(len(block))
    half = 0.5 * np.where(np.isfinite(scene.length), scene.length, 0.0)
    for end in scene.element_nodes.T:
        same = extension.of_element == block[end]
        np.add.at(total, end[same], half[same])
    return total
