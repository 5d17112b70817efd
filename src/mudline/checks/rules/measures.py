"""Measures and conditions of `Usual`: quantities that numbers of a deck are compared by instead of themselves."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from mudline.basics.units import UnitSystem
from mudline.checks.context import LintContext
from mudline.checks.rules.curve_points import swapped
from mudline.checks.rules.slips import UNITLESS, is_placeholder, meant_unit
from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Where
from mudline.language.keywords.contents import names_given
from mudline.language.keywords.model import FEWEST_POINTS, FieldSpec, Rows, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import (
    BED,
    CURVE_FORCE,
    MASS_WIDTH,
    SEA_FREQUENCY,
    SEA_PERIOD,
    WALL,
    WAVE_PERIOD,
    YOUNG,
    Usual,
    exceeded,
)
from mudline.language.keywords.values import Names
from mudline.model.scene.boundary import held_freedoms
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.deck_values import number
from mudline.model.scene.numbering import Floats
from mudline.model.scene.sections import weights

_STEEL_E = YOUNG[1]
_STEEL_DENSITY = WALL[2]
_LIGHTEST_STEEL = 7000.0
"""Density in kg/m3 below which no steel pipe lies: contents and coatings only add to its mass."""
_WIDEST_PIPE = 2.5
"""Diameter in m above which steel is a hull, whose density may be anything."""
_METAL = (2600.0, 6e10)
"""Density in kg/m3 and modulus in N/m2 of a metal; lighter or softer composites have independent moduli."""
_SEA_WATER = 1025.0
_SOIL_WEIGHT = 5e3
"""Submerged weight of clay in N/m3."""
_LONG = 0.025
"""Frequency, in Hz or rad/s, of waves of 40 s and longer."""
_DEEP = 5.0
"""Depth in m above which soil may be of any weakness."""
_SHALLOW = 100.0
"""Water depth in m that offsets in shallower water are compared with."""
_PEAK_PERIOD = 1.25
"""Ratio of peak to mean zero up-crossing period of a Jonswap sea, at least."""
_SHORT = 3.2
"""Length in m: mobilisation lengths up to the usual characteristic length of 10 ft are not slips of units."""
_MOST_PAIRS = 10_000_000
"""Number of laws times sections beyond which weights are not computed."""
_SHARE = 0.3
"""Ratio of submerged weight to weight in air of a line with contents, at least."""
_LEAST_FORCE = 100.0
"""Force in N/m that a curve is compared with if the pipe's weight is unknown; less for cables thinner than 0.1 m."""

NOWHERE = Where()


@dataclass(frozen=True, eq=False)
class Numbers:
    """Numbers of a part, in SI where the units are known.

    weighs: the weights of pipes are known.
    deep: the depth of the water is known.
    part: the part; of a table, the part that holds it.
    holder: the part around it.
    where: place of the part.
    columns: its fields in the order of a line.
    table, rows: the rows of a table, and their declaration.
    changed: numbers that replace those of the part.
    """

    context: LintContext
    units: UnitSystem
    weighs: bool = True
    deep: bool = True
    part: Any = None
    holder: Any = None
    where: Where = NOWHERE
    columns: Sequence[FieldSpec] = ()
    table: Table | None = None
    rows: Rows | None = None
    changed: Mapping[str, float] = field(default_factory=dict)

    def __call__(self, name: str) -> float:
        """Return a number in SI by the name of its field; NaN if it is not given."""
        if name in self.changed:
            return self.changed[name]
        size = next((self.units.size(slot.about.unit) for slot in self.columns if slot.name == name), 1.0)
        return number(self.part, name) * size

    def outside(self, slot: FieldSpec, value: float) -> Usual | None:
        """Return the first range that a value of a field (as in the deck) lies outside of and that applies to it."""
        comparable = self.units.known or slot.about.unit in UNITLESS
        asked = [each for each in slot.usuals if each.of or comparable]
        if value == 0.0:  # is usual by itself and as a ratio
            asked = [each for each in asked if each.of[:1] not in ("", "/")]
        in_si = value * self.units.size(slot.about.unit)
        for usual in exceeded(asked, [self.quantity(slot, each, in_si) for each in asked]):
            placeholder = usual.placeholder and is_placeholder(value)
            explained = not (placeholder or usual.explained) or self.explanation(slot, usual, value, strict=placeholder)
            if explained and (not usual.when or CONDITIONS[usual.when](self)):
                return None if slot.about.fault(value) else usual
        return None

    def quantity(self, slot: FieldSpec, usual: Usual, value: float) -> float:
        """Return the compared quantity of a number in SI."""
        if usual.of.startswith("/"):
            return over(value, self(usual.of[1:]))
        return MEASURES[usual.of](self, slot.name, value) if usual.of else value

    def explanation(self, slot: FieldSpec, usual: Usual, value: float, *, strict: bool = False) -> str:
        """Return the likely unit of a value and the advice in words, if a unit explains it; else ""."""
        unit = slot.about.unit
        if not math.isnan(usual.typical):
            name = meant_unit(usual, value, unit, self.units, partial(self.quantity, slot, usual), strict=strict)
            return f"{value!r} looks like {name}, write it in{self.units.behind(unit)}" if name else ""
        if not usual.explained:
            return ""
        quantity = self.quantity(slot, usual, value * self.units.size(unit))
        for factor, which in (1e3, "smaller"), (1e-3, "larger"):
            if quantity and usual.low <= quantity * factor <= usual.high:
                return f"it looks like a unit 1000 times {which}, write both in one unit"
        return ""

    @property
    def water(self) -> float:
        """Density of the water; that of sea water if the deck's is not plausible."""
        density = self.context.scene.surroundings.density * self.units.size("M/L3")
        return density if not self.units.known or 900.0 <= density <= 2500.0 else _SEA_WATER

    @property
    def depth(self) -> float:
        """Depth of the water; NaN if it is not known."""
        return self.context.scene.surroundings.depth * self.units.size("L") if self.deep else math.nan

    @property
    def density(self) -> float:
        """Density of the wall in kg/m3; relative to sea water if the units are not known."""
        return self("density") if self.units.known else over(self("density"), self.water) * _SEA_WATER


def over(value: float, divisor: float) -> float:
    """Return the ratio of two numbers; NaN unless the second is above 0."""
    return value / divisor if divisor > 0.0 else math.nan


# ----------------------------------------------------------------------------------------------------------- conditions


def _steel_wall(of: Numbers) -> bool:
    """Return True if the wall is as dense as steel, or would be with its number in another unit."""
    if _LIGHTEST_STEEL <= of.density <= 40_000.0:
        return True
    own = of.units.size("M/L3")
    return of.units.known and bool(meant_unit(_STEEL_DENSITY, of("density") / own, "M/L3", of.units))


def _steel_modulus(of: Numbers) -> bool:
    pipe = math.isnan(of("area")) and of("do") <= _WIDEST_PIPE
    return of.units.known and pipe and _STEEL_E.low <= of("e") <= _STEEL_E.high


def _thick_pipe(of: Numbers) -> bool:
    wall = 0.5 * (of("do") - of("di"))
    return of.units.known and wall > 0.09 and 6.0 * wall <= of("do") <= 50.0 * wall and _steel_wall(of)


def _metal(of: Numbers) -> bool:
    if not of.units.known:
        return math.isnan(of.water) or of.density >= _METAL[0]
    return of("e") >= _METAL[1] and (of.density >= _METAL[0] or _steel_wall(of))


def _waves_in_time(of: Numbers) -> bool:
    in_time = all(block.type_ != "STATIC" for _, block in of.context.blocks("ANALYSIS TYPE", "LOAD CASE"))
    return in_time and any(keyword.startswith("WAVE-") for _, keyword in of.context.scene.context.placed)


CONDITIONS: Mapping[str, Callable[[Numbers], bool]] = {
    "a steel wall": _steel_wall,
    "a steel pipe": lambda of: _steel_wall(of) and not (of.units.known and of("do") > _WIDEST_PIPE),
    "the modulus of steel": _steel_modulus,
    "a thick steel pipe": _thick_pipe,
    "a metal": _metal,
    "a mass that fits the diameter": lambda of: MASS_WIDTH.holds(_mass_width(of, "do", of("do"))),
    "a wall without an area of its own": lambda of: math.isnan(of("area")),
    "unknown units": lambda of: not of.units.known,
    "a fluid without density": lambda of: of("density") == 0.0,
    "a fluid without pressure": lambda of: not of("pressure") > 0.0,
    "a spreading exponent": lambda of: of("exponent") > 0.0,
    "waves in the time domain": _waves_in_time,
}


# ------------------------------------------------------------------------------------------------- sections and vessels


def _mass_width(of: Numbers, name: str, value: float) -> float:
    """Return a diameter over that of a water column of equal mass; a wider diameter next to it excuses a small one."""
    mass = of("mass")
    wet = math.sqrt(over(mass * 4.0, math.pi * of.water)) if not is_placeholder(mass) else math.nan
    own = value if name == "db" or math.isnan(of("db")) else of("db")
    widest = float(np.fmax.reduce([own, of("dd"), of("do")]))
    return max(over(own, wet), min(over(widest, wet), 1.0))


def _times_others(of: Numbers, _name: str, value: float) -> float:
    """Return an external diameter over the wider of drag and buoyancy diameter; NaN unless both are given."""
    others = of("dd"), of("db")
    return over(value, max(others)) if min(others) > 0.0 else math.nan


def _times_ring(of: Numbers, _name: str, value: float) -> float:
    radius = 0.5 * float(np.fmax.reduce([of("do"), of("dd"), of("db")]))
    return over(value, of("mass") * radius * radius)


def _bending(of: Numbers, _name: str, value: float) -> float:
    width = of("do") if of("do") > 0.0 else of("dd")
    return over(value, of("ea") * width * width)


def _poisson(of: Numbers, _name: str, value: float) -> float:
    young = of("e")
    return math.nan if is_placeholder(young) else over(0.5 * young, value) - 1.0


def _long_heave(of: Numbers, name: str, value: float) -> float:
    heave = value if name == "heave" else number(of.part.amplitudes, "heave")
    return heave if 0.0 < of("frequency") <= _LONG else math.nan


def _steepness(of: Numbers, height: float) -> float:
    """Return height over wave length in deep water at the peak period of a sea; NaN if gravity is not known."""
    gravity = of.context.scene.surroundings.gravity * of.units.size("L/T2")
    gravity = 9.81 if of.units.known and not 9.0 < gravity < 11.0 else gravity
    period = of("period") * (_PEAK_PERIOD if getattr(of.holder, "spec", None) == "HSTZ" else 1.0)
    return over(2.0 * math.pi * height, gravity * period * period)


def _from_nodes(of: Numbers, _name: str, _value: float) -> float:
    """Return the initial distance of a vessel from the farthest of the nodes that it holds."""
    scene, vessel = of.context.scene, folded(str(getattr(of.holder, "vessel", "")))
    held = [node for node, name in of.context.once(_on_vessels).items() if folded(name) == vessel]
    place = np.array([of("x"), of("y"), of("z")])
    nodes = scene.coordinates[held] * of.units.size("L")
    return max((float(np.linalg.norm(node - place)) for node in nodes), default=math.nan)


def _on_vessels(context: LintContext) -> dict[int, str]:
    return held_freedoms(context.scene, [context.scene.deck])[1]


def _shortest_period(context: LintContext) -> float:
    """Return the shortest wave period of a load case, for random seas the peak period; infinite without waves."""
    placed = context.scene.context.placed.items()
    blocks = (block for (_, keyword), listed in placed if keyword.startswith("WAVE-") for _, block in listed)
    values = ((slot.about.usual, value) for block in blocks for _, slot, value in block.walk() if slot.about.usual)
    periods = (
        1.0 / value if usual is SEA_FREQUENCY else value
        for usual, value in values
        if usual in (SEA_FREQUENCY, SEA_PERIOD, WAVE_PERIOD) and isinstance(value, float) and value > 0.0
    )
    return min(periods, default=math.inf)


def _between_axes(of: Numbers, _name: str, _value: float) -> float:
    """Return the angle between two axes of a row in degrees; 0 if one of them has no length."""
    first, second = (np.nan_to_num([of(f"{axis}{which}") for axis in "xyz"]) for which in (1, 2))
    lengths = float(np.linalg.norm(first) * np.linalg.norm(second))
    return math.degrees(math.acos(max(-1.0, min(float(first @ second) / lengths, 1.0)))) if lengths else 0.0


# --------------------------------------------------------------------------------------------------- seabed and soil


def _laid(context: LintContext) -> dict[Where, Floats]:
    """Return the largest weight and diameter of the pipes on each linear law and each curve, in the deck's units.

    The weight is the submerged one. For a pipe that floats it is that with contents: a share of the weight in air.
    """
    scene = context.scene
    laws, sections = scene.laws, scene.section_table.sections
    held = np.zeros((len(laws.set_laws) + 1, len(sections) + 1), dtype=np.bool_)
    if held.size > _MOST_PAIRS:
        return {}
    held[laws.of_element, scene.section_table.of_element] = True  # the last ones stand for none
    pipes = np.full((len(sections), 2), np.nan)
    for index, section in enumerate(sections):
        in_air, submerged = weights(section.entry, scene.surroundings)
        pipes[index] = max(submerged, _SHARE * in_air), section.diameter
    largest: dict[Where, Floats] = {}
    for law, row in zip(laws.set_laws, held[:, :-1], strict=False):
        where = laws.curves[law.curve].where if law.curve >= 0 else law.where
        on_law = np.fmax.reduce(pipes[row], axis=0, initial=np.nan)
        largest[where] = np.fmax(largest.get(where, np.nan), on_law)
    return largest


def _pipe_on(of: Numbers, where: Where) -> tuple[float, float]:
    """Return the largest weight and diameter of the pipes on a law or a curve in SI; NaN where they are not known."""
    weight, width = of.context.once(_laid).get(where, (math.nan, math.nan))
    return (float(weight) if of.weighs else math.nan) * of.units.size("F/L"), float(width) * of.units.size("L")


def _sinking(of: Numbers, name: str, value: float) -> float:
    """Return the penetration of pipes on a linear seabed under their own weight, in diameters."""
    weight, width = _pipe_on(of, of.where.inside(name))
    return over(weight, value * width) if weight > 0.0 else math.nan


def _curves(context: LintContext) -> dict[Where, SceneCurve]:
    return {curve.where: curve for curve in context.scene.laws.curves}


def _times_weight(of: Numbers, _name: str, _value: float) -> float:
    """Return the largest force of a curve over the weight of the pipes that follow it."""
    curve = of.context.once(_curves).get(of.where)
    if curve is None or not curve.whole or swapped(curve):
        return math.nan
    largest = float(np.abs(curve.points[:, 1]).max(initial=0.0)) * of.units.size("F/L")
    weight, width = _pipe_on(of, of.where)
    if not largest > 0.0 or not (weight > 0.0 or of.units.known):
        return math.nan
    thin = min(width / 0.1, 1.0) if width > 0.0 else 1.0
    return over(largest, weight if weight > 0.0 else _LEAST_FORCE * thin)


def _times_pipe(of: Numbers, _name: str, value: float) -> float:
    """Return a mobilisation length over the widest pipe it applies to; over ten such pipes in unknown units."""
    if value == 10.0 * of.units.size("L") or (value <= _SHORT and of.units.known):
        return math.nan
    widths = of.context.once(_resisted)
    of_set = Where(of.where.section, of.where.block, of.where.path[:-1])  # for the values of FRICTION=
    width = widths.get(of.where, widths.get(of_set, math.nan)) * of.units.size("L")
    return over(value, width * (1.0 if of.units.known else 10.0))


def _resisted(context: LintContext) -> dict[Where, float]:
    """Return the widest pipe that each place with friction applies to, in the deck's units."""
    scene = context.scene
    resistance, friction = scene.resistance, scene.extensions.get("SEABED FRICTION")
    widest = np.full(len(resistance.places) + 1, np.nan)
    used = np.ones(len(resistance.of_element), dtype=np.bool_) if friction is None else friction.of_element < 0
    np.fmax.at(widest, resistance.of_element[used], scene.diameter[used])
    return dict(zip(resistance.places, widest.tolist(), strict=False))


def _as_stiffness(of: Numbers, _name: str, _value: float) -> float:
    """Return the secant of a curve between its outermost points, in SI."""
    points = _points(of)
    if points is None:
        return math.nan
    apart, force = np.ptp(points, axis=0).tolist()
    return over(force, apart) if force > 0.0 else math.nan


def _least_slope(of: Numbers, _name: str, _value: float) -> float:
    """Return the least slope between neighbouring points of a curve, in SI."""
    points = _points(of)
    if points is None:
        return math.nan
    rise, run = np.diff(points[np.argsort(points[:, 0], kind="stable")], axis=0).T[::-1]
    return float(np.min(rise[run > 0.0] / run[run > 0.0], initial=math.inf))


def _skin_strain(of: Numbers, _name: str, _value: float) -> float:
    """Return the largest curvature of a curve times the radius of the widest pipe that has it."""
    points, name = _points(of), getattr(of.part, "curve", None)
    if points is None or not isinstance(name, str):
        return math.nan
    width = of.context.once(_bent).get(folded(name), math.nan) * of.units.size("L")
    return 0.5 * width * float(np.abs(points[:, 0]).max())


def _bent(context: LintContext) -> dict[str, float]:
    """Return the largest diameter of the sections on each moment-curvature curve, by its name, in the deck's units."""
    diameters: dict[str, float] = {}
    for section in context.scene.section_table.sections:
        for _, name in names_given(section.entry, Names.MOMENT_CURVATURE):
            diameters[folded(name)] = float(np.fmax(diameters.get(folded(name), math.nan), section.diameter))
    return diameters


def _points(of: Numbers) -> Floats | None:
    """Return abscissas and ordinates (n, 2) of a curve, in SI; None if a value is not known."""
    if of.table is None or of.rows is None or not of.rows.row or len(of.table) < FEWEST_POINTS:
        return None
    columns = record_schema(of.rows.row).columns
    points = np.column_stack([of.table.column(axis) * of.units.size(columns[axis].about.unit) for axis in of.rows.axes])
    return points if np.isfinite(points).all() else None


def _times_soil(of: Numbers, _name: str, _value: float) -> float:
    """Return the largest resistance of a soil spring over the weight of the soil above and the pipe's diameter."""
    points, depth, scene = _points(of), of("depth"), of.context.scene
    entry = scene.set_table.find(str(of.holder.set_name)) if getattr(of.holder, "set_name", None) else None
    if points is None or not depth >= _DEEP or not of.units.known or entry is None:
        return math.nan
    width = float(np.fmax.reduce(scene.diameter[entry.elements], initial=math.nan)) * of.units.size("L")
    return over(float(np.abs(points[:, 1]).max()), _SOIL_WEIGHT * depth * width)


MEASURES: Mapping[str, Callable[[Numbers, str, float], float]] = {
    "times the diameter of as much water as its mass": _mass_width,
    "times the drag and buoyancy diameters": _times_others,
    "times the mass and the radius squared": _times_ring,
    "times EA Do2": _bending,
    "as Poisson's ratio, E / 2G - 1": _poisson,
    "times the density of the water": lambda of, _, value: over(value, of.water),
    "m above the water": lambda of, _, value: value - of.depth if of.units.known else math.nan,
    "times the water depth": lambda of, _, value: over(value, max(of.depth, _SHALLOW * of.units.known)),
    "m from the nodes that it holds": lambda of, n, value: _from_nodes(of, n, value) if of.units.known else math.nan,
    "as heave in a wave of 40 s and longer": _long_heave,
    "times the shortest period of the waves": lambda of, _, value: over(value, of.context.once(_shortest_period)),
    "as the length of the vector": lambda of, *_: float(np.linalg.norm(np.nan_to_num([of(axis) for axis in "xyz"]))),
    "degrees between the local x and y axes": _between_axes,
    "as steepness, 2 pi H / g T2": lambda of, _, value: _steepness(of, value),
    "diameters that the pipe sinks under its weight": _sinking,
    "times the weight of the pipe, or 100 N/m, at its largest force": _times_weight,
    "times the diameter of the pipe": _times_pipe,
    "as a stiffness": _as_stiffness,
    "as the least slope": _least_slope,
    "at the first point": lambda of, *_: math.nan if (points := _points(of)) is None else float(points[0, 0]),
    "times the inverse radius of the pipe, at its end": _skin_strain,
    "times the weight of the soil above and the diameter": _times_soil,
}
WEIGHED = {BED[1].of, CURVE_FORCE.of}
"""Measures that depend on the weight of the pipe."""
OF_POINTS = {"at the first point", "as the least slope"}
"""Measures of single points of a curve."""
OF_DEPTH = {"m above the water", "times the water depth"}
"""Measures that depend on the depth of the water."""
