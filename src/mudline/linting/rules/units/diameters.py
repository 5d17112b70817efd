"""Diameters and bores of sections against their walls, their mass and what pipes have."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mudline.diagnostics import Where
from mudline.keywords.model import Part
from mudline.linting.context import LintContext
from mudline.linting.rules.units.densities import LIGHTEST_STEEL, WIDEST_PIPE, is_metal
from mudline.linting.rules.units.quantities import (
    DENSITIES,
    DENSITY_UNIT,
    LENGTH_UNIT,
    WATER,
    is_placeholder,
    readable_sections,
    water_density,
)
from mudline.scene.deck_values import DEFAULT_DENSITY, number
from mudline.scene.deck_values import LENGTH_UNIT as METRES
from mudline.scene.model import Scene
from mudline.scene.sections import format_of

WIDEST = 60.0
"""m: no hull that is modelled by beams is wider."""
WIDEST_LINE = 2.0
"""m: what is wider and has the wall of a pipe is a pipe in inches."""
THICKEST = 0.09
"""m: likewise."""
PIPE_WALL = (6.0, 50.0)
"""Diameter to wall thickness of pipes; hulls and piles have more, wellheads and blowout preventers less."""
NARROWEST_BORE = 0.1
"""Internal to external diameter: a smaller one is a wall thickness."""
LIGHTEST = 0.01
"""Mass to that of the water displaced: no line is lighter."""
LINES = (0.3, 30.0)
"""Mass to that of the water displaced, of usual lines."""
_METRIC_UNITS = {"mm": 1e-3, "inches": 0.0254}


def odd_diameters(context: LintContext) -> Iterator[tuple[Where, str]]:
    """The place of each diameter that does not fit its section, and what is wrong, in words."""
    scene = context.scene
    for where, entry in readable_sections(context):
        source, _ = entry.diameter
        section = entry.section
        width = number(section, source.lower())
        if section is None or not 0.0 < width < math.inf:
            continue
        place = where._replace(path=(*where.path, format_of(entry)))
        message = _width(scene, section, width, source)
        if entry.rigid is None:
            message = message or _mass(scene, section, width, source)
        elif not message and (message := _bore(scene, section, width)):
            source = "Di"
        if message:
            yield place._replace(path=(*place.path, source)), message


def _width(scene: Scene, section: Part, width: float, source: str) -> str:
    """What is wrong with a diameter in metres or feet."""
    unit = LENGTH_UNIT.get(scene.units)
    if unit is None:
        return ""
    metres = METRES[scene.units]
    seen = f"an external diameter {source} of {width!r} {unit}"
    if width * metres > WIDEST:
        return f"{seen}, expected below {WIDEST / metres:.3g} {unit}: write it in {unit} (mm?)"
    wall = 0.5 * (width - number(section, "di"))
    is_pipe = PIPE_WALL[0] * wall <= width <= PIPE_WALL[1] * wall and is_metal(section, scene, LIGHTEST_STEEL)
    if is_pipe and width * metres > WIDEST_LINE and wall * metres > THICKEST:
        likely = "mm" if wall > 2.5 else "inches"
        return (
            f"{seen} with a wall of {wall:.3g} {unit}, expected a wall below {THICKEST / metres:.2g} {unit}: write "
            f"both in {unit} ({likely}?)"
        )
    return ""


def _bore(scene: Scene, section: Part, width: float) -> str:
    """What is wrong with an internal diameter."""
    bore = number(section, "di")
    if not 0.0 < bore < NARROWEST_BORE * width or not is_metal(section, scene, LIGHTEST_STEEL):
        return ""
    if width * METRES.get(scene.units, 0.0) > WIDEST_PIPE:
        return ""
    return (
        f"an internal diameter of {bore!r} leaves a wall of nine tenths of the radius {width / 2:.4g} or more: "
        "if it is the wall thickness, give the internal diameter"
    )


def _mass(scene: Scene, section: Part, width: float, source: str) -> str:
    """What is wrong with a diameter beside the mass of its section."""
    mass, buoyancy = number(section, "mass"), number(section, "db", width)
    displaced = 0.25 * math.pi * buoyancy * buoyancy * _water(scene)
    if is_placeholder(mass) or not mass < LIGHTEST * displaced < math.inf:
        return ""
    metres = METRES.get(scene.units)
    units = {name: factor / metres for name, factor in _METRIC_UNITS.items()} if metres else {}
    fits = [name for name, factor in units.items() if LINES[0] <= mass / (displaced * factor * factor) <= LINES[1]]
    likely = f" ({' or '.join(fits)}?)" if fits else ""
    return (
        f"a mass of {mass!r} is {mass / displaced:.1g} of the water that a diameter {source} of {width!r} displaces, "
        f"expected at least {LIGHTEST}: correct the unit of the diameter{likely} or of the mass"
    )


def _water(scene: Scene) -> float:
    """Density of water that diameters are judged by: that of the deck, if it may be one."""
    given_ = water_density(scene)
    unit = DENSITY_UNIT.get(scene.units)
    if unit is None or WATER.holds(given_ * DENSITIES[unit]):
        return given_
    return DEFAULT_DENSITY[scene.units]
