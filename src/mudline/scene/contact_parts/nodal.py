"""`NODAL STIFFNESS=` of `*SEABED CONTACT`: springs of single nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.input import LawAssignment, LawKind
from mudline.scene.contact_parts.picking import at_nodes, marked, picked
from mudline.scene.contact_parts.smoothing import KEYWORD, half_width, one_sided, static_nodal
from mudline.scene.given import number
from mudline.scene.numbering import Floats, Indices

if TYPE_CHECKING:
    from mudline.scene.extensions import Extension
    from mudline.scene.model import Scene


def nodal_blocks(scene: Scene, extension: Extension) -> Indices:
    """The block that gives each node (n,) its stiffness: the last one that one of its nodal elements follows, or -1."""
    of_element = np.where(scene.law == LawKind.NODAL, extension.of_element, -1)
    return at_nodes(of_element, scene.element_nodes, len(scene.node_ids))


def nodal_stiffness(scene: Scene, extension: Extension) -> Floats:
    """Kn of each node (n,), force per length; NaN for nodes of which no element has a nodal law."""
    stiffness = (number(entry, "nodal_stiffness") for entry in extension.entries)
    return picked(stiffness, nodal_blocks(scene, extension))


def nodal_springs(scene: Scene) -> LawAssignment:
    """The springs of the nodes, with their quadratic zones."""
    extension = scene.extensions[KEYWORD]
    block = nodal_blocks(scene, extension)
    stiffness = nodal_stiffness(scene, extension)
    penetration, diameter = static_nodal(scene, stiffness)
    width = half_width(extension, block, penetration, diameter)
    rows = np.flatnonzero(~np.isnan(stiffness))
    sides = marked(map(one_sided, extension.entries), block)
    return LawAssignment(
        "nodal", rows, {"stiffness": stiffness[rows], "half_width": width[rows], "one_sided": sides[rows]}
    )
