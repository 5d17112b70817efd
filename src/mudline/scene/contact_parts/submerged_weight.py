"""Submerged weight per length of elements, from `*GEOMETRIC SETS` and `*OCEAN`; contents do not count."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.diagnostics import Where
from mudline.scene.contact_parts.picking import number, picked
from mudline.scene.contact_parts.units import DEFAULT_DENSITY, DEFAULT_GRAVITY
from mudline.scene.numbering import Floats

if TYPE_CHECKING:
    from mudline.keywords.library.geometric_sets import GeometricSets
    from mudline.keywords.model import Part
    from mudline.scene.model import Scene


def submerged_weight(scene: Scene) -> Floats:
    """Weight less buoyancy per length (m,), in the deck's units; NaN where it is not known or overflows.

    Elements whose diameter comes from a file of elements have the weight of their section, if they have one.
    """
    oceans = [block for _, block in scene.deck.blocks("OCEAN")]
    if not oceans:
        return np.full(len(scene.element_ids), np.nan)
    water = number(oceans[-1], "density", DEFAULT_DENSITY.get(scene.units, math.nan))
    gravity = number(oceans[-1], "gravity", DEFAULT_GRAVITY.get(scene.units, math.nan))
    weights = [_mass(scene, section.where, water) * gravity for section in scene.section_table.sections]
    found = picked(weights, scene.section_table.of_element)
    return np.where(np.isfinite(found), found, np.nan)


def _mass(scene: Scene, where: Where, water: float) -> float:
    """Mass per length of a section, less that of the water it displaces; NaN where it is not known."""
    block = cast("GeometricSets", scene.deck.sections[where.section].blocks[where.block])
    entry = block.sets[cast("int", where.path[1])]
    section = entry.section
    buoyancy = number(section, "db")
    if math.isnan(buoyancy) and entry.flexible is None:
        buoyancy = number(section, "do")
    mass = number(section, "mass") if entry.rigid is None else _wall(entry.rigid)
    return mass - water * math.pi / 4 * buoyancy * buoyancy


def _wall(section: Part) -> float:
    area = number(section, "area")
    if math.isnan(area):
        outer, inner = number(section, "do"), number(section, "di")
        area = math.pi / 4 * (outer * outer - inner * inner)
    return area * number(section, "density")
