"""What densities and moduli are in SI, and which unit a value seems to be written in."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

from mudline.codes.fields import SYN015
from mudline.diagnostics import Problem, Where
from mudline.linting.context import LintContext
from mudline.linting.rules.sections import section_entries
from mudline.scene.deck_values import FOOT, POUND, number
from mudline.scene.sections import format_of

if TYPE_CHECKING:
    from mudline.keywords.library.geometric_sets import GeometricSet
    from mudline.scene.model import Scene

SLUG = POUND / FOOT
"""kg"""
_INCH = FOOT / 12
_POUND_MASS = 0.45359237
_GRAVITY = 9.80665
_GALLON = 231 * _INCH**3

LENGTH_UNIT = {"metric": "m", "imperial": "ft"}
DENSITY_UNIT = {"metric": "kg/m3", "imperial": "slug/ft3"}
MODULUS_UNIT = {"metric": "N/m2", "imperial": "lbf/ft2"}
"""The unit of each system; user units have none that is known."""

DENSITIES = {
    "kg/m3": 1.0,
    "slug/ft3": SLUG / FOOT**3,
    "t/m3 or g/cm3": 1e3,
    "lb/ft3": _POUND_MASS / FOOT**3,
    "lb/gal": _POUND_MASS / _GALLON,
    "lb/in3": _POUND_MASS / _INCH**3,
    "t/mm3": 1e12,
    "N/m3": 1 / _GRAVITY,
    "kN/m3": 1e3 / _GRAVITY,
}
"""Units of density in kg/m3; those of specific weight under standard gravity."""
MODULI = {
    "N/m2": 1.0,
    "lbf/ft2": POUND / FOOT**2,
    "kPa": 1e3,
    "MPa": 1e6,
    "GPa": 1e9,
    "psi": POUND / _INCH**2,
    "ksi": 1e3 * POUND / _INCH**2,
}
"""Units of modulus in N/m2."""


def rounded(value: float) -> str:
    """A value with three digits, without an exponent where it is short."""
    return f"{float(f'{value:.3g}'):g}"


class Range(NamedTuple):
    """Values from `low` to `high`, in SI."""

    low: float
    high: float

    def holds(self, value: float) -> bool:
        """Whether a value lies in the range; NaN does not."""
        return self.low <= value <= self.high

    def words(self, factor: float, unit: str) -> str:
        """The range in another unit, of `factor` in SI."""
        return f"{rounded(self.low / factor)} to {rounded(self.high / factor)} {unit}"


STEEL_DENSITY = Range(7500.0, 8200.0)
STEEL_E = Range(185e9, 220e9)
STEEL_G = Range(71e9, 86e9)
WATER = Range(900.0, 2500.0)
"""Densities of fresh water, sea water and brines."""
USUAL_WATER = Range(950.0, 1100.0)


def likely_units(value: float, units: Mapping[str, float], own: str, expected: Range) -> str:
    """The units, other than the deck's own, in which a value lies in a range, in words; "" where there are none."""
    return " or ".join(name for name, factor in units.items() if name != own and expected.holds(value * factor))


def is_placeholder(value: float) -> bool:
    """Whether a value is 0 or a power of ten, as people write for a property that does not matter."""
    if not 0.0 < value < math.inf:
        return True
    exponent = math.log10(value)
    return abs(exponent - round(exponent)) < 1e-9


def water_density(scene: Scene) -> float:
    """Density of the last `*OCEAN` that gives one, in the deck's units; NaN where none does."""
    given = [number(block, "density") for _, block in scene.deck.blocks("OCEAN")]
    return next((density for density in reversed(given) if density > 0.0), math.nan)


def readable_sections(context: LintContext) -> Iterator[tuple[Where, GeometricSet]]:
    """The entries of *GEOMETRIC SETS with their places, but for those in whose lines SYN015 found decimal commas."""
    text = context.text
    commas = {text.place(problem).line for problem in context.told(SYN015)} if text else set()
    for where, entry in section_entries(context.scene.deck):
        line = where._replace(path=(*where.path, format_of(entry)))
        if not commas or not text or text.place(Problem(SYN015, "", where=line)).line not in commas:
            yield where, entry
