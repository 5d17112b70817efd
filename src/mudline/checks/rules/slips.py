"""Slips that explain unusual values: units that numbers may be in by mistake, lines of another keyword or option."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import chain, takewhile
from typing import TYPE_CHECKING

from mudline.basics.units import FOOT, POUND, TONNES, UNITS, UnitSystem
from mudline.checks.context import Found, Joined, LintContext, joint
from mudline.checks.rules.load_cases import TIM003, TIM004, WAV002
from mudline.checks.rules.seabed_position import UNT006
from mudline.language.codes.fields import SYN003
from mudline.language.codes.lines import SYN001
from mudline.language.diagnostics import Code, Problem, Severity
from mudline.language.keywords.contents import is_partly_unknown
from mudline.language.keywords.model import FieldSpec, Part, record_schema
from mudline.language.keywords.usual import Usual
from mudline.language.syntax.rows import read_number
from mudline.model.scene.deck_values import number
from mudline.model.scene.rules.fields import GEO001
from mudline.model.scene.sections import format_of

if TYPE_CHECKING:
    from mudline.language.keywords.library.geometric_sets import GeometricSet

UNT001 = Code("UNT001", "gravity-mismatch", Severity.WARNING)
UNT002 = Code("UNT002", "suspicious-magnitude", Severity.WARNING)
UNT003 = Code("UNT003", "large-friction", Severity.WARNING)
UNT004 = Code("UNT004", "suspicious-density", Severity.WARNING)
UNT005 = Code("UNT005", "suspicious-modulus", Severity.WARNING)
UNT007 = Code("UNT007", "unusual-value", Severity.WARNING)
UNT008 = Code("UNT008", "remarkable-value", Severity.INFO)

CODES = {code.code: code for code in (UNT001, UNT002, UNT003, UNT004, UNT005, UNT006, UNT007)}

_INCH = FOOT / 12
_POUND_MASS = 0.45359237
_GRAVITY = 9.80665
_SLUG = UNITS["imperial"].mass
_KIP = 1e3 * POUND

SLIPS = {
    "L": {"mm": 1e-3, "inches": _INCH, "ft": FOOT, "m": 1.0, "cm": 1e-2},
    "F": {"N": 1.0, "kN": 1e3, "MN": 1e6, "lbf": POUND, "kip": _KIP, "tonnes": 1e3 * _GRAVITY},
    "F/L": {"N/m": 1.0, "kN/m": 1e3, "MN/m": 1e6, "lbf/ft": POUND / FOOT, "kip/ft": _KIP / FOOT},
    "F/L2": {
        "N/m2": 1.0,
        "kPa (kN/m2)": 1e3,
        "MPa": 1e6,
        "GPa": 1e9,
        "lbf/ft2": POUND / FOOT**2,
        "psi": POUND / _INCH**2,
        "ksi": _KIP / _INCH**2,
        "bar": 1e5,
    },
    "FL": {"N m": 1.0, "kN m": 1e3, "MN m": 1e6, "lbf ft": POUND * FOOT, "kip ft": _KIP * FOOT},
    "FL2": {
        "N m2": 1.0,
        "kN m2": 1e3,
        "MN m2": 1e6,
        "N mm2": 1e-6,
        "lbf ft2": POUND * FOOT**2,
        "lbf in2": POUND * _INCH**2,
        "kip ft2": _KIP * FOOT**2,
    },
    "M": {"kg": 1.0, "t": 1e3, "lb": _POUND_MASS, "slug": _SLUG},
    "M/L": {"kg/m": 1.0, "t/m": 1e3, "lb/ft": _POUND_MASS / FOOT, "slug/ft": _SLUG / FOOT},
    "M/L3": {
        "kg/m3": 1.0,
        "t/m3 or g/cm3": 1e3,
        "slug/ft3": _SLUG / FOOT**3,
        "lb/ft3": _POUND_MASS / FOOT**3,
        "lb/gal": _POUND_MASS / (231 * _INCH**3),
        "lb/in3": _POUND_MASS / _INCH**3,
        "t/mm3": 1e12,
        "N/m3": 1 / _GRAVITY,
        "kN/m3": 1e3 / _GRAVITY,
    },
    "L/T": {"m/s": 1.0, "cm/s": 1e-2, "knots": 1852 / 3600, "ft/s": FOOT},
    "L/T2": {"m/s2": 1.0, "ft/s2": FOOT, "cm/s2": 1e-2},
    "L2/T": {"m2/s": 1.0, "mm2/s": 1e-6, "ft2/s": FOOT**2},
    "T": {"s": 1.0, "ms": 1e-3, "minutes": 60.0, "hours": 3600.0},
    "deg": {"degrees": 1.0, "radians": 57.29577951308232},
}
"""Names of units by the quantity that they measure, with their size in SI (angles in degrees).

Specific weights are listed as densities.
"""
UNITLESS = ("", "-", "%", "deg", "T", "Hz")
"""Units of fields that are the same in every deck."""


_LIGHT = (0.9, 1.3)
"""Range of densities of water in t/m3."""


def deck_units(context: LintContext) -> UnitSystem:
    """Return the units of a deck; user units are tonnes and kilonewtons if the last *OCEAN shows it."""
    units = UNITS[context.scene.units]
    for _, ocean in () if units.known else reversed(context.blocks("OCEAN")):
        density, gravity = number(ocean, "density"), number(ocean, "gravity")
        if _LIGHT[0] <= density <= _LIGHT[1] and abs(gravity - _GRAVITY) < 0.02 * _GRAVITY:
            return TONNES
    return units


_STRICT = 1.2
"""Factor within which a number in another unit equals the usual value of its field."""
_POINTS = (0.1, 10.0, 0.01, 100.0, 0.001, 1000.0)
"""Factors of a lost or misplaced decimal point."""
_MOST = 3
"""Number of units that are proposed for a number without a usual value."""
Measured = Callable[[float], float]
"""Compared quantity of a number in SI."""


def is_placeholder(value: float) -> bool:
    """Return True if a value is 0 or a power of ten, as often written for a property that does not matter."""
    if not 0.0 < value < math.inf:
        return True
    exponent = math.log10(value)
    return abs(exponent - round(exponent)) < 1e-9


def meant_unit(
    usual: Usual, value: float, unit: str, units: UnitSystem, measured: Measured = float, *, strict: bool = False
) -> str:
    """Return the other unit in which a number (as in the deck) has the usual value of its field, or "".

    With `strict` it must be within 20 % of that value.
    """
    away: dict[str, float] = {}
    for name, size in SLIPS.get(unit, {}).items():
        quantity = measured(value * size)
        if abs(size / units.size(unit) - 1.0) > 1e-3 and quantity / usual.typical > 0.0:
            away[name] = abs(math.log(quantity / usual.typical))
    nearest = min(away, key=away.__getitem__, default="")
    if nearest and away[nearest] <= math.log(min(_STRICT, usual.within)):
        return nearest
    within = 0.0 if strict else math.log(usual.within)
    return next((name for name, distance in away.items() if distance <= within), "")


def likely_slips(usual: Usual, value: float, unit: str, units: UnitSystem, measured: Measured = float) -> str:
    """Return the other units, in words, in which a number (as in the deck) would be usual; "" for none, or too many."""
    own = units.size(unit)
    known = SLIPS.get(unit, {}) if math.isnan(usual.typical) else {}
    names = [name for name, size in known.items() if size != own and usual.holds(measured(value * size))]
    return " or ".join(names[:_MOST])


def lacks_point(usual: Usual, value: float, measured: Measured = float) -> bool:
    """Return True if a number (in SI) would be usual with its decimal point elsewhere."""
    quantities = [measured(value * factor) for factor in _POINTS]
    if math.isnan(usual.typical):
        return any(map(usual.holds, quantities))
    return any(usual.typical / _STRICT <= each <= usual.typical * _STRICT for each in quantities)


# ------------------------------------------------------------------------------------------ causes of several findings


MOST_LENGTHS, USUAL_LENGTHS = 25.0, 8.0
"""Limits of the ratio of the longest to the shortest length of a section."""


@joint(GEO001, UNT004, UNT005, UNT006)
def row_of_another_option(context: LintContext, found: Found) -> Iterator[Joined]:
    """Join the findings in property lines under one OPTION= whose lengths fit each other only under another OPTION=."""
    text = context.text
    lines: dict[int, list[Problem]] = {}
    for problem in chain.from_iterable(found.values()) if text else ():
        lines.setdefault(text.place(problem).line if text else 0, []).append(problem)
    runs: list[tuple[str, list[Problem]]] = []
    for where, entry in context.records("GEOMETRIC SETS"):
        own = format_of(entry)
        others = _other_formats(entry, own)
        span = text.span(where.inside(own)) if text and others else None
        if entry.option or not runs:
            runs.append(("", []))
        if text and span:
            known, problems = runs[-1]
            message = f"the lengths of this row fit each other under {others}, not under OPTION={own.upper()}"
            here = lines.pop(text.source.position(span.start)[0], [])
            runs[-1] = known or f"{message}: correct OPTION= above it", problems + here
    for message, problems in runs:
        if problems:
            yield Joined(problems[0], problems[1:], message=message)


def _other_formats(entry: GeometricSet, own: str) -> str:
    """Return in words the other formats of a property line that its lengths fit; "" if its own format may be right."""
    section: Part | None = entry.section
    if section is None or is_partly_unknown(section):
        return ""
    values = [getattr(section, slot.name) for slot in record_schema(type(section)).columns]
    while values[-1] is None:
        values.pop()
    formats = {slot.name: record_schema(slot.row).columns for slot in record_schema(type(entry)).slots if slot.row}
    if _lengths_fit(values, formats.pop(own), MOST_LENGTHS):
        return ""
    fitting = (name for name, columns in formats.items() if _lengths_fit(values, columns, USUAL_LENGTHS))
    return " or ".join(f"OPTION={name.upper()}" for name in fitting)


def _lengths_fit(values: Sequence[object], columns: Sequence[FieldSpec], most: float) -> bool:
    """Return True if the values fit the columns of a property line, with lengths at most a factor of `most` apart."""
    values_by_name = {slot.name: value for slot, value in zip(columns, values, strict=False) if value is not None}
    units = {slot.name: slot.about.unit for slot in columns}
    numbers = {name: value for name, value in values_by_name.items() if isinstance(value, int | float)}
    lengths = [value for name, value in numbers.items() if units[name] == "L" and value > 0.0]
    complete = len(values) <= len(columns) and all(slot.name in values_by_name for slot in columns if slot.required)
    has_wall = numbers.get("di", 0.0) < numbers.get("do", math.inf)
    return complete and has_wall and max(lengths, default=0.0) <= most * min(lengths, default=0.0)


_OF_WAVE = ("amplitude", "height", "period")
"""Fields of a wave that the time step is compared with."""


@joint(TIM003, TIM004, WAV002)
def of_one_wave_or_step(context: LintContext, found: Found) -> Iterator[Joined]:
    """Join findings to their cause: a wave or a time step that is itself unusual."""
    rest = [one for code in (WAV002, TIM003, TIM004) for one in found.get(code.code, ())]
    for cause in found.get(UNT007.code, ()):
        at = cause.where
        if at is None or not at.path:
            continue
        blocks = [block for section in context.deck.sections[at.section : at.section + 1] for block in section.blocks]
        keyword = blocks[at.block].keyword if at.block < len(blocks) else ""  # of a deck with a section put in
        wave = keyword.startswith("WAVE-") and at.path[-1] in _OF_WAVE
        others = [
            one
            for one in rest
            if one.where is not None
            and (one.where[:2] == at[:2] or (wave and one.where.section == at.section and one.code is not WAV002))
        ]
        if others:
            rest = [one for one in rest if one not in others]
            yield Joined(cause, others)


@joint(UNT004, UNT005, UNT006)
def water_in_another_mass(context: LintContext, found: Found) -> Iterator[Joined]:
    """Join findings to the density of the water that causes them: in user units it reveals the units of the deck."""
    text = context.text
    wrong = {code: problems for code, problems in found.items() if code.startswith("UNT")}
    if text is None or len(wrong) == 1 or not text.source.name.lower().endswith((".keyx", ".keyxu")):
        return
    place = next((where.inside("density") for where, _ in context.written("OCEAN")), None)
    span = text.span(place) if place and context.deck.written(place) else None
    density = read_number(text.source.unified[slice(*span)]) if span else None
    if density is None:
        return
    everything = [*chain.from_iterable(wrong.values())]
    cause = next(one for one in everything if one.code in (UNT004, UNT005, UNT006))
    fits = density * (1000.0 if density < 10.0 else 0.001)
    message = (
        f"the density {density!r} of the water does not fit the rest of the deck, in which {fits:.6g} would: write it "
        "in the deck's unit of mass"
    )
    yield Joined(cause, [one for one in everything if one is not cause], message=message, place=span)


@joint(*CODES.values(), UNT008)
def lines_of_another_keyword(context: LintContext, found: Found) -> Iterator[Joined]:
    """Join unusual values to a nearby line that does not fit its keyword: the lines may belong to a missing keyword."""
    text = context.text
    if text is None:
        return
    unusual = [one for code in (*CODES, UNT008.code) for one in found.get(code, ())]
    by_line = {text.place(one).line: one for one in unusual}
    for cause in (*found.get(SYN001.code, ()), *found.get(SYN003.code, ())):
        first = text.place(cause).line
        end = len(text.source.line_starts) + 1
        last = end if cause.code == SYN001 else min(first + 2, end)
        below = takewhile(lambda line: text.source.line(line)[:1] not in ("*", "$"), range(first, last))
        yield Joined(cause, [by_line[line] for line in (first - 1, *below) if line in by_line])
