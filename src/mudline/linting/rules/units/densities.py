"""Densities of the water and of pipe walls."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import islice

from mudline.diagnostics import Code, Problem, Severity
from mudline.keywords.model import Part
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.units.quantities import (
    DENSITIES,
    DENSITY_UNIT,
    MODULI,
    MODULUS_UNIT,
    STEEL_DENSITY,
    STEEL_E,
    USUAL_WATER,
    WATER,
    Range,
    is_placeholder,
    likely_units,
    readable_sections,
    rounded,
    water_density,
)
from mudline.scene.context import MOST_REPORTED
from mudline.scene.deck_values import LENGTH_UNIT as METRES
from mudline.scene.deck_values import number
from mudline.scene.model import Scene

UNT004 = Code("UNT004", "suspicious-density", Severity.WARNING)

AIR = Range(1.1, 1.31)
"""kg/m3: decks of a test in air."""
WALL = Range(10.0, 40_000.0)
"""kg/m3: from foam to a riser joint whose steel carries the mass of its contents and buoyancy."""
SOLID = Range(900.0, 12_000.0)
"""kg/m3: from polyethylene to lead."""
STEEL = 7850.0
"""kg/m3"""
LIGHTEST_STEEL = 7000.0
"""kg/m3: a steel pipe is no lighter, as contents and coatings only add to its mass."""
WIDEST_PIPE = 2.5
"""m: wider steel is a hull, whose density may be anything."""
SHALLOWEST = 5.0
"""A number below it is no water depth in metres or feet that took the place of a density."""
STEEL_TO_WATER = Range(7.0, 8.4)
"""Density of steel to that of water, fresh or salt."""


@rule(UNT004)
def suspicious_density(context: LintContext) -> Iterator[Problem]:
    """The density of the water or of a pipe wall looks as if it were in another unit.

    Densities are in kg/m3 in metric decks and in slug/ft3 in imperial ones. Water has 900 to 2500 kg/m3, heavy brines
    included; 0 and the density of air are accepted. 1.025 is t/m3, 64 is lb/ft3, and a density like a depth beside a
    depth like a density means that the two were exchanged. A wall has 10 to 40 000 kg/m3, as foam is light and the
    steel of a riser joint may carry the mass of all that is around it; 0 and powers of ten are accepted as
    placeholders. Below 10 kg/m3, or above where the value is steel in another unit, it is reported: 7.85 is t/m3. A
    pipe up to 2.5 m wide with the modulus of steel and without an area of its own is also reported if its density is
    below 7000 kg/m3 and is that of steel in another unit, as 490 lb/ft3. In user units only the ratio is checked: steel
    is 7 to 8.4 times as heavy as water, and not 1000 times more or less than that.

    Example:
         $MODEL
         *OCEAN
        - 500.0, 1.025, 9.81
        + 500.0, 1025.0, 9.81

    Finds: 3:9
    """
    unit = DENSITY_UNIT.get(context.scene.units)
    if unit is None:
        yield from islice(_ratios(context), MOST_REPORTED)
    else:
        yield from islice(_water(context.scene, unit), MOST_REPORTED)
        yield from islice(_walls(context, unit), MOST_REPORTED)


def _water(scene: Scene, unit: str) -> Iterator[Problem]:
    factor = DENSITIES[unit]
    for where, block in scene.deck.blocks("OCEAN"):
        density, depth = number(block, "density"), number(block, "depth")
        if not density > 0.0 or WATER.holds(density * factor) or AIR.holds(density * factor):
            continue
        place = where._replace(path=("density",))
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
    for where, entry in readable_sections(context):
        density = number(entry.rigid, "density")
        if is_placeholder(density):
            continue
        likely = likely_units(density, DENSITIES, unit, STEEL_DENSITY)
        if density * factor < WALL.low:
            likely = likely or likely_units(density, {"t/m3 or g/cm3": 1e3}, unit, SOLID)
        elif not likely or not (
            density * factor > WALL.high or _is_light_steel(entry.rigid, density * factor, context.scene)
        ):
            continue
        what = f"{density!r} looks like {likely}, write it in {unit}" if likely else "correct it"
        expected = f"{WALL.words(factor, unit)} (steel {rounded(STEEL / factor)})"
        message = f"a wall density of {density!r} {unit}, expected {expected}: {what}"
        yield Problem(UNT004, message, where=where._replace(path=(*where.path, "rigid", "density")))


def _is_light_steel(section: Part | None, density: float, scene: Scene) -> bool:
    """Whether a pipe has the modulus of steel and less than its density (kg/m3)."""
    modulus = number(section, "e") * MODULI[MODULUS_UNIT[scene.units]]
    width = number(section, "do") * METRES[scene.units]
    plain = math.isnan(number(section, "area"))
    return density < LIGHTEST_STEEL and STEEL_E.holds(modulus) and plain and width <= WIDEST_PIPE


def _ratios(context: LintContext) -> Iterator[Problem]:
    water = water_density(context.scene)
    for where, entry in readable_sections(context):
        ratio = number(entry.rigid, "density") / water
        for scale, which in ((1e3, "smaller"), (1e-3, "larger")):
            if STEEL_TO_WATER.holds(ratio * scale):
                message = (
                    f"the wall is {ratio:.3g} times as dense as the water, expected 7 to 8.4 times for steel: it looks "
                    f"like a unit 1000 times {which} than that of *OCEAN, write both in one unit"
                )
                yield Problem(UNT004, message, where=where._replace(path=(*where.path, "rigid", "density")))


def is_metal(section: Part | None, scene: Scene, lightest: float) -> bool:
    """Whether the wall of a section is denser than `lightest` (kg/m3), judged against water of 1025 in user units.

    A density that is one of steel in another unit counts as such; without a density nothing is known.
    """
    density = number(section, "density")
    unit = DENSITY_UNIT.get(scene.units)
    if unit is None:
        return density / water_density(scene) * 1025.0 >= lightest
    in_si = density * DENSITIES[unit]
    return lightest <= in_si <= WALL.high or bool(likely_units(density, DENSITIES, unit, STEEL_DENSITY))
