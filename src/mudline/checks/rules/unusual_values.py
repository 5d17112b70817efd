"""Values outside of what is usual of their fields, and the slip that explains each."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache
from itertools import chain, pairwise, takewhile
from types import SimpleNamespace
from typing import NamedTuple, cast

import numpy as np

from mudline.basics.short_repr import counted
from mudline.checks.context import LintContext
from mudline.checks.joints import Found, Joined, joint
from mudline.checks.measures import CONDITIONS, MEASURES, WEIGHED, Numbers, over
from mudline.checks.rules.coordinates import UNT006, height_over_depth, odd_coordinates
from mudline.checks.rules.curve_ends import curves_over_lengths
from mudline.checks.unit_slips import Units, is_placeholder, lacks_point, likely_slips, meant_unit, units_of
from mudline.language.codes.fields import SYN003, SYN015
from mudline.language.codes.lines import SYN001
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.model import FieldSpec, Part, Rows, record_schema
from mudline.language.keywords.ranges import in_words
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import Usual
from mudline.language.keywords.values import Kind
from mudline.language.rules import rule
from mudline.language.syntax.rows import read_number
from mudline.model.scene.deck_values import number

UNT001 = Code("UNT001", "gravity-mismatch", Severity.WARNING)
UNT002 = Code("UNT002", "suspicious-magnitude", Severity.WARNING)
UNT003 = Code("UNT003", "large-friction", Severity.WARNING)
UNT004 = Code("UNT004", "suspicious-density", Severity.WARNING)
UNT005 = Code("UNT005", "suspicious-modulus", Severity.WARNING)
UNT007 = Code("UNT007", "unusual-value", Severity.WARNING)
UNT008 = Code("UNT008", "remarkable-value", Severity.INFO)

_CODES = {code.code: code for code in (UNT001, UNT002, UNT003, UNT004, UNT005, UNT006, UNT007)}


def unusual_values(context: LintContext) -> list[Problem]:
    """What is outside of the usual values of its field; several rules need it, and ask `context.once`.

    Left out are lines in which SYN015 found decimal commas, and what is compared with a weight that is not usual.
    """
    units = units_of(context)
    with np.errstate(all="ignore"):  # numbers may be as large as they like
        told = [
            one
            for placed in context.scene.context.placed.values()
            for where, block in placed
            for one in _inside(context, units, block, None, where)
        ]
    heavy = any(problem.code in (UNT001, UNT004, UNT006) for _, problem in told)
    found = [problem for usual, problem in told if not (heavy and usual.of in WEIGHED)]
    text = context.text
    commas = {text.place(problem).line for problem in context.problems_of(SYN015)} if text and found else set()
    return [one for one in found if not commas or not text or text.place(one).line not in commas]


def of_code(context: LintContext, code: Code) -> Iterator[Problem]:
    """The unusual values of one code."""
    return (one for one in context.once(unusual_values) if one.code is code)


# ------------------------------------------------------------------------------------------------------- what is judged


class Told(NamedTuple):
    """A finding, and the range that its value is outside of."""

    usual: Usual
    problem: Problem


@cache
def _judged(part: type[Part]) -> tuple[tuple[FieldSpec, ...], tuple[FieldSpec, ...]]:
    """The fields of a part that have usual values, and those that hold tables or parts with such fields."""
    slots = [
        slot for slot in record_schema(part).slots if slot.about.usuals or any(any(_judged(one)) for one in slot.parts)
    ]
    own = tuple(slot for slot in slots if slot.about.usuals and not isinstance(slot.about, Rows))
    return own, tuple(slot for slot in slots if slot.parts)


def _inside(context: LintContext, units: Units, part: Part, holder: Part | None, where: Where) -> Iterator[Told]:
    """What is unusual in a part and in those inside it: of a part one finding of each code, with others under it."""
    own, outer = _judged(type(part))
    of = Numbers(context, units, part, holder, where, record_schema(type(part)).slots)
    by_code: dict[Code, list[Told]] = {}
    for slot in own:
        value = getattr(part, slot.name, None)
        if isinstance(value, float | int | Part):
            given = math.nan if isinstance(value, Part) else float(value)
            for one in _told(of, slot, given, where.inside(slot.json)):
                by_code.setdefault(one.problem.code, []).append(one)
    commas = [one for found in by_code.values() for one in found if _COMMA in one.problem.message]
    rows = (
        [commas + [one for found in by_code.values() for one in found if one not in commas]]
        if commas
        else by_code.values()
    )
    for first, *others in rows:
        more = f"; and {counted(len(others), 'more field')} of it" if others else ""
        problem = first.problem
        following = tuple(one.problem for one in others)
        yield Told(first.usual, replace(problem, message=problem.message + more, following=following))
    for slot in outer:
        value = getattr(part, slot.name, None)
        if isinstance(value, Part):
            yield from _inside(context, units, value, part, where.inside(slot.json))
        elif isinstance(value, Table):
            yield from _in_table(of, slot, value)
        for index, one in enumerate(value if isinstance(value, list) else ()):
            if isinstance(one, Part):
                yield from _inside(context, units, one, part, where.inside(slot.json, index))


def _in_table(of: Numbers, slot: FieldSpec, table: Table) -> Iterator[Told]:
    """What is unusual in a table: of a column the first row; where that is nothing, in the whole of it."""
    columns = record_schema(cast("type[Part]", slot.row)).columns
    names = [column.name for column in columns]
    for index, column in enumerate(columns):
        values = table.column(index) if column.about.usuals else np.zeros(0)
        limits = np.fmin.reduce(values, initial=0.0), np.fmax.reduce(values, initial=0.0)
        low, high = (float(limit) * of.units.size(column.about.unit) for limit in limits)
        if all(not usual.of and usual.low <= low and high <= usual.high for usual in column.about.usuals):
            continue
        for at, value in enumerate(values.tolist()):
            cells = SimpleNamespace(**dict(zip(names, table.values[at].tolist(), strict=False)))
            row = Numbers(of.context, of.units, cells, of.part, of.where, columns)
            if found := _told(row, column, value, of.where.inside(slot.json, at, index)):
                yield from found
                return
    yield from _told(replace(of, table=table, rows=cast("Rows", slot.about)), slot, math.nan, of.where)


# ----------------------------------------------------------------------------------------------------------- judgement


def _told(of: Numbers, slot: FieldSpec, value: float, where: Where) -> list[Told]:
    """The finding about a value (as the deck has it), for the first of its ranges that it is outside of; or none."""
    for usual in slot.about.usuals if not slot.about.fault(value) else ():
        if _is_unusual(of, slot, usual, value):
            code = UNT008 if usual.remark else _CODES[usual.code]
            message = f"{_seen(of, slot, usual, value)}: {_advice(of, slot, usual, value, where)}"
            return [Told(usual, Problem(code, message, where=where))]
    return []


def _quantity(of: Numbers, slot: FieldSpec, usual: Usual, value: float) -> float:
    """What is compared, of a number in SI."""
    if usual.of.startswith("/"):
        return over(value, of(usual.of[1:]))
    return MEASURES[usual.of](of, slot.name, value) if usual.of else value


def _is_unusual(of: Numbers, slot: FieldSpec, usual: Usual, value: float) -> bool:
    """Whether a value (as the deck has it) is outside of a range that holds for it."""
    unit = slot.about.unit
    if (value == 0.0 and usual.of[:1] in ("", "/")) or not (usual.of or of.units.compares(unit)):
        return False
    if (usual.when and not CONDITIONS[usual.when](of)) or usual.holds(
        _quantity(of, slot, usual, value * of.units.size(unit))
    ):
        return False
    placeholder = usual.placeholder and is_placeholder(value)
    return not (placeholder or usual.explained) or bool(_explanation(of, slot, usual, value, strict=placeholder))


def _explanation(of: Numbers, slot: FieldSpec, usual: Usual, value: float, *, strict: bool = False) -> str:
    """What a value looks like and what to write, in words, where a unit explains it."""
    unit = slot.about.unit
    if not math.isnan(usual.meant):
        found = meant_unit(
            usual, value, unit, of.units, lambda number: _quantity(of, slot, usual, number), strict=strict
        )
        return f"{value!r} looks like {found}, write it in{of.units.behind(unit)}" if found else ""
    quantity = _quantity(of, slot, usual, value * of.units.size(unit)) if usual.explained else math.nan
    which = next(
        (word for factor, word in _TIMES.items() if quantity and usual.low <= quantity * factor <= usual.high), ""
    )
    return f"it looks like a unit 1000 times {which}, write both in one unit" if which else ""


_TIMES = {1e3: "smaller", 1e-3: "larger"}
_COMMA = "a comma of thousands seems to stand in"
_THOUSANDS = re.compile(r"(?<![\d.,])\d{1,3},\d{3}(?:\.\d*)?(?![\d.,]*\d)")


def _seen(of: Numbers, slot: FieldSpec, usual: Usual, value: float) -> str:
    """What was found and what was expected, in words."""
    unit = slot.about.unit
    behind = of.units.behind(unit)
    written = int(value) if slot.kind is Kind.WHOLE and math.isfinite(value) else value
    said = f"{in_words(slot)} is {written!r}{behind}"
    if math.isnan(value):
        said = f"this {cast('Rows', slot.about).curve}" if of.table is not None else slot.about.meaning
    why = f" ({usual.why})" if usual.why else ""
    if not usual.of:
        return f"{said}, expected {usual.span(of.units.size(unit))}{behind}{why}"
    quantity = _quantity(of, slot, usual, value * of.units.size(unit))
    other = next((f"times {one.label}" for one in of.columns if usual.of == f"/{one.name}"), usual.of)
    return f"{said}, {quantity:.3g} {other}, expected {usual.span()}{why}"


def _advice(of: Numbers, slot: FieldSpec, usual: Usual, value: float, where: Where) -> str:
    """What to do about a value: the unit, the exchange or the comma that explains it."""
    if of.table is not None:
        return _advice_on_curve(of, slot, usual)
    alone = usual.remark or usual.of.startswith("/") or usual.code == "UNT006" or math.isnan(value)
    if found := _explanation(of, slot, usual, value) or ("" if alone else _exchange(of, slot, where)):
        return found
    unit = slot.about.unit
    words = likely_slips(usual, value, unit, of.units, lambda number: _quantity(of, slot, usual, number))
    return f"write it in{of.units.behind(unit)} ({words}?)" if words else f"correct it{_point(of, slot, usual, value)}"


def _point(of: Numbers, slot: FieldSpec, usual: Usual, value: float) -> str:
    """That a decimal point may be lost or misplaced, in words, or ""."""
    if slot.kind is Kind.WHOLE:
        return ""
    sized = value * of.units.size(slot.about.unit)
    return " (a decimal point?)" if lacks_point(usual, sized, lambda each: _quantity(of, slot, usual, each)) else ""


def _advice_on_curve(of: Numbers, slot: FieldSpec, usual: Usual) -> str:
    """What to do about a whole curve: exchange its columns, or write its ordinates in another unit."""
    columns = record_schema(cast("type[Part]", slot.row)).columns
    over, ordinate = (columns[axis] for axis in cast("Rows", slot.about).axes)
    quantity = _quantity(of, slot, usual, math.nan)
    if usual.of == "as a stiffness" and quantity > 0.0 and usual.holds(1.0 / quantity):
        first = min(over, ordinate, key=lambda column: column.order)
        return f"its columns seem to be exchanged, write {first.label} first"
    own = of.units.size(ordinate.about.unit)
    words = likely_slips(usual, 1.0, ordinate.about.unit, of.units, lambda size: quantity * size / own)
    return f"write {ordinate.label} in{of.units.behind(ordinate.about.unit)}" + (f" ({words}?)" if words else "")


def _exchange(of: Numbers, slot: FieldSpec, where: Where) -> str:
    """With which number beside it a value seems to be exchanged, or which comma is one too many; "" if none."""
    row = [(one, number(of.part, one.name)) for one in of.columns if not one.key and not one.row]
    row = [(one, value) for one, value in row if not math.isnan(value)]
    fields, values = [one for one, _ in row], [value for _, value in row]
    for left, (one, other) in enumerate(pairwise(fields)):
        exchanged = [*values[:left], values[left + 1], values[left], *values[left + 2 :]]
        real = one.kind is other.kind is Kind.REAL and 0.0 not in values[left : left + 2]
        if slot in (one, other) and real and _all_usual(of, fields, exchanged, (one, other)):
            return f"{one.label} and {other.label} seem to be exchanged, write {one.label} first"
    text = of.context.text
    line = text.source.line(text.place(Problem(UNT007, "", where=where)).line) if text else ""
    for comma in _THOUSANDS.finditer(line):
        left = line[: comma.start()].count(",")
        joined = [*values[:left], sum(values[left : left + 2], 999.0 * values[left]), *values[left + 2 :]]
        if len(joined) < len(values) and _all_usual(of, fields[:-1], joined, fields[:-1]):
            return f"{_COMMA} {comma[0]}, write {comma[0].replace(',', '')}"
    return ""


def _all_usual(of: Numbers, fields: Sequence[FieldSpec], values: Sequence[float], asked: Sequence[FieldSpec]) -> bool:
    """Whether some fields of a row would be usual, and allowed, if it had other values (as the deck has them)."""
    sized = {one.name: value * of.units.size(one.about.unit) for one, value in zip(fields, values, strict=True)}
    other = of.having(sized)
    return not any(
        one.about.fault(value) or any(_is_unusual(other, one, usual, value) for usual in one.about.usuals)
        for one, value in zip(fields, values, strict=True)
        if one in asked
    )


# ---------------------------------------------------------------------------------------------------------------- rules


@rule(UNT001)
def gravity_mismatch(context: LintContext) -> Iterator[Problem]:
    """The gravity of *OCEAN does not fit the unit system of the file.

    The suffix says in which units a deck is: .keyxm in metres and newtons, gravity 9.81; .keyxi in feet and pounds,
    gravity 32.2. A deck with the gravity of the other system was saved under the wrong suffix, or only half of it was
    converted. Correct the gravity, or give the file its suffix. A difference above 2 % is reported.

    Example on ocean:
        - 500.0, 1025.0, 32.2
        + 500.0, 1025.0, 9.81

    Finds: 3:17
    """
    return of_code(context, UNT001)


@rule(UNT002)
def suspicious_magnitude(context: LintContext) -> Iterator[Problem]:
    """A force or stiffness of the seabed looks as if it were in another unit.

    A seabed of less than 478 N/m for each metre (10 lbf/ft for each foot) supports no pipe, lateral springs and suction
    of less than 95 N/m for each metre (2 lbf/ft for each foot) hold none, a cohesion of less than 95 Pa (2 lbf/ft2) is
    that of a fluid, and all that is above 2.1E11 N/m2 is stiffer than steel. The largest force of a curve is compared
    with the submerged weight of the pipe that follows it: below a tenth of that the pipe lies deeper than the curve
    reaches. Where the weight is not known, it is compared with 10 N/m, for cables thinner than 0.1 m with less. Such a
    value is usually written in kilonewtons or kips. Write it in newtons or pounds. Zero is accepted.

    Example on seabed:
        - STIFFNESS=50.0
        + STIFFNESS=50000.0

    Finds: 5:12
    """
    return of_code(context, UNT002)


@rule(UNT003)
def large_friction(context: LintContext) -> Iterator[Problem]:
    """A friction coefficient is above 2.

    Pipes on soil have coefficients of 0.2 to 1, seldom a little more. Above 2 the field usually holds a stiffness or a
    mobilisation length: the fields of FRICTION= have another order than those of *ELASTIC SURFACE, which begin with the
    stiffness. Correct the field.

    Example on seabed:
          STIFFNESS=50000.0
        - FRICTION=50000.0, 0.3, 0.6
        + FRICTION=0.3, 0.6

    Finds: 6:11
    """
    return of_code(context, UNT003)


@rule(UNT004)
def suspicious_density(context: LintContext) -> Iterator[Problem]:
    """The density of the water or of a pipe wall looks as if it were in another unit.

    Densities are in kg/m3 in metric decks and in slug/ft3 in imperial ones. Water has 900 to 2500 kg/m3, heavy brines
    included; 0 and the density of air are accepted. 1.025 is t/m3, 64 is lb/ft3, and a density like a depth beside a
    depth like a density means that the two were exchanged. A wall has 10 to 40 000 kg/m3, as foam is light and the
    steel of a riser joint may carry the mass of all that is around it; 0 and powers of ten are accepted as
    placeholders. More in a section with an area of its own is reported only where it is steel in another unit. A pipe
    up to 2.5 m wide with the modulus of steel and without an area of its own has 7000 kg/m3 at least. In user units
    whose *OCEAN does not tell them only the ratio is checked: steel is 7 to 8.4 times as heavy as water, and not 1000
    times more or less than that.

    Example on ocean:
        - 500.0, 1.025, 9.81
        + 500.0, 1025.0, 9.81

    Finds: 3:9
    """
    return of_code(context, UNT004)


@rule(UNT005)
def suspicious_modulus(context: LintContext) -> Iterator[Problem]:
    """Young's modulus or the shear modulus looks as if it were in another unit, or the two do not fit each other.

    Moduli are in N/m2 in metric decks and in lbf/ft2 in imperial ones. Less than 1E5 N/m2 is softer than any rubber:
    207 is GPa, 207000 is MPa; 0 and powers of ten are accepted as placeholders. A steel wall (7000 kg/m3 or more) is
    also reported where its modulus is that of steel in kPa, psi, ksi or the unit of the other system. E and G of a
    material give Poisson's ratio, E/2G - 1, from 0 to 0.5: in any units, it is reported when negative, as it is when
    the two are exchanged, and when above 0.5 for metals (2600 kg/m3 and 60 GPa or more). Composites may have any. A
    section gets one finding, and FLEXIBLE, MOORING and TRUSS sections, which have no modulus, none.

    Example on pipe:
        - 207.0, 79.6, 0.3239, 0.2889, 7850.0
        + 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 12:2
    """
    return of_code(context, UNT005)


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

    In user units whose *OCEAN does not tell them only ratios are checked: masses against displaced water, bores of
    walls as dense as steel, mobilisation lengths above 100 diameters, curves, elements, and nodes above ten depths.

    Example on pipe:
        - 207.0E9, 79.6E9, 323.9, 288.9, 7850.0
        + 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 12:19
    """
    yield from of_code(context, UNT006)
    for kind in (curves_over_lengths, odd_coordinates, height_over_depth):
        yield from kind(context)


@rule(UNT007)
def unusual_value(context: LintContext) -> Iterator[Problem]:
    """A value is far outside of what its field usually holds.

    The keyword's page says of every field what is usual, with the reason: a source, or mechanics. A wave of 106 m, a
    period of 1.4 s, a direction of 1800 degrees or a current of 13 m/s runs without a word, and its results look like
    others. The value is mostly in another unit or column, or has lost its decimal point: the message proposes what
    would explain it. Correct the value. Values are compared in SI: those of user units where *OCEAN tells which they
    are, and all that have no dimension.

    Example on storm:
        - 3.0, 9.0, 1800.0
        + 3.0, 9.0, 180.0

    Finds: 9:12
    """
    return of_code(context, UNT007)


@rule(UNT008)
def remarkable_value(context: LintContext) -> Iterator[Problem]:
    """A value is seldom so large or so small.

    Neither mechanics nor a source says that it is wrong, and it may well be meant: most decks have other values in this
    field, as its keyword's page says. Look at its unit and its decimal point once, or leave it.

    Example on storm:
          3.0, 9.0, 180.0
        |*CURRENT
        | TYPE=UNIFORM
        - 3.5, 0.0
        + 1.5, 0.0

    Finds: 12:2
    """
    return of_code(context, UNT008)


@joint(UNT004, UNT005, UNT006)
def water_in_another_mass(context: LintContext, found: Found) -> Iterator[Joined]:
    """In user units, whose are known by the density of the water: what follows from a density in another unit."""
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


@joint(*_CODES.values(), UNT008)
def lines_of_another_keyword(context: LintContext, found: Found) -> Iterator[Joined]:
    """What is unusual beside a line that does not fit its keyword: the lines may belong to one that is missing."""
    text = context.text
    if text is None:
        return
    unusual = [one for code in (*_CODES, UNT008.code) for one in found.get(code, ())]
    by_line = {text.place(one).line: one for one in unusual}
    for cause in (*found.get(SYN001.code, ()), *found.get(SYN003.code, ())):
        first = text.place(cause).line
        last = len(text.source.line_starts) + 1 if cause.code == SYN001 else first + 2
        below = takewhile(lambda line: text.source.line(line)[:1] not in ("*", "$"), range(first, last))
        yield Joined(cause, [by_line[line] for line in (first - 1, *below) if line in by_line])
