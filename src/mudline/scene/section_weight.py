"""Mass and submerged weight per length of elements, from `*GEOMETRIC SETS` and `*OCEAN`; contents do not count."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.scene.deck_values import DEFAULT_DENSITY, DEFAULT_GRAVITY, number
from mudline.scene.numbering import Floats, picked

if TYPE_CHECKING:
    from mudline.keywords.library.geometric_sets import GeometricSet, GeometricSets
    from mudline.keywords.model import Part
    from mudline.scene.resolved import ResolvedDeck


class Surroundings(NamedTuple):
    """Density of the water and gravity, in the deck's units; NaN where they are not known."""

    density: float
    gravity: float


def surroundings(scene: ResolvedDeck) -> Surroundings:
    """Those of the last `*OCEAN`, whose defaults are known in metric and imperial units; NaN without one."""
    oceans = [block for _, block in scene.deck.blocks("OCEAN")]
    if not oceans:
        return Surroundings(math.nan, math.nan)
    return Surroundings(
        number(oceans[-1], "density", DEFAULT_DENSITY.get(scene.units, math.nan)),
        number(oceans[-1], "gravity", DEFAULT_GRAVITY.get(scene.units, math.nan)),
    )


def mass_per_length(scene: ResolvedDeck) -> Floats:
    """Mass per length (m,), in the deck's units; NaN where it is not known, or not above 0."""
    mass = _of_elements(scene, _mass)
    return np.where(mass > 0.0, mass, np.nan)


def submerged_weight(scene: ResolvedDeck) -> Floats:
    """Weight less buoyancy per length (m,), in the deck's units; NaN where it is not known or overflows.

    Elements whose diameter comes from a file of elements have the weight of their section, if they have one.
    """
    around = surroundings(scene)
    found = _of_elements(scene, lambda entry: (_mass(entry) - around.density * _displaced(entry)) * around.gravity)
    return np.where(np.isfinite(found), found, np.nan)


def _of_elements(scene: ResolvedDeck, value: Callable[[GeometricSet], float]) -> Floats:
    """A value of each element's section; NaN without a section."""
    blocks = [
        cast("GeometricSets", scene.deck.sections[section.where.section].blocks[section.where.block]).sets
        for section in scene.section_table.sections
    ]
    places = [cast("int", section.where.path[1]) for section in scene.section_table.sections]
    values = (value(sets[place]) for sets, place in zip(blocks, places, strict=True))
    return picked(values, scene.section_table.of_element)


def _mass(entry: GeometricSet) -> float:
    """Mass per length of a section, NaN where it is not known."""
    return number(entry.section, "mass") if entry.rigid is None else _wall(entry.rigid)


def _displaced(entry: GeometricSet) -> float:
    """Area of the water that a section displaces, NaN where it is not known."""
    buoyancy = number(entry.section, "db")
    if math.isnan(buoyancy) and entry.flexible is None:
        buoyancy = number(entry.section, "do")
    return math.pi / 4 * buoyancy * buoyancy


def _wall(section: Part) -> float:
    area = number(section, "area")
    if math.isnan(area):
        outer, inner = number(section, "do"), number(section, "di")
        area = math.pi / 4 * (outer * outer - inner * inner)
    return area * number(section, "density")
