"""Normal laws of the extension keywords: smoothing, nodal stiffness, unloading and suction."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.input import LawAssignment, LawKind
from mudline.scene.deck_values import FORCE_UNIT, LENGTH_UNIT, number
from mudline.scene.extensions import Extension
from mudline.scene.numbering import Floats, Indices, Mask, at_nodes, marked, picked, summed
from mudline.scene.resolved import ResolvedDeck
from mudline.scene.section_weight import submerged_weight

if TYPE_CHECKING:
    from mudline.contact.laws.suction import SuctionLaw
    from mudline.keywords.library.seabed_suction import SuctionSet

_CORNERS = (0.2, 0.8)
_SLOWEST = 1e-3
"""Default of REGULARISATION=, m/s."""


def element_smoothing(scene: ResolvedDeck) -> LawAssignment:
    """The elements with a linear law that have a quadratic zone (`SMOOTHING=` and `FORM=` of `*SEABED CONTACT`)."""
    extension = scene.extensions["SEABED CONTACT"]
    block = np.where(scene.law == LawKind.LINEAR, extension.of_element, -1)
    stiffness = scene.law_arrays().linear_stiffness
    with np.errstate(all="ignore"):
        penetration = submerged_weight(scene) / stiffness
    width = _half_width(extension, block, penetration, scene.diameter)
    rows = np.flatnonzero(width > 0.0)
    sides = _one_sided(extension, block)
    return LawAssignment(
        "smoothed", rows, {"stiffness": stiffness[rows], "half_width": width[rows], "one_sided": sides[rows]}
    )


def _half_width(extension: Extension, block: Indices, penetration: Floats, diameter: Floats) -> Floats:
    """Half widths h of the points that follow each `block` (-1: none), from static penetrations Z and diameters D.

    The number that is given, else that of AUTO, without a diameter from Z alone; 0 for NONE.
    """
    from mudline.contact.laws.linear import automatic_half_width  # noqa: PLC0415 - only now is it needed

    automatic = automatic_half_width(penetration, np.where(np.isnan(diameter), np.inf, diameter))
    automatic = np.where(np.isfinite(automatic), automatic, 0.0)
    given = extension.values(block, "smoothing", default=0.0)
    width: Floats = np.where(_is_auto(extension, block), automatic, given)
    return np.where(block >= 0, width, 0.0)


def _is_auto(extension: Extension, block: Indices) -> Mask:
    """Whether each block leaves the width to the static penetration; that is the default."""
    return marked((getattr(entry, "smoothing", None) in (None, "AUTO") for entry in extension.entries), block)


def _one_sided(extension: Extension, block: Indices) -> Mask:
    """Whether the zone of each block lies below the seabed only."""
    return marked((getattr(entry, "form", None) == "ONE-SIDED" for entry in extension.entries), block)


def weightless(scene: ResolvedDeck) -> int:
    """How many elements leave the width to a weight that is not known or not above 0, and so are not smoothed."""
    extension = scene.extensions["SEABED CONTACT"]
    auto = _is_auto(extension, extension.of_element) & np.isin(scene.law, (LawKind.LINEAR, LawKind.NODAL))
    return int((auto & ~(submerged_weight(scene) > 0.0)).sum())


def nodal_springs(scene: ResolvedDeck) -> LawAssignment:
    """The springs of the nodes (`NODAL STIFFNESS=` of `*SEABED CONTACT`), with their quadratic zones."""
    extension = scene.extensions["SEABED CONTACT"]
    block = _nodal_blocks(scene, extension)
    stiffness = nodal_stiffness(scene, extension)
    width = _half_width(extension, block, *_static_at_nodes(scene, stiffness))
    rows = np.flatnonzero(~np.isnan(stiffness))
    sides = _one_sided(extension, block)
    return LawAssignment(
        "nodal", rows, {"stiffness": stiffness[rows], "half_width": width[rows], "one_sided": sides[rows]}
    )


def nodal_stiffness(scene: ResolvedDeck, extension: Extension) -> Floats:
    """Kn of each node (n,), force per length; NaN for nodes of which no element has a nodal law."""
    return extension.values(_nodal_blocks(scene, extension), "nodal_stiffness")


def _nodal_blocks(scene: ResolvedDeck, extension: Extension) -> Indices:
    """The block that gives each node (n,) its stiffness: the last one that one of its nodal elements follows, or -1."""
    of_element = np.where(scene.law == LawKind.NODAL, extension.of_element, -1)
    return at_nodes(of_element, scene.element_nodes, len(scene.node_ids))


def _static_at_nodes(scene: ResolvedDeck, stiffness: Floats) -> tuple[Floats, Floats]:
    """Static penetrations W L_t / Kn of the nodes (n,), and the diameters that go with them.

    W L_t is half of the weight of each of a node's elements, its diameter the mean of theirs.
    """
    ends, count = scene.element_nodes, len(scene.node_ids)
    known = ~np.isnan(scene.diameter)
    with np.errstate(all="ignore"):
        carried = summed(0.5 * submerged_weight(scene) * scene.length, ends, count)
        sizes = summed(np.where(known, scene.diameter, 0.0), ends, count)
        return carried / stiffness, sizes / summed(known.astype(np.float64), ends, count)


def unloading_lines(scene: ResolvedDeck) -> LawAssignment:
    """The elements on a curve or a linear law that unload on a line of their own (`*SEABED UNLOADING`)."""
    extension = scene.extensions["SEABED UNLOADING"]
    rows = np.flatnonzero((extension.of_element >= 0) & np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR)))
    return LawAssignment("unloading", rows, {"stiffness": given_stiffness(extension)[rows]})


def given_stiffness(extension: Extension) -> Floats:
    """The stiffness of the block that each element (m,) follows, NaN without one."""
    return extension.values(extension.of_element, "stiffness")


def element_suction(scene: ResolvedDeck) -> LawAssignment:
    """The suction laws of the elements on an elastic seabed (`*SEABED SUCTION`)."""
    extension = scene.extensions["SEABED SUCTION"]
    elements = np.flatnonzero((extension.of_element >= 0) & (scene.law != LawKind.RIGID))
    return LawAssignment("suction", elements, suction_law(scene, extension, elements)._asdict())


def suction_law(scene: ResolvedDeck, extension: Extension, elements: Indices) -> SuctionLaw:
    """What the blocks that some elements (k,) follow say, in the deck's units; NaN for what they leave open.

    The power laws are the explicit ones, else those that follow from cohesion and diameter.
    """
    from mudline.contact.laws.suction import SuctionFactors, SuctionLaw, from_cohesion  # noqa: PLC0415 - only now is it needed

    block = extension.of_element[elements]
    cohesion = extension.values(block, "cohesion")
    diameter = np.where(np.isnan(cohesion), np.nan, scene.diameter[elements])
    units = LENGTH_UNIT.get(scene.units, 1.0), FORCE_UNIT.get(scene.units, 1.0)
    computed = from_cohesion(cohesion, diameter, *units)
    given = [extension.values(block, law, name) for law in ("force", "depth") for name in ("factor", "exponent")]
    factors = (np.where(np.isnan(own), other, own) for own, other in zip(given, computed, strict=True))
    first, second = (extension.values(block, "cutoff", name) for name in ("first", "second"))
    slowest = _SLOWEST / LENGTH_UNIT.get(scene.units, math.nan)
    return SuctionLaw(
        *SuctionFactors(*factors),
        first_corner=np.where(np.isnan(first), _CORNERS[0], first),
        second_corner=np.where(np.isnan(second), _CORNERS[1], second),
        cyclic=picked((_cyclic(entry)[0] for entry in extension.entries), block),
        regularisation=extension.values(block, "regularisation", default=slowest),
        cyclic_floor=picked((_cyclic(entry)[1] for entry in extension.entries), block),
    )


def _cyclic(entry: object) -> tuple[float, float]:
    """Factor and floor of CYCLIC=; the floor is NaN where there is none."""
    given = cast("SuctionSet", entry).cyclic
    return number(given, "factor", number(entry, "cyclic", 1.0)), number(given, "floor")
