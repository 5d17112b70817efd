"""Densities and moduli that seem to be in another unit."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import islice
from typing import TYPE_CHECKING, NamedTuple

from mudline.checks.context import LintContext, entries_of_sets
from mudline.language.codes.fields import SYN015
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.model import Part
from mudline.language.rules import rule
from mudline.model.scene.deck_values import FOOT, POUND, number
from mudline.model.scene.deck_values import LENGTH_UNIT as METRES
from mudline.model.scene.model import Scene
from mudline.model.scene.sections import format_of

if TYPE_CHECKING:
    from mudline.language.keywords.library.geometric_sets import GeometricSet

UNT004 = Code("UNT004", "suspicious-density", Severity.WARNING)
UNT005 = Code("UNT005", "suspicious-modulus", Severity.WARNING)

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

AIR = Range(1.1, 1.31)
"""kg/m3: decks of a test in air."""
WALL = Range(10.0, 40_000.0)
"""kg/m3: from foam to a riser joint whose steel carries the mass of its contents and buoyancy."""
SOLID_DENSITY = Range(900.0, 12_000.0)
"""kg/m3: from polyethylene to lead."""
STEEL = 7850.0
"""kg/m3"""
LIGHTEST_STEEL = 7000.0
"""kg/m3: a steel pipe is no lighter, as contents and coatings only add to its mass."""
WIDEST_PIPE = 2.5
"""m: wider steel is a hull, whose density may be anything."""
SHALLOWEST = 5.0
"""A number below it is not a water depth in metres or feet that was written as the density."""
STEEL_TO_WATER = Range(7.0, 8.4)
"""Density of steel to that of water, fresh or salt."""

SOFTEST = 1e5
"""N/m2: a rubber that is softer is a modulus in another unit."""
SOLID_E = Range(3e8, 4e11)
"""N/m2: moduli of plastics to steel."""
POISSON = Range(-0.02, 0.52)
"""0 to 0.5, with moduli rounded to two digits."""
EXCHANGED = Range(2.0, 3.0)
"""E/G of a material whose Poisson's ratio is 0 to 0.5."""
LIGHTEST_METAL = 2600.0
"""kg/m3: what is lighter may be a composite, whose moduli are independent of each other."""
STIFF = 6e10
"""N/m2: likewise what is softer."""


def likely_units(value: float, units: Mapping[str, float], own: str, expected: Range) -> str:
    """The units, other than the deck's own, in which a value lies in a range, in words; "" where there are none."""
    return " or ".join(name for name, factor in units.items() if name != own and expected.holds(value * factor))


def is_placeholder(value: float) -> bool:
    """Whether a value is 0 or a power of ten, as people write for a property that does not matter."""
    if not 0.0 < value < math.inf:
        return True
    exponent = math.log10(value)
    return abs(exponent - round(exponent)) < 1e-9


def water_density(context: LintContext) -> float:
    """Density of the last `*OCEAN` that gives one, in the deck's units; NaN where none does."""
    given = [number(block, "density") for _, block in context.blocks("OCEAN")]
    return next((density for density in reversed(given) if density > 0.0), math.nan)


def readable_sections(context: LintContext) -> list[tuple[Where, GeometricSet]]:
    """The entries of *GEOMETRIC SETS with their places, but for those in whose lines SYN015 found decimal commas.

    Several rules need them, and ask `context.once`.
    """
    text = context.text
    found = list(entries_of_sets(context.blocks("GEOMETRIC SETS")))
    commas = {text.place(problem).line for problem in context.problems_of(SYN015)} if text else set()
    if not commas or not text:
        return found
    lines = (text.place(Problem(SYN015, "", where=where.inside(format_of(entry)))).line for where, entry in found)
    return [placed for placed, line in zip(found, lines, strict=True) if line not in commas]


@rule(UNT004)
def suspicious_density(context: LintContext) -> Iterator[Problem]:
    """The density of the water or of a pipe wall looks as if it were in another unit.

    Densities are in kg/m3 in metric decks and in slug/ft3 in imperial ones. Water has 900 to 2500 kg/m3, heavy brines
    included; 0 and the density of air are accepted. 1.025 is t/m3, 64 is lb/ft3, and a density like a depth beside a
    depth like a density means that the two were exchanged. A wall has 10 to 40 000 kg/m3, as foam is light and the
    steel of a riser joint may carry the mass of all that is around it; 0 and powers of ten are accepted as
    placeholders. Less or more is reported, but more in a section with an area of its own only where it is steel in
    another unit: 7.85 is t/m3. A pipe up to 2.5 m wide with the modulus of steel and without an area of its own is also
    reported if its density is below 7000 kg/m3 and is that of steel in another unit, as 490 lb/ft3. In user units only
    the ratio is checked: steel is 7 to 8.4 times as heavy as water, and not 1000 times more or less than that.

    Example on ocean:
        - 500.0, 1.025, 9.81
        + 500.0, 1025.0, 9.81

    Finds: 3:9
    """
    unit = DENSITY_UNIT.get(context.scene.units)
    if unit is None:
        yield from _ratios(context)
    else:
        yield from _water(context, unit)
        yield from _walls(context, unit)


def _water(context: LintContext, unit: str) -> Iterator[Problem]:
    factor = DENSITIES[unit]
    for where, block in context.blocks("OCEAN"):
        density, depth = number(block, "density"), number(block, "depth")
        if not density > 0.0 or WATER.holds(density * factor) or AIR.holds(density * factor):
            continue
        place = where.inside("density")
        seen = f"a water density of {density!r} {unit}, expected {WATER.words(factor, unit)}"
        likely = likely_units(density, DENSITIES, unit, USUAL_WATER)
        if USUAL_WATER.holds(depth * factor) and density >= SHALLOWEST:
            message = f"{seen}: depth {depth!r} and density seem to be exchanged, write the depth first"
        elif likely:
            message = f"{seen}: {density!r} looks like {likely}, write it in {unit}"
        elif not is_placeholder(density):
            message = f"{seen}: correct it"
        else:
            continue
        yield Problem(UNT004, message, where=place)


def _walls(context: LintContext, unit: str) -> Iterator[Problem]:
    factor = DENSITIES[unit]
    for where, entry in context.once(readable_sections):
        density = number(entry.rigid, "density")
        if LIGHTEST_STEEL <= density * factor <= WALL.high or is_placeholder(density):
            continue
        likely = likely_units(density, DENSITIES, unit, STEEL_DENSITY)
        if density * factor < WALL.low:
            likely = likely or likely_units(density, {"t/m3 or g/cm3": 1e3}, unit, SOLID_DENSITY)
        elif density * factor > WALL.high:
            if not likely and not math.isnan(number(entry.rigid, "area")):
                continue  # mass per length over an area of its own
        elif not likely or not _is_light_steel(entry.rigid, density * factor, context.scene):
            continue
        what = f"{density!r} looks like {likely}, write it in {unit}" if likely else "correct it"
        expected = f"{WALL.words(factor, unit)} (steel {rounded(STEEL / factor)})"
        message = f"a wall density of {density!r} {unit}, expected {expected}: {what}"
        yield Problem(UNT004, message, where=where.inside("rigid", "density"))


def _is_light_steel(section: Part | None, density: float, scene: Scene) -> bool:
    """Whether a pipe has the modulus of steel and less than its density (kg/m3)."""
    modulus = number(section, "e") * MODULI[MODULUS_UNIT[scene.units]]
    width = number(section, "do") * METRES[scene.units]
    plain = math.isnan(number(section, "area"))
    return density < LIGHTEST_STEEL and STEEL_E.holds(modulus) and plain and width <= WIDEST_PIPE


def _ratios(context: LintContext) -> Iterator[Problem]:
    water = water_density(context)
    for where, entry in context.once(readable_sections):
        ratio = number(entry.rigid, "density") / water
        for scale, which in ((1e3, "smaller"), (1e-3, "larger")):
            if STEEL_TO_WATER.holds(ratio * scale):
                message = (
                    f"the wall is {ratio:.3g} times as dense as the water, expected 7 to 8.4 times for steel: it looks "
                    f"like a unit 1000 times {which} than that of *OCEAN, write both in one unit"
                )
                yield Problem(UNT004, message, where=where.inside("rigid", "density"))


def is_metal(section: Part | None, context: LintContext, lightest: float) -> bool:
    """Whether the wall of a section is denser than `lightest` (kg/m3), judged against water of 1025 in user units.

    A density that is one of steel in another unit counts as such; without a density nothing is known.
    """
    density = number(section, "density")
    unit = DENSITY_UNIT.get(context.scene.units)
    if unit is None:
        return density / water_density(context) * 1025.0 >= lightest
    in_si = density * DENSITIES[unit]
    return lightest <= in_si <= WALL.high or bool(likely_units(density, DENSITIES, unit, STEEL_DENSITY))


@rule(UNT005)
def suspicious_modulus(context: LintContext) -> Iterator[Problem]:
    """Young's modulus or the shear modulus looks as if it were in another unit, or the two do not fit each other.

    Moduli are in N/m2 in metric decks and in lbf/ft2 in imperial ones. Less than 1E5 N/m2 is softer than any rubber:
    207 is GPa, 207000 is MPa; 0 and powers of ten are accepted as placeholders. A steel wall (7000 kg/m3 or more) is
    also reported where its modulus is that of steel in kPa, psi, ksi or the unit of the other system. E and G of a
    material give Poisson's ratio, E/2G - 1, from 0 to 0.5: in any units, it is reported when negative, as it is when
    the two are exchanged, and when above 0.5 for metals (2600 kg/m3 and 60 GPa or more). Composites may have any. In
    user units of metres and seconds a steel wall is reported whose modulus is 1000 times too large or too small for its
    density. A section gets one finding, and FLEXIBLE, MOORING and TRUSS sections, which have no modulus, none.

    Example on pipe:
        - 207.0, 79.6, 0.3239, 0.2889, 7850.0
        + 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 12:2
    """
    for where, entry in context.once(readable_sections):
        if entry.rigid is not None:
            place = where.inside("rigid")
            yield from islice(_of_section(context, entry.rigid, place), 1)


def _of_section(context: LintContext, section: Part, where: Where) -> Iterator[Problem]:
    """What is wrong with the moduli of a section, the first cause first."""
    young, shear = number(section, "e"), number(section, "g")
    if unit := MODULUS_UNIT.get(context.scene.units):
        steel = is_metal(section, context, LIGHTEST_STEEL)
        for key, name, value, expected in (
            ("E", "Young's modulus", young, STEEL_E),
            ("G", "the shear modulus", shear, STEEL_G),
        ):
            if (likely := _other_unit(value, unit, expected, steel=steel)) is not None:
                steel_range = expected.words(MODULI[unit], unit)
                least = f"at least {rounded(SOFTEST / MODULI[unit])} {unit} (steel {steel_range})"
                range_ = least if value * MODULI[unit] < SOFTEST else f"{steel_range} for steel"
                what = f"{value!r} looks like {likely}, write it in {unit}" if likely else "correct it"
                message = f"{name} {key} is {value!r} {unit}, expected {range_}: {what}"
                yield Problem(UNT005, message, where=where.inside(key))
    elif _is_off(context, section, young):
        message = (
            f"Young's modulus E {young!r} and density {number(section, 'density')!r} do not fit a steel wall: their "
            "units seem to be 1000 times apart, write both in one system"
        )
        yield Problem(UNT005, message, where=where.inside("E"))
    if not is_placeholder(young) and not is_placeholder(shear):
        yield from _poisson(context, section, young, shear, where)


def _is_off(context: LintContext, section: Part, young: float) -> bool:
    """Whether the modulus of steel is 1000 times too large or too small for its density, in user units of m and s."""
    density = number(section, "density")
    if not STEEL_TO_WATER.holds(density / water_density(context)) or not _in_metres(context):
        return False
    return any(STEEL_E.holds(young / density * STEEL * scale) for scale in (1e3, 1e-3))


def _in_metres(context: LintContext) -> bool:
    """Whether the last `*OCEAN` has the gravity of metres and seconds."""
    gravity = next((number(block, "gravity") for _, block in reversed(context.blocks("OCEAN"))), math.nan)
    return abs(gravity - _GRAVITY) < 0.02 * _GRAVITY


def _other_unit(value: float, unit: str, steel_range: Range, *, steel: bool) -> str | None:
    """The units that a modulus seems to be in, "" where they are not known; None for one that may be right."""
    if is_placeholder(value):
        return None
    in_si = value * MODULI[unit]
    if in_si >= SOFTEST:
        suspect = steel and not steel_range.holds(in_si)
        return (likely_units(value, MODULI, unit, steel_range) or None) if suspect else None
    usual = {name: MODULI[name] for name in ("GPa", "MPa")}
    return likely_units(value, MODULI, unit, steel_range) or likely_units(value, usual, unit, SOLID_E)


def _poisson(context: LintContext, section: Part, young: float, shear: float, where: Where) -> Iterator[Problem]:
    ratio = 0.5 * young / shear - 1.0
    if POISSON.holds(ratio) or not math.isfinite(ratio) or (ratio > 0.0 and not _is_isotropic(context, section, young)):
        return
    seen = f"E {young!r} and G {shear!r} give Poisson's ratio {ratio:.3g}, expected 0 to 0.5"
    if EXCHANGED.holds(shear / young):
        message = f"{seen}: the two seem to be exchanged, write E first"
        yield Problem(UNT005, message, where=where.inside("E"))
    else:
        message = f"{seen}: correct one of them (with 0.3, G = {young / 2.6:.3g})"
        yield Problem(UNT005, message, where=where.inside("G"))


def _is_isotropic(context: LintContext, section: Part, young: float) -> bool:
    """Whether a wall is of metal; in user units one whose density against water is not known counts as such."""
    unit = MODULUS_UNIT.get(context.scene.units)
    if unit is None:
        return math.isnan(water_density(context)) or is_metal(section, context, LIGHTEST_METAL)
    return young * MODULI[unit] >= STIFF and is_metal(section, context, LIGHTEST_METAL)
