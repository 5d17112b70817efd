"""Quadratic zones of linear laws: `SMOOTHING=` and `FORM=` of `*SEABED CONTACT`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.input import LawAssignment, LawKind
from mudline.contact.laws.linear import automatic_half_width
from mudline.scene.contact_parts.picking import marked, picked, summed
from mudline.scene.given import number
from mudline.scene.numbering import Floats, Indices, Mask
from mudline.scene.section_weight import submerged_weight

if TYPE_CHECKING:
    from mudline.scene.extensions import Extension
    from mudline.scene.model import Scene

KEYWORD = "SEABED CONTACT"


def is_auto(entry: object) -> bool:
    """Whether a block leaves the width to the static penetration; that is the default."""
    return getattr(entry, "smoothing", None) in (None, "AUTO")


def one_sided(entry: object) -> bool:
    """Whether the zone of a block lies below the bed only."""
    return getattr(entry, "form", None) == "ONE-SIDED"


def half_width(extension: Extension, block: Indices, penetration: Floats, diameter: Floats) -> Floats:
    """Half widths h of the points that follow each `block` (-1: none), from static penetrations Z and diameters D.

    The number that is given, else that of AUTO, without a diameter from Z alone; 0 for NONE.
    """
    given = picked((number(entry, "smoothing", 0.0) for entry in extension.entries), block)
    reckoned = automatic_half_width(penetration, np.where(np.isnan(diameter), np.inf, diameter))
    reckoned = np.where(np.isfinite(reckoned), reckoned, 0.0)
    width: Floats = np.where(marked(map(is_auto, extension.entries), block), reckoned, given)
    return np.where(block >= 0, width, 0.0)


def static_linear(scene: Scene) -> Floats:
    """Static penetration W / k of the elements (m,) with a linear law; NaN or infinite where there is none."""
    with np.errstate(all="ignore"):
        penetration: Floats = submerged_weight(scene) / scene.law_arrays().linear_stiffness
    return penetration


def static_nodal(scene: Scene, stiffness: Floats) -> tuple[Floats, Floats]:
    """Static penetrations W L_t / Kn of the nodes (n,), and the diameters that go with them.

    W L_t is half of the weight of each of a node's elements, its diameter the mean of theirs.
    """
    ends, count = scene.element_nodes, len(scene.node_ids)
    known = ~np.isnan(scene.diameter)
    with np.errstate(all="ignore"):
        carried = summed(0.5 * submerged_weight(scene) * scene.length, ends, count)
        sizes = summed(np.where(known, scene.diameter, 0.0), ends, count)
        return carried / stiffness, sizes / summed(known.astype(np.float64), ends, count)


def element_smoothing(scene: Scene) -> LawAssignment:
    """The elements with a linear law that have a quadratic zone."""
    extension = scene.extensions[KEYWORD]
    block = np.where(scene.law == LawKind.LINEAR, extension.of_element, -1)
    width = half_width(extension, block, static_linear(scene), scene.diameter)
    rows = np.flatnonzero(width > 0.0)
    parameters = {
        "stiffness": scene.law_arrays().linear_stiffness[rows],
        "half_width": width[rows],
        "one_sided": marked(map(one_sided, extension.entries), block)[rows],
    }
    return LawAssignment("smoothed", rows, parameters)


def weightless(scene: Scene) -> int:
    """How many elements leave the width to a weight that is not known or not above 0, and so are not smoothed."""
    extension = scene.extensions[KEYWORD]
    auto = marked(map(is_auto, extension.entries), extension.of_element)
    held: Mask = auto & np.isin(scene.law, (LawKind.LINEAR, LawKind.NODAL))
    return int((held & ~(submerged_weight(scene) > 0.0)).sum())
