"""`*SEABED SUCTION`: the laws of the elements, in the deck's units."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.input import LawAssignment, LawKind
from mudline.contact.laws.suction import SuctionFactors, SuctionLaw, from_cohesion
from mudline.scene.contact_parts.picking import picked, refuse, refuse_entry
from mudline.scene.contact_parts.units import FORCE_UNIT, LENGTH_UNIT
from mudline.scene.given import number
from mudline.scene.numbering import Floats, Indices, Mask

if TYPE_CHECKING:
    from mudline.keywords.library.seabed_suction import SuctionSet
    from mudline.scene.extensions import Extension
    from mudline.scene.model import Scene

KEYWORD = "SEABED SUCTION"
_CORNERS = (0.2, 0.8)
_SLOWEST = 1e-3
"""Default of REGULARISATION=, m/s."""


def element_suction(scene: Scene, *, keep: bool) -> LawAssignment:
    """The laws of the elements on an elastic seabed.

    `keep` says that curves which pull are kept. Raises RefusedError: a law that is incomplete, or needs metric or
    imperial units, or has corners out of their range, and an element that something else holds down too.
    """
    extension = scene.extensions[KEYWORD]
    held = (extension.of_element >= 0) & (scene.law != LawKind.RIGID)
    elements = np.flatnonzero(held)
    if not elements.size:
        return LawAssignment("suction", elements, dict.fromkeys(SuctionLaw._fields, 0.0))
    _check_alone(scene, extension, held, keep=keep)
    block = extension.of_element[elements]
    _check_complete(scene, extension, block)
    law = suction_law(scene, extension, elements)
    unsized = np.zeros(len(scene.element_ids), dtype=np.bool_)
    unsized[elements] = np.isnan(law.force_factor) | np.isnan(law.depth_factor)
    refuse(extension, unsized, scene.element_ids, "COHESION= needs the external diameter, which is not known")
    _check_corners(extension, block, law)
    return LawAssignment("suction", elements, law._asdict())


def _check_corners(extension: Extension, block: Indices, law: SuctionLaw) -> None:
    first, second = law.first_corner, law.second_corner
    wrong = np.flatnonzero(~((first > 0.0) & (first <= second) & (second < 1.0)))
    if wrong.size:
        where = extension.places[int(block[wrong[0]])]
        refuse_entry(where, "cutoff", "the corners of CUTOFF= must be 0 < first <= second < 1")


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


def _check_alone(scene: Scene, extension: Extension, held: Mask, *, keep: bool) -> None:
    ids = scene.element_ids
    springs = held & (scene.bed.column("suction") > 0.0)
    refuse(extension, springs, ids, "SUCTION= of *SEABED PROPERTIES holds the element too")
    if keep:
        arrays = scene.law_arrays()
        pulls = [bool((curve.forces[curve.ratios > 0.0] < 0.0).any()) for curve in arrays.curves]
        on_curve = np.array([*pulls, False])[arrays.curve_index]
        pulled = held & on_curve & (arrays.law == LawKind.CURVE)
        refuse(extension, pulled, ids, "the curve pulls too, unless it is cut with tension cut")


def _check_complete(scene: Scene, extension: Extension, block: Indices) -> None:
    for index in np.unique(block).tolist():
        entry, where = extension.entries[index], extension.places[index]
        given = {name: getattr(entry, name, None) is not None for name in ("cohesion", "force", "depth")}
        both = given["force"] and given["depth"]
        if not (given["cohesion"] or both):
            refuse_entry(where, "set", "the suction law is incomplete: give COHESION=, or FORCE= and DEPTH=")
        if scene.units not in LENGTH_UNIT:
            if given["cohesion"] and not both:
                refuse_entry(where, "cohesion", "COHESION= needs metric or imperial units: give FORCE= and DEPTH=")
            if math.isnan(number(entry, "regularisation")):
                refuse_entry(where, "set", "REGULARISATION= has no default with user units: give it")


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
