"""`*SEABED SUCTION`: the laws of the elements, in the deck's units."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.input import LawAssignment, LawKind
from mudline.contact.laws.suction import SuctionFactors, SuctionLaw, from_cohesion
from mudline.scene.contact_parts.picking import picked
from mudline.scene.contact_parts.units import FORCE_UNIT, LENGTH_UNIT
from mudline.scene.given import number
from mudline.scene.numbering import Floats, Indices

if TYPE_CHECKING:
    from mudline.keywords.library.seabed_suction import SuctionSet
    from mudline.scene.extensions import Extension
    from mudline.scene.model import Scene

KEYWORD = "SEABED SUCTION"
_CORNERS = (0.2, 0.8)
_SLOWEST = 1e-3
"""Default of REGULARISATION=, m/s."""


def element_suction(scene: Scene) -> LawAssignment:
    """The laws of the elements on an elastic seabed."""
    extension = scene.extensions[KEYWORD]
    elements = np.flatnonzero((extension.of_element >= 0) & (scene.law != LawKind.RIGID))
    if not elements.size:
        return LawAssignment("suction", elements, dict.fromkeys(SuctionLaw._fields, 0.0))
    return LawAssignment("suction", elements, suction_law(scene, extension, elements)._asdict())


def suction_law(scene: Scene, extension: Extension, elements: Indices) -> SuctionLaw:
    """What the blocks that some elements (k,) follow say, as it is; NaN for what they leave open."""
    block = extension.of_element[elements]
    length_unit = LENGTH_UNIT.get(scene.units, math.nan)
    corners = [[number(getattr(e, "cutoff", None), n) for e in extension.entries] for n in ("first", "second")]
    first, second = (picked(column, block) for column in corners)
    return SuctionLaw(
        *_factors(scene, extension, elements, block),
        first_corner=np.where(np.isnan(first), _CORNERS[0], first),
        second_corner=np.where(np.isnan(second), _CORNERS[1], second),
        cyclic=picked((_cyclic(e)[0] for e in extension.entries), block),
        regularisation=picked((number(e, "regularisation", _SLOWEST / length_unit) for e in extension.entries), block),
        cyclic_floor=picked((_cyclic(e)[1] for e in extension.entries), block),
    )


def _cyclic(entry: object) -> tuple[float, float]:
    """Factor and floor of CYCLIC=; the floor is NaN where there is none."""
    given = cast("SuctionSet", entry).cyclic
    return number(given, "factor", number(entry, "cyclic", 1.0)), number(given, "floor")


def _factors(scene: Scene, extension: Extension, elements: Indices, block: Indices) -> SuctionFactors:
    """The power laws: explicit ones, else those that follow from cohesion and diameter."""
    diameter = scene.diameter[elements]
    cohesion = picked((number(entry, "cohesion") for entry in extension.entries), block)
    units = LENGTH_UNIT.get(scene.units, 1.0), FORCE_UNIT.get(scene.units, 1.0)
    computed = from_cohesion(cohesion, np.where(np.isnan(cohesion), np.nan, diameter), *units)
    given = [
        picked((number(getattr(entry, law, None), name) for entry in extension.entries), block)
        for law, name in (("force", "factor"), ("force", "exponent"), ("depth", "factor"), ("depth", "exponent"))
    ]
    chosen: list[Floats] = [np.where(np.isnan(own), other, own) for own, other in zip(given, computed, strict=True)]
    return SuctionFactors(*chosen)
