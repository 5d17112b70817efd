"""Mass and submerged weight of a scene's elements."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.scene.model import Scene

if TYPE_CHECKING:
    from mudline.keywords.library.geometric_sets import GeometricSets
    from mudline.keywords.library.ocean import Ocean

_GRAVITY = {"imperial": 32.174}
_STANDARD = 9.81
_WATER = {"imperial": 1.99}
_SEA = 1025.0


class Surroundings(NamedTuple):
    """Density of the water and gravity, in the deck's units."""

    density: float
    gravity: float


def surroundings(scene: Scene) -> Surroundings:
    """Those of `*OCEAN`, else sea water and gravity in the deck's units (SI for units of the user's own)."""
    found = Surroundings(_WATER.get(scene.units, _SEA), _GRAVITY.get(scene.units, _STANDARD))
    for _, block in scene.deck.blocks("OCEAN"):
        water = cast("Ocean", block)
        found = Surroundings(_number(water.density, found.density), _number(water.gravity, found.gravity))
    return found


def mass_per_length(scene: Scene) -> FloatArray:
    """Structural mass per unit length of elements (m,), from `*GEOMETRIC SETS`, contents ignored; NaN if unknown."""
    return _by_element(scene, 0)


def submerged_weight(scene: Scene) -> FloatArray:
    """Weight in water per unit length of elements (m,), contents ignored; NaN where it is unknown."""
    around = surroundings(scene)
    return (_by_element(scene, 0) - around.density * _by_element(scene, 1)) * around.gravity


def _by_element(scene: Scene, which: int) -> FloatArray:
    """Mass (0) or displaced area (1) per unit length of the section of each element."""
    rows = [
        _mass_and_area(entry.section)
        for _, block in scene.deck.blocks("GEOMETRIC SETS")
        for entry in cast("GeometricSets", block).sets
    ]
    values: FloatArray = np.array([*(row[which] for row in rows), math.nan])
    return values[scene.section_table.of_element]


def _mass_and_area(section: object) -> tuple[float, float]:
    """Whatever the format: mass as given, or of the wall; the area of the buoyancy diameter, else of the external."""
    outer = _number(getattr(section, "do", None))
    buoyant = _number(getattr(section, "db", None), outer)
    mass = _number(getattr(section, "mass", None))
    if math.isnan(mass):
        inner, density = _number(getattr(section, "di", None)), _number(getattr(section, "density", None))
        wall = _number(getattr(section, "area", None), math.pi / 4.0 * (outer * outer - inner * inner))
        mass = density * wall
    usable = math.isfinite(mass) and mass > 0.0
    return mass if usable else math.nan, math.pi / 4.0 * buoyant * buoyant


def _number(value: object, default: float = math.nan) -> float:
    return float(value) if isinstance(value, int | float) else default
