"""Values outside the usual range of their fields: the compared quantity, and the slip that explains each value."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from itertools import pairwise
from types import SimpleNamespace
from typing import NamedTuple, cast

import numpy as np

from mudline.basics.units import UnitSystem
from mudline.checks.context import LintContext
from mudline.checks.rules.measures import OF_DEPTH, OF_POINTS, WEIGHED, Numbers
from mudline.checks.rules.references import operator_files
from mudline.checks.rules.seabed_position import UNT006, height_over_depth
from mudline.checks.rules.slips import (
    CODES,
    UNT001,
    UNT002,
    UNT003,
    UNT004,
    UNT005,
    UNT007,
    UNT008,
    deck_units,
    lacks_point,
    likely_slips,
)
from mudline.language.codes.fields import SYN015
from mudline.language.diagnostics import Code, Problem, Where
from mudline.language.keywords.contents import in_words
from mudline.language.keywords.model import FieldSpec, Part, Path, Rows, fields_of, has_fields, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.text import shown
from mudline.language.keywords.usual import BENT, Usual
from mudline.language.keywords.values import Kind
from mudline.language.rules import rule
from mudline.model.scene.deck_values import number


def of_code(context: LintContext, code: Code) -> list[Problem]:
    """Return the unusual values of one code."""
    return context.once(_by_code).get(code.code, [])


def _by_code(context: LintContext) -> dict[str, list[Problem]]:
    """Return the problems of values outside the usual range of their field by code.

    Lines in which SYN015 found decimal commas are left out. If gravity, a density or a length is unusual, the weight of
    a pipe counts as unknown. If nodes lie too high for the depth of the water, that depth counts as unknown.
    """
    deck = Numbers(context, deck_units(context))
    with np.errstate(all="ignore"):  # numbers may be as large as they like
        judged = _of_deck(deck)
        measures = {each.usual.of for each in judged}
        heavy = bool(measures & WEIGHED) and any(each.problem.code in (UNT001, UNT004, UNT006) for each in judged)
        shallow = bool(measures & OF_DEPTH) and any(True for _ in height_over_depth(context))
        if heavy or shallow:
            judged = _of_deck(replace(deck, weighs=not heavy, deep=not shallow))
    place = context.deck.origin.place
    commas = {place(problem).line for problem in context.problems_of(SYN015)} if judged else set()
    by_code: dict[str, list[Problem]] = {}
    for problem in (each.problem for each in judged):
        if not commas or place(problem).line not in commas:
            by_code.setdefault(problem.code.code, []).append(problem)
    return by_code


def _of_deck(deck: Numbers) -> list[Judged]:
    placed = deck.context.scene.context.placed.values()
    own = [judged for blocks in placed for where, block in blocks for judged in _inside(deck, block, where)]
    return [*own, *_in_files(deck)]


def _in_files(deck: Numbers) -> Iterator[Judged]:
    """Yield unusual values in the files of operators that a deck names, one finding for each file."""
    for where, name, rows in deck.context.once(operator_files):
        from mudline.language.keywords.library.vessel_motions import VesselRao  # noqa: PLC0415 - few decks have one

        columns = record_schema(VesselRao).slots
        lines = next(slot for slot in columns if slot.name == "lines")
        of = replace(deck, where=where, columns=columns)
        for judged in _in_table(of, lines, Table(np.array(rows).reshape(len(rows), -1))):
            heading, frequency = rows[cast("int", cast("Where", judged.problem.where).path[-2])][:2]
            message = f"{name}, heading {heading:g}, frequency {frequency:g}: {judged.problem.message}"
            yield judged._replace(problem=replace(judged.problem, message=message, where=where))


# ------------------------------------------------------------------------------------------------------- what is judged


class Judged(NamedTuple):
    """Finding about a field, and the range that its value lies outside of.

    `explains` lists the fields of its row that are unusual for the same reason.
    """

    usual: Usual
    problem: Problem
    slot: FieldSpec
    explains: Sequence[FieldSpec]


def _inside(deck: Numbers, block: Part, where: Where) -> Iterator[Judged]:
    """Yield unusual values in a block, merged to one finding of each code for a part."""
    parts: dict[Path, Part] = {(): block}
    if has_fields(type(block), _is_judged):
        parts |= {path: part for path, _, part in block.walk(_is_judged) if isinstance(part, Part)}
    for path, part in parts.items():
        own, listed = _judged(type(part), deck.units)
        suspects = [
            (slot, math.nan if isinstance(value, Part) else float(value))
            for slot, low, high in own
            if isinstance(value := getattr(part, slot.name, None), float | int | Part)
            and (isinstance(value, Part) or not low <= value <= high)
        ]
        tables = [(slot, value) for slot in listed if (value := getattr(part, slot.name, None))]
        if suspects or tables:
            holder = parts[path[: -2 if isinstance(path[-1], int) else -1]] if path else None
            place, columns = where.inside(*path) if path else where, record_schema(type(part)).slots
            of = replace(deck, part=part, holder=holder, where=place, columns=columns)
            yield from _of_row([entry for slot, value in suspects for entry in _compared(of, slot, value, slot.json)])
            for slot, table in tables:
                yield from _in_table(of, slot, table)


def _is_judged(slot: FieldSpec) -> bool:
    """Return True if a field holds parts or a table with usual values."""
    return any(inner.usuals for part in slot.parts for inner in fields_of(part))


@lru_cache(512)
def _judged(part: type[Part], units: UnitSystem) -> tuple[list[tuple[FieldSpec, float, float]], list[FieldSpec]]:
    """Return the fields of a part that have usual values, and its tables that have them.

    Each field has the range (as in the deck) that needs no check. If a field compares more than the number itself,
    every value needs a check: the range is NaN.
    """
    ranges = []
    for slot in (slot for slot in record_schema(part).slots if slot.usuals and not isinstance(slot.about, Rows)):
        usuals, size = slot.usuals, units.size(slot.about.unit)
        low, high = max(usual.low for usual in usuals), min(usual.high for usual in usuals)
        plain = not any(usual.of for usual in usuals)
        ranges.append((slot, low / size if plain else math.nan, high / size if plain else math.nan))
    return ranges, [slot for slot in record_schema(part).tables if slot.usuals or _is_judged(slot)]


def _of_row(row: Sequence[Judged]) -> Iterator[Judged]:
    """Yield one finding of each code with the others merged into it, or one for what an exchange explains."""
    cause = next((judged for judged in row if judged.explains), None)
    explained = cause.explains if cause else ()
    rows: dict[Code | None, list[Judged]] = {}
    for judged in sorted(row, key=lambda judged: judged is not cause):
        rows.setdefault(None if judged is cause or judged.slot in explained else judged.problem.code, []).append(judged)
    for first, *others in rows.values():
        more = f"; also unusual: {', '.join(in_words(judged.slot) for judged in others)}" if others else ""
        following = tuple(judged.problem for judged in others)
        problem = replace(first.problem, message=first.problem.message + more, following=following)
        yield first._replace(problem=problem)


def _in_table(of: Numbers, slot: FieldSpec, table: Table) -> Iterator[Judged]:
    """Yield unusual values in a table: the first row of a column, or else of the table as a whole."""
    columns = record_schema(cast("type[Part]", slot.row)).columns
    names = [column.name for column in columns]
    for index, column in enumerate(columns):
        if not column.usuals:
            continue
        values = table.column(index)
        limits = np.fmin.reduce(values, initial=0.0), np.fmax.reduce(values, initial=0.0)
        low, high = (float(limit) * of.units.size(column.about.unit) for limit in limits)
        if all(not usual.of and usual.low <= low and high <= usual.high for usual in column.usuals):
            continue
        for at, value in enumerate(values.tolist()):
            cells = SimpleNamespace(**dict(zip(names, table.values[at].tolist(), strict=False)))
            row = replace(of, part=cells, holder=of.part, columns=columns)
            if judged := _compared(row, column, value, slot.json, at, index):
                yield from judged
                return
    if slot.usuals:
        yield from _compared(replace(of, table=table, rows=cast("Rows", slot.about)), slot, math.nan)


# ----------------------------------------------------------------------------------------------------------- judgement


def _compared(of: Numbers, slot: FieldSpec, value: float, *path: str | int) -> list[Judged]:
    """Return the finding about a value (as in the deck), for the first range that it lies outside of, or none."""
    usual = of.outside(slot, value)
    if usual is None:
        return []
    where = of.where.inside(*path)
    advice, explains = _advice(of, slot, usual, value, where)
    code = UNT008 if usual.remark else CODES[usual.code]
    return [Judged(usual, Problem(code, f"{_seen(of, slot, usual, value)}: {advice}", where=where), slot, explains)]


_THOUSANDS = re.compile(r"(?<![\d.,])\d{1,3},\d{3}(?:\.\d*)?(?![\d.,]*\d)")


def _seen(of: Numbers, slot: FieldSpec, usual: Usual, value: float) -> str:
    """Return the value found and the value expected in words."""
    unit = slot.about.unit
    behind = of.units.behind(unit)
    written = int(value) if slot.kind is Kind.WHOLE and math.isfinite(value) else value
    subject = f"{in_words(slot)} is {written!r}{behind}"
    if math.isnan(value):
        subject = (
            f"the {cast('Rows', slot.about).curve}{_name(of.part)}" if of.table is not None else slot.about.meaning
        )
    why = f" ({usual.why})" if usual.why else ""
    if not usual.of:
        return f"{subject}, expected {usual.span(of.units.size(unit))}{behind}{why}"
    quantity = of.quantity(slot, usual, value * of.units.size(unit))
    what = next((f"times {col.label}" for col in of.columns if usual.of == f"/{col.name}"), usual.of)
    return f"{subject}, {float(f'{quantity:.3g}'):g} {what}, expected {usual.span()}{why}"


def _name(part: Part) -> str:
    """Return the name that a curve defines, in quotes after a space, or ""."""
    named = (getattr(part, slot.name) for slot in record_schema(type(part)).slots if slot.about.defines)
    return next((f" {shown(name)}" for name in named if isinstance(name, str)), "")


def _advice(of: Numbers, slot: FieldSpec, usual: Usual, value: float, where: Where) -> tuple[str, Sequence[FieldSpec]]:
    """Return the unit, the exchange or the comma that explains a value, in words, and the fields that it explains."""
    if of.table is not None:
        return _advice_on_curve(of, slot, usual), ()
    if usual.of.startswith("m "):  # a distance in space, of which the number is a part
        return "correct it", ()
    if explanation := of.explanation(slot, usual, value):
        return explanation, ()
    alone = usual.remark or usual.of.startswith("/") or usual.code == "UNT006" or math.isnan(value)
    if not alone and (exchanged := _exchange(of, slot, where)):
        return exchanged
    unit, measured = slot.about.unit, partial(of.quantity, slot, usual)
    words = likely_slips(usual, value, unit, of.units, measured)
    point = slot.kind is not Kind.WHOLE and lacks_point(usual, value * of.units.size(unit), measured)
    if not words:
        return "correct it (a decimal point?)" if point else "correct it", ()
    return f"{'correct its decimal point, or ' * point}write it in{of.units.behind(unit)} ({words}?)", ()


def _advice_on_curve(of: Numbers, slot: FieldSpec, usual: Usual) -> str:
    """Return the advice on a whole curve: exchange its columns, or write its ordinates in another unit."""
    columns = record_schema(cast("type[Part]", slot.row)).columns
    over, ordinate = (columns[axis] for axis in cast("Rows", slot.about).axes)
    if usual.of in OF_POINTS:
        return "correct its points"
    if usual is BENT:
        return f"write {over.label} in{of.units.behind(over.about.unit)}"
    quantity = of.quantity(slot, usual, math.nan)
    if usual.of == "as a stiffness" and quantity > 0.0 and usual.holds(1.0 / quantity):
        first = min(over, ordinate, key=lambda column: column.order)
        return f"its columns seem to be exchanged, write {first.label} first"
    own = of.units.size(ordinate.about.unit)
    words = likely_slips(usual, 1.0, ordinate.about.unit, of.units, lambda size: quantity * size / own)
    return f"write {ordinate.label} in{of.units.behind(ordinate.about.unit)}" + (f" ({words}?)" if words else "")


def _exchange(of: Numbers, slot: FieldSpec, where: Where) -> tuple[str, Sequence[FieldSpec]] | None:
    """Return the advice to exchange a value with its neighbour, or to remove a comma of thousands, if either fits."""
    row = [(first, number(of.part, first.name)) for first in of.columns if not first.key and not first.row]
    row = [(first, value) for first, value in row if not math.isnan(value)]
    fields, values = [first for first, _ in row], [value for _, value in row]
    for left, (first, second) in enumerate(pairwise(fields)):
        exchanged = [*values[:left], values[left + 1], values[left], *values[left + 2 :]]
        real = first.kind is second.kind is Kind.REAL and 0.0 not in values[left : left + 2]
        if slot in (first, second) and real and _all_usual(of, fields, exchanged, (first, second)):
            return f"{first.label} and {second.label} seem to be exchanged, write {first.label} first", (first, second)
    text = of.context.text
    line = text.source.line(text.place(Problem(UNT007, "", where=where)).line) if text else ""
    for comma in _THOUSANDS.finditer(line):
        left = line[: comma.start()].count(",")
        joined = [*values[:left], sum(values[left : left + 2], 999.0 * values[left]), *values[left + 2 :]]
        if len(joined) < len(values) and _all_usual(of, fields[:-1], joined, fields[:-1]):
            return f"{comma[0]} seems to have a thousands comma, write {comma[0].replace(',', '')}", fields
    return None


def _all_usual(of: Numbers, fields: Sequence[FieldSpec], values: Sequence[float], asked: Sequence[FieldSpec]) -> bool:
    """Return True if the `asked` fields of a row would be usual, and allowed, with these values (as in the deck)."""
    row = [*zip(fields, values, strict=True)]
    changed = replace(of, changed={slot.name: value * of.units.size(slot.about.unit) for slot, value in row})
    return not any(slot.about.fault(value) or changed.outside(slot, value) for slot, value in row if slot in asked)


# --------------------------------------------------------------------------------------------------------------- rules


@rule(UNT001)
def gravity_mismatch(context: LintContext) -> Iterator[Problem]:
    """The gravity of *OCEAN does not fit the unit system of the file.

    The suffix gives the units of a deck: .keyxm is in metres and newtons, gravity 9.81; .keyxi in feet and pounds,
    gravity 32.2. A deck with the gravity of the other system was saved under the wrong suffix, or only half of it
    was converted. Correct the gravity, or give the file its suffix. A difference above 2 % is reported.

    Example on ocean:
        - 500.0, 1025.0, 32.2
        + 500.0, 1025.0, 9.81

    Finds: 3:17
    """
    yield from of_code(context, UNT001)


@rule(UNT002)
def suspicious_magnitude(context: LintContext) -> Iterator[Problem]:
    """A force or stiffness of the seabed seems to be in another unit.

    Too small are:

    * a seabed stiffness below 478 N/m for each metre (10 lbf/ft for each foot), which supports no pipe;
    * lateral springs and suction below 95 N/m for each metre (2 lbf/ft for each foot), which hold no pipe;
    * a cohesion below 95 Pa (2 lbf/ft2), which is that of a fluid;
    * a curve whose largest force is below a tenth of the submerged weight of its pipe, which then lies deeper than the
      curve reaches. If the weight is not known, the limit is 10 N/m, and less for cables thinner than 0.1 m.

    Any stiffness above 2.1E11 N/m2 is stiffer than steel. Such values are usually written in kilonewtons or kips. Write
    them in newtons or pounds. Zero is accepted.

    Example on seabed:
        - STIFFNESS=50.0
        + STIFFNESS=50000.0

    Finds: 5:12
    """
    yield from of_code(context, UNT002)


@rule(UNT003)
def large_friction(context: LintContext) -> Iterator[Problem]:
    """A friction coefficient is above 2.

    Pipes on soil have coefficients of 0.2 to 1, seldom a little more. Above 2 the field usually holds a stiffness or a
    mobilisation length: FRICTION= has another field order than *ELASTIC SURFACE, which begins with the stiffness.
    Correct the field.

    Example on seabed:
          STIFFNESS=50000.0
        - FRICTION=50000.0, 0.3, 0.6
        + FRICTION=0.3, 0.6

    Finds: 6:11
    """
    yield from of_code(context, UNT003)


@rule(UNT004)
def suspicious_density(context: LintContext) -> Iterator[Problem]:
    """The density of the water or of a pipe wall seems to be in another unit.

    Densities are in kg/m3 in metric decks and in slug/ft3 in imperial decks.

    * Water has 900 to 2500 kg/m3, heavy brines included; 0 and the density of air are accepted. 1.025 is t/m3, and 64
      is lb/ft3. If the density looks like a depth, and the depth like a density, the two were exchanged.
    * A wall has 10 to 40 000 kg/m3, as foam is light, and the steel of a riser joint may carry the mass of all that is
      around it. 0 and powers of ten are accepted as placeholders. In a section with its own area a larger density is
      reported only if it is steel in another unit.
    * A pipe up to 2.5 m wide with the modulus of steel and without its own area has at least 7000 kg/m3.
    * In user units that *OCEAN does not reveal only the ratio is checked: steel is 7 to 8.4 times as heavy as water,
      and not 1000 times more or less than that.

    Example on ocean:
        - 500.0, 1.025, 9.81
        + 500.0, 1025.0, 9.81

    Finds: 3:9
    """
    yield from of_code(context, UNT004)


@rule(UNT005)
def suspicious_modulus(context: LintContext) -> Iterator[Problem]:
    """Young's modulus or the shear modulus seems to be in another unit, or the two do not fit each other.

    Moduli are in N/m2 in metric decks and in lbf/ft2 in imperial decks.

    * Less than 1E5 N/m2 is softer than any rubber (207 is GPa, 207000 is MPa). 0 and powers of ten are accepted as
      placeholders.
    * A steel wall (7000 kg/m3 or more) is also reported if its modulus is that of steel in kPa, psi, ksi or the unit of
      the other system.
    * E and G of a material give Poisson's ratio, E/2G - 1, from 0 to 0.5, in any units. A negative ratio, which
      exchanged moduli give, is reported. A ratio above 0.5 is reported for metals (2600 kg/m3 and 60 GPa or more).
      Composites may have any ratio.

    A section gets one finding at most. FLEXIBLE, MOORING and TRUSS sections have no modulus and get none.

    Example on pipe:
        - 207.0, 79.6, 0.3239, 0.2889, 7850.0
        + 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 12:2
    """
    yield from of_code(context, UNT005)


@rule(UNT007)
def unusual_value(context: LintContext) -> Iterator[Problem]:
    """A value is far outside the usual range of its field.

    The keyword's page gives the usual range of every field with its reason: a source, or mechanics. A wave of 106 m, a
    period of 1.4 s, a direction of 1800 degrees or a current of 13 m/s runs without a warning, and its results look
    plausible. The value is mostly in another unit or column, or has lost its decimal point: the message proposes an
    explanation. Correct the value. Values are compared in SI. In user units they are compared if *OCEAN reveals the
    units, or if they have no dimension.

    Example on storm:
        - 3.0, 9.0, 1800.0
        + 3.0, 9.0, 180.0

    Finds: 9:12
    """
    yield from of_code(context, UNT007)


@rule(UNT008)
def remarkable_value(context: LintContext) -> Iterator[Problem]:
    """A value is unusually large or small, but not impossible.

    Neither mechanics nor a source says that it is wrong, and it may well be intended. Most decks have other values in
    this field, as its keyword's page says. Check its unit and its decimal point once, or leave it.

    Example on storm:
          3.0, 9.0, 180.0
        |*CURRENT
        | TYPE=UNIFORM
        - 3.5, 0.0
        + 1.5, 0.0

    Finds: 12:2
    """
    yield from of_code(context, UNT008)
