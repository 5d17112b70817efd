"""Lengths that do not fit the pipe."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from mudline.checks.context import LintContext
from mudline.checks.rules.coordinates import UNT006, odd_coordinates
from mudline.checks.rules.curve_shape import LARGEST_RATIO
from mudline.checks.rules.seabed_friction import given, resisting
from mudline.checks.rules.seabed_position import bounds_of, depths
from mudline.checks.rules.unit_densities import (
    DENSITIES,
    DENSITY_UNIT,
    LENGTH_UNIT,
    LIGHTEST_STEEL,
    WATER,
    WIDEST_PIPE,
    is_metal,
    is_placeholder,
    readable_sections,
    rounded,
    water_density,
)
from mudline.language.diagnostics import Problem, Where
from mudline.language.keywords.model import Part
from mudline.language.rules import rule
from mudline.model.scene.deck_values import DEFAULT_DENSITY, LARGEST_MOBILISATION, number
from mudline.model.scene.deck_values import LENGTH_UNIT as METRES
from mudline.model.scene.force_curves import SceneCurve
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Mask, looked_up
from mudline.model.scene.sections import format_of

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
LIGHTEST = 0.1
"""Mass to that of the water displaced: no line is lighter, nor is a float or an air can."""
HEAVIEST = 30.0
"""Likewise: a chain whose diameter is that of its bar has 27, lead has 11."""
WIDEST_FLOAT, WIDEST_COATING, WIDEST_OUTER = 25.0, 11.5, 8.0
"""Times the external diameter that of drag or buoyancy may be, of FLEXIBLE and of RIGID; that one times both others."""
LINES = (0.3, 30.0)
"""Mass to that of the water displaced, of usual lines."""
_METRIC_UNITS = {"mm": 1e-3, "inches": 0.0254}

LONGEST_MOBILISATION = 10.0
"""Diameters, where the usual characteristic length of 10 ft is shorter."""
LONGEST_IN_USER_UNITS = 100.0
"""Diameters."""
FEWEST_POINTS, MOST_ROUND, ROUNDING = 3, 0.5, 1e-3
"""Points of a curve over metres, the share of them that may be round numbers, and how well depths are rounded."""
HIGHEST, HIGHEST_IN_USER_UNITS = 3.0, 10.0
"""Water depths that a model may be high."""
TALLEST = 500.0
"""m that a model may rise above the sea, as no wind turbine does."""


def _diameters(context: LintContext) -> Iterator[Problem]:
    """Diameters that do not fit their sections."""
    for where, entry in context.once(readable_sections):
        source, _ = entry.diameter
        section = entry.section
        width = number(section, source.lower())
        if section is None or not 0.0 < width < math.inf:
            continue
        place = where.inside(format_of(entry))
        message = _width(context, section, width, source)
        if entry.rigid is None:
            message = message or _mass(context, section, width, source)
        elif not message and (message := _bore(context, section, width)):
            source = "Di"
        if message:
            yield Problem(UNT006, message, where=place.inside(source))
        else:
            widest = WIDEST_FLOAT if entry.rigid is None else WIDEST_COATING
            yield from _other_diameters(context, section, widest * width, source, place)


def _other_diameters(context: LintContext, section: Part, most: float, source: str, place: Where) -> Iterator[Problem]:
    """Drag and buoyancy diameters above `most`, and an external one that is far wider than both."""
    width = number(section, source.lower())
    others = {label: number(section, label.lower()) for label in ("Dd", "Db") if label != source}
    known = {label: value for label, value in others.items() if 0.0 < value < math.inf}
    if not known:
        return
    unit = LENGTH_UNIT.get(context.scene.units)
    behind = f" {unit}" if unit else ""
    widest = max(known.values(), default=0.0)
    if widest > most:
        label = next(label for label, value in known.items() if value > most)
        message = (
            f"a diameter {label} of {known[label]!r}{behind} is {known[label] / width:.3g} times {source}, "
            f"{width!r}{behind}: write both in one unit (mm or inches?)"
        )
        yield Problem(UNT006, message, where=place.inside(label))
    elif len(known) == 2 and width > WIDEST_OUTER * widest:
        message = (
            f"an external diameter {source} of {width!r}{behind} is {width / widest:.3g} times the drag and buoyancy "
            "diameters: correct one of them"
        )
        yield Problem(UNT006, message, where=place.inside(source))


def _width(context: LintContext, section: Part, width: float, source: str) -> str:
    """What is wrong with a diameter in metres or feet."""
    unit = LENGTH_UNIT.get(context.scene.units)
    if unit is None:
        return ""
    metres = METRES[context.scene.units]
    seen = f"an external diameter {source} of {width!r} {unit}"
    if width * metres > WIDEST:
        return f"{seen}, expected below {WIDEST / metres:.3g} {unit}: write it in {unit} (mm?)"
    wall = 0.5 * (width - number(section, "di"))
    if not (width * metres > WIDEST_LINE and wall * metres > THICKEST):
        return ""
    if PIPE_WALL[0] * wall <= width <= PIPE_WALL[1] * wall and is_metal(section, context, LIGHTEST_STEEL):
        likely = "mm" if wall > 2.5 else "inches"
        return (
            f"{seen} with a wall of {wall:.3g} {unit}, expected a wall below {THICKEST / metres:.2g} {unit}: write "
            f"both in {unit} ({likely}?)"
        )
    return ""


def _bore(context: LintContext, section: Part, width: float) -> str:
    """What is wrong with an internal diameter."""
    bore = number(section, "di")
    if not 0.0 < bore < NARROWEST_BORE * width or not is_metal(section, context, LIGHTEST_STEEL):
        return ""
    if width * METRES.get(context.scene.units, 0.0) > WIDEST_PIPE:
        return ""
    return (
        f"an internal diameter of {bore!r} leaves a wall of nine tenths of the radius {width / 2:.4g} or more: "
        "if it is the wall thickness, give the internal diameter"
    )


def _mass(context: LintContext, section: Part, width: float, source: str) -> str:
    """What is wrong with a diameter beside the mass of its section."""
    mass, buoyancy = number(section, "mass"), number(section, "db", width)
    displaced = 0.25 * math.pi * buoyancy * buoyancy * _water(context)
    if is_placeholder(mass) or not 0.0 < displaced < math.inf:
        return ""
    widest = max(width, buoyancy, number(section, "dd", width))
    if mass > HEAVIEST * displaced * (widest / buoyancy) ** 2:
        return (
            f"a mass of {mass!r} is {mass / displaced:.3g} times the water that a diameter {source} of {width!r} "
            f"displaces, expected below {HEAVIEST:g}: write the mass in the unit of the water's density (kg, lb?)"
        )
    if not mass < LIGHTEST * displaced:
        return ""
    metres = METRES.get(context.scene.units)
    units = {name: factor / metres for name, factor in _METRIC_UNITS.items()} if metres else {}
    fits = [name for name, factor in units.items() if LINES[0] <= mass / (displaced * factor * factor) <= LINES[1]]
    likely = f" ({' or '.join(fits)}?)" if fits else ""
    return (
        f"a mass of {mass!r} is {mass / displaced:.1g} of the water that a diameter {source} of {width!r} displaces, "
        f"expected at least {LIGHTEST}: correct the unit of the diameter{likely} or of the mass"
    )


def _water(context: LintContext) -> float:
    """Density of water that diameters are judged by: that of the deck, if it may be one."""
    given_, units = water_density(context), context.scene.units
    unit = DENSITY_UNIT.get(units)
    if unit is None or WATER.holds(given_ * DENSITIES[unit]):
        return given_
    return DEFAULT_DENSITY[units]


@rule(UNT006)
def suspicious_length(context: LintContext) -> Iterator[Problem]:
    """A length does not fit the pipe: millimetres, inches, or a wall thickness in place of a diameter.

    Reported are, each with the likely unit:

    * an external diameter above 60 m (a spar hull of 37 m is legal); one above 2 m with the wall of a steel pipe, at
      least 90 mm and a 6th to a 50th of the diameter; one of a FLEXIBLE, MOORING or TRUSS section whose mass is below
      10 % or above 30 times that of the water that it displaces (0 and powers of ten are placeholders);
    * a drag or buoyancy diameter above 25 times the external one, 11.5 times in RIGID; an external one above 8 times
      both;
    * an internal diameter below a tenth of the external one in a steel pipe up to 2.5 m wide: the wall thickness;
    * a mobilisation length above 10 diameters and above 10 ft, the usual characteristic length;
    * a force-embedment curve with three points or more whose ratios become round numbers when divided by the diameter;
    * an element over 25 times as long as each of the neighbours at its two ends, all of one section; a node that is
      so far from both of its neighbours; a node at which a line turns back, and forward again at the next one; an
      element that leaves out a node at which the next one begins, and ends where the line goes on;
    * a node row with one value more than the others, which fits its neighbours if two of them are a decimal comma;
    * nodes over three times as high above the seabed as the water is deep, and over 500 m above the sea.

    In user units only ratios are checked: masses against displaced water where *OCEAN gives its density, bores of walls
    as dense as steel, mobilisation lengths above 100 diameters, curves, elements, and nodes above ten depths.

    Example on pipe:
        - 207.0E9, 79.6E9, 323.9, 288.9, 7850.0
        + 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 12:19
    """
    for kind in (_diameters, _mobilisation, _curves, odd_coordinates, _ocean):
        yield from kind(context)


def _mobilisation(context: LintContext) -> Iterator[Problem]:
    """Mobilisation lengths against the widest pipe that they hold for, but for those that SBD013 reports."""
    scene = context.scene
    if not context.once(resisting) or not (resistance := scene.resistance).has_mobilisation:
        return
    widest = np.full(len(resistance.places) + 1, np.nan)
    friction = scene.extensions.get("SEABED FRICTION")
    used = np.ones(len(resistance.of_element), dtype=np.bool_) if friction is None else friction.of_element < 0
    np.fmax.at(widest, resistance.of_element[used], scene.diameter[used])
    places = {where: index for index, where in enumerate(resistance.places)}
    usual = 1.05 * LARGEST_MOBILISATION.get(scene.units, 0.0)
    for entry in given(context):
        diameter = float(widest[places[entry.where]]) if entry.where in places else math.nan
        longest = max(LONGEST_MOBILISATION * diameter, usual) if usual else LONGEST_IN_USER_UNITS * diameter
        for name in ("longitudinal_mobilisation", "transverse_mobilisation"):
            length = entry.value(name)
            if length is not None and diameter > 0.0 and longest < length < math.inf and length != 10.0:
                unit = f" {LENGTH_UNIT[scene.units]}" if usual else ""
                message = (
                    f"mobilisation length {length!r}{unit} is {length / diameter:.3g} diameters of the pipe, expected "
                    f"below {rounded(longest)}{unit}: write it in the unit of the diameter (mm?)"
                )
                yield Problem(UNT006, message, where=entry.place(name))


def _curves(context: LintContext) -> Iterator[Problem]:
    for curve, diameter in _in_lengths(context.scene):
        message = (
            f"every ratio of this curve is a round number of diameters of {diameter:.4g} (the last one "
            f"{curve.points[:, 0].max() / diameter:.3g}): if these are depths, write them divided by the diameter"
        )
        yield Problem(UNT006, message, where=curve.where)


def _in_lengths(scene: Scene) -> Iterator[tuple[SceneCurve, float]]:
    """Curves of which every ratio is a round number of diameters and most are not round numbers; with the diameter.

    All elements on the curve must have one diameter.
    """
    laws = scene.laws
    candidates = [index for index, curve in enumerate(laws.curves) if _may_be_in_lengths(curve)]
    if not candidates:
        return
    of_grant = np.array([*(grant.curve for grant in laws.set_laws), -1], dtype=np.intp)
    of_element = looked_up(of_grant, laws.of_element)
    smallest, largest = np.full(len(laws.curves) + 1, np.inf), np.full(len(laws.curves) + 1, -np.inf)
    with np.errstate(invalid="ignore"):  # an element without a diameter makes both NaN
        np.minimum.at(smallest, of_element, scene.diameter)
        np.maximum.at(largest, of_element, scene.diameter)
    for index in candidates:
        curve, diameter = laws.curves[index], float(smallest[index])
        if diameter == largest[index] and _is_round(_ratios(curve) / diameter).all():
            yield curve, diameter


def _may_be_in_lengths(curve: SceneCurve) -> bool:
    """Whether most ratios of a curve are not round numbers, and CRV010 reports none of them."""
    if not curve.usable or np.count_nonzero(curve.points[:, 0]) < FEWEST_POINTS:
        return False
    ratios = _ratios(curve)
    if ratios.max() > LARGEST_RATIO:
        return False
    return bool(_is_round(ratios).mean() < MOST_ROUND)


def _ratios(curve: SceneCurve) -> Floats:
    found: Floats = curve.points[curve.points[:, 0] != 0.0, 0]
    return found


def _is_round(values: Floats) -> Mask:
    """Which numbers have two significant digits, as far as rounding in the deck lets that be seen."""
    with np.errstate(divide="ignore", over="ignore", under="ignore", invalid="ignore"):
        digits = np.abs(values) / 10.0 ** np.floor(np.log10(np.abs(values)))  # inf for the smallest floats
        return np.abs(digits - digits.round(1)) <= ROUNDING * digits


def _ocean(context: LintContext) -> Iterator[Problem]:
    """The water depth against the heights of nodes, unless all of them lie above the sea, which GEO005 reports."""
    scene, oceans = context.scene, context.blocks("OCEAN")
    if not oceans or not len(scene.node_ids):
        return
    where, depth = oceans[-1][0], number(oceans[-1][1], "depth")
    bounds, metres = context.once(bounds_of), METRES.get(scene.units)
    height = bounds.highest
    above_sea = (height - depth) * (metres or math.inf)
    if not 0.0 < depth < math.inf or -bounds.deepest > depth or not height < math.inf:
        return
    if height > (HIGHEST if metres else HIGHEST_IN_USER_UNITS) * depth and above_sea > TALLEST:
        highest = scene.node_ids[context.once(depths).argmin()]
        message = (
            f"node {highest} lies {height:.5g} high in water {depth!r} deep, expected "
            "little more than the depth: write both in one unit (km, feet or mm?), and heights as X"
        )
        yield Problem(UNT006, message, where=where.inside("depth"))
