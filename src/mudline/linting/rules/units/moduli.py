"""Young's modulus and shear modulus of pipe walls."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import islice

from mudline.diagnostics import Code, Problem, Severity, Where
from mudline.keywords.model import Part
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.units.densities import LIGHTEST_STEEL, is_metal
from mudline.linting.rules.units.quantities import (
    MODULI,
    MODULUS_UNIT,
    STEEL_E,
    STEEL_G,
    Range,
    is_placeholder,
    likely_units,
    readable_sections,
    rounded,
    water_density,
)
from mudline.scene.context import MOST_REPORTED
from mudline.scene.deck_values import number
from mudline.scene.model import Scene

UNT005 = Code("UNT005", "suspicious-modulus", Severity.WARNING)

SOFTEST = 1e5
"""N/m2: a rubber that is softer is a modulus in another unit."""
SOLID = Range(3e8, 4e11)
"""N/m2: moduli of plastics to steel."""
POISSON = Range(-0.02, 0.52)
"""0 to 0.5, with moduli rounded to two digits."""
EXCHANGED = Range(2.0, 3.0)
"""E/G of a material whose Poisson's ratio is 0 to 0.5."""
LIGHTEST_METAL = 2600.0
"""kg/m3: what is lighter may be a composite, whose moduli are independent of each other."""
STIFF = 6e10
"""N/m2: likewise what is softer."""


@rule(UNT005)
def suspicious_modulus(context: LintContext) -> Iterator[Problem]:
    """Young's modulus or the shear modulus looks as if it were in another unit, or the two do not fit each other.

    Moduli are in N/m2 in metric decks and in lbf/ft2 in imperial ones. Less than 1E5 N/m2 is softer than any rubber:
    207 is GPa, 207000 is MPa; 0 and powers of ten are accepted as placeholders. A steel wall (7000 kg/m3 or more) is
    also reported where its modulus is that of steel in kPa, psi, ksi or the unit of the other system. E and G of a
    material give Poisson's ratio, E/2G - 1, from 0 to 0.5: in any units, it is reported when negative, as it is when
    the two are exchanged, and when above 0.5 for metals (2600 kg/m3 and 60 GPa or more). Composites may have any. A
    section gets one finding, and FLEXIBLE, MOORING and TRUSS sections, which have no modulus, none.

    Example:
         $MODEL
         *GEOMETRIC SETS
          OPTION=RIGID
          SET=ALL
        - 207.0, 79.6, 0.3239, 0.2889, 7850.0
        + 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 5:2
    """
    yield from islice(_suspicious(context), MOST_REPORTED)


def _suspicious(context: LintContext) -> Iterator[Problem]:
    for where, entry in readable_sections(context):
        if entry.rigid is not None:
            place = where._replace(path=(*where.path, "rigid"))
            yield from islice(_of_section(context.scene, entry.rigid, place), 1)


def _of_section(scene: Scene, section: Part, where: Where) -> Iterator[Problem]:
    """What is wrong with the moduli of a section, the first cause first."""
    young, shear = number(section, "e"), number(section, "g")
    if unit := MODULUS_UNIT.get(scene.units):
        steel = is_metal(section, scene, LIGHTEST_STEEL)
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
                yield Problem(UNT005, message, where=where._replace(path=(*where.path, key)))
    if not is_placeholder(young) and not is_placeholder(shear):
        yield from _poisson(scene, section, young, shear, where)


def _other_unit(value: float, unit: str, steel_range: Range, *, steel: bool) -> str | None:
    """The units that a modulus seems to be in, "" where they are not known; None for one that may be right."""
    if is_placeholder(value):
        return None
    in_si = value * MODULI[unit]
    likely = likely_units(value, MODULI, unit, steel_range)
    if in_si < SOFTEST:
        usual = {name: MODULI[name] for name in ("GPa", "MPa")}
        return likely or likely_units(value, usual, unit, SOLID)
    return likely if likely and steel and not steel_range.holds(in_si) else None


def _poisson(scene: Scene, section: Part, young: float, shear: float, where: Where) -> Iterator[Problem]:
    ratio = 0.5 * young / shear - 1.0
    if POISSON.holds(ratio) or not math.isfinite(ratio) or (ratio > 0.0 and not _is_isotropic(scene, section, young)):
        return
    seen = f"E {young!r} and G {shear!r} give Poisson's ratio {ratio:.3g}, expected 0 to 0.5"
    if EXCHANGED.holds(shear / young):
        message = f"{seen}: the two seem to be exchanged, write E first"
        yield Problem(UNT005, message, where=where._replace(path=(*where.path, "E")))
    else:
        message = f"{seen}: correct one of them (with 0.3, G = {young / 2.6:.3g})"
        yield Problem(UNT005, message, where=where._replace(path=(*where.path, "G")))


def _is_isotropic(scene: Scene, section: Part, young: float) -> bool:
    """Whether a wall is of metal; in user units one whose density against water is not known counts as such."""
    unit = MODULUS_UNIT.get(scene.units)
    if unit is None:
        return math.isnan(water_density(scene)) or is_metal(section, scene, LIGHTEST_METAL)
    return young * MODULI[unit] >= STIFF and is_metal(section, scene, LIGHTEST_METAL)
