"""Values outside of what is usual of their fields: what is compared, and the slip that explains each."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache, lru_cache
from itertools import pairwise
from types import SimpleNamespace
from typing import NamedTuple, cast

import numpy as np

from mudline.checks.context import LintContext
from mudline.checks.rules.coordinates import UNT006, height_over_depth
from mudline.checks.rules.data_files import operator_files
from mudline.checks.rules.measures import CONDITIONS, MEASURES, OF_DEPTH, WEIGHED, Numbers, over
from mudline.checks.unit_slips import Units, is_placeholder, lacks_point, likely_slips, meant_unit, units_of
from mudline.language.codes.fields import SYN015
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.model import FieldSpec, Part, Rows, record_schema
from mudline.language.keywords.ranges import in_words
from mudline.language.keywords.table import Table
from mudline.language.keywords.text import shown
from mudline.language.keywords.usual import BENT, Usual
from mudline.language.keywords.values import Kind
from mudline.model.scene.deck_values import number

UNT001 = Code("UNT001", "gravity-mismatch", Severity.WARNING)
UNT002 = Code("UNT002", "suspicious-magnitude", Severity.WARNING)
UNT003 = Code("UNT003", "large-friction", Severity.WARNING)
UNT004 = Code("UNT004", "suspicious-density", Severity.WARNING)
UNT005 = Code("UNT005", "suspicious-modulus", Severity.WARNING)
UNT007 = Code("UNT007", "unusual-value", Severity.WARNING)
UNT008 = Code("UNT008", "remarkable-value", Severity.INFO)

CODES = {code.code: code for code in (UNT001, UNT002, UNT003, UNT004, UNT005, UNT006, UNT007)}


def unusual_values(context: LintContext) -> list[Problem]:
    """What is outside of the usual values of its field; several rules need it, and ask `context.once`.

    Lines in which SYN015 found decimal commas are left out. Where gravity, a density or a length is unusual, the weight
    of a pipe counts as not known, and where nodes lie too high for it, the depth of the water.
    """
    deck = Numbers(context, units_of(context))
    with np.errstate(all="ignore"):  # numbers may be as large as they like
        judged = _of_deck(deck)
        measures = {one.usual.of for one in judged}
        heavy = bool(measures & WEIGHED) and any(one.problem.code in (UNT001, UNT004, UNT006) for one in judged)
        shallow = bool(measures & OF_DEPTH) and any(True for _ in height_over_depth(context))
        if heavy or shallow:
            judged = _of_deck(replace(deck, weighs=not heavy, deep=not shallow))
    found = [one.problem for one in judged]
    text = context.text
    commas = {text.place(problem).line for problem in context.problems_of(SYN015)} if text and found else set()
    return [one for one in found if not commas or not text or text.place(one).line not in commas]


def _of_deck(deck: Numbers) -> list[Judged]:
    placed = deck.context.scene.context.placed.values()
    own = [judged for blocks in placed for where, block in blocks for judged in _inside(deck, block, None, where)]
    return [*own, *_in_files(deck)]


def _in_files(deck: Numbers) -> Iterator[Judged]:
    """What is unusual in the files of operators that a deck names, one finding a file."""
    for file in deck.context.once(operator_files):
        from mudline.language.keywords.library.vessel_motions import VesselRao  # noqa: PLC0415 - few decks have one

        columns = record_schema(VesselRao).slots
        lines = next(slot for slot in columns if slot.name == "lines")
        of = replace(deck, where=file.where, columns=columns)
        for judged in _in_table(of, lines, Table(np.array(file.rows).reshape(len(file.rows), -1))):
            heading, frequency = file.rows[cast("int", cast("Where", judged.problem.where).path[-2])][:2]
            message = f"{file.name}, heading {heading:g}, frequency {frequency:g}: {judged.problem.message}"
            yield judged._replace(problem=replace(judged.problem, message=message, where=file.where))


def of_code(context: LintContext, code: Code) -> Iterator[Problem]:
    """The unusual values of one code."""
    return (one for one in context.once(unusual_values) if one.code is code)


# ------------------------------------------------------------------------------------------------------- what is judged


class Judged(NamedTuple):
    """A finding about a field, and the range that its value is outside of.

    `explains` are the fields of its row that are unusual for the same reason.
    """

    usual: Usual
    problem: Problem
    slot: FieldSpec
    explains: Sequence[FieldSpec]


@cache
def _judged(part: type[Part]) -> tuple[tuple[FieldSpec, ...], tuple[FieldSpec, ...]]:
    """The fields of a part that have usual values, and those that hold tables or parts with such fields."""
    slots = [slot for slot in record_schema(part).slots if slot.usuals or any(any(_judged(one)) for one in slot.parts)]
    own = tuple(slot for slot in slots if slot.usuals and not isinstance(slot.about, Rows))
    return own, tuple(slot for slot in slots if slot.parts)


def _inside(deck: Numbers, part: Part, holder: Part | None, where: Where) -> Iterator[Judged]:
    """What is unusual in a part and in those inside it: of a part one finding of each code, with others under it."""
    own, outer = _judged(type(part))
    if not (own or outer):
        return
    given = [
        (slot, math.nan if isinstance(value, Part) else float(value))
        for slot, low, high in (_ranges(type(part), deck.units) if own else ())
        if isinstance(value := getattr(part, slot.name, None), float | int | Part)
        and (isinstance(value, Part) or not low <= value <= high)
    ]
    if not (given or outer):
        return
    of = replace(deck, part=part, holder=holder, where=where, columns=record_schema(type(part)).slots)
    yield from _of_row([one for slot, value in given for one in _compared(of, slot, value, slot.json)])
    for slot in outer:
        value = getattr(part, slot.name, None)
        if isinstance(value, Part):
            yield from _inside(deck, value, part, where.inside(slot.json))
        elif isinstance(value, Table):
            yield from _in_table(of, slot, value)
        for index, one in enumerate(value if isinstance(value, list) else ()):
            if isinstance(one, Part):
                yield from _inside(deck, one, part, where.inside(slot.json, index))


@lru_cache(512)
def _ranges(part: type[Part], units: Units) -> list[tuple[FieldSpec, float, float]]:
    """The fields of a part that have usual values, each with the values (as the deck has them) that need no look.

    Where more is compared than the number itself, all need one: NaN.
    """
    found = []
    for slot in _judged(part)[0]:
        usuals, size = slot.usuals, units.size(slot.about.unit)
        low, high = max(usual.low for usual in usuals), min(usual.high for usual in usuals)
        plain = not any(usual.of for usual in usuals)
        found.append((slot, low / size if plain else math.nan, high / size if plain else math.nan))
    return found


def _of_row(found: Sequence[Judged]) -> Iterator[Judged]:
    """One finding of each code, with the others under it; one of all that an exchange or a comma explains."""
    cause = next((one for one in found if one.explains), None)
    explained = cause.explains if cause else ()
    rows: dict[Code | None, list[Judged]] = {}
    for one in sorted(found, key=lambda one: one is not cause):
        rows.setdefault(None if one is cause or one.slot in explained else one.problem.code, []).append(one)
    for first, *others in rows.values():
        more = f"; also unusual: {', '.join(in_words(one.slot) for one in others)}" if others else ""
        following = tuple(one.problem for one in others)
        problem = replace(first.problem, message=first.problem.message + more, following=following)
        yield first._replace(problem=problem)


def _in_table(of: Numbers, slot: FieldSpec, table: Table) -> Iterator[Judged]:
    """What is unusual in a table: of a column the first row; where that is nothing, in the whole of it."""
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
            if found := _compared(row, column, value, slot.json, at, index):
                yield from found
                return
    yield from _compared(replace(of, table=table, rows=cast("Rows", slot.about)), slot, math.nan)


# ----------------------------------------------------------------------------------------------------------- judgement


def _compared(of: Numbers, slot: FieldSpec, value: float, *path: str | int) -> list[Judged]:
    """The finding about a value (as the deck has it), for the first of its ranges that it is outside of; or none."""
    for usual in slot.usuals:
        if _is_unusual(of, slot, usual, value) and not slot.about.fault(value):
            where = of.where.inside(*path)
            code = UNT008 if usual.remark else CODES[usual.code]
            advice, explains = _advice(of, slot, usual, value, where)
            problem = Problem(code, f"{_seen(of, slot, usual, value)}: {advice}", where=where)
            return [Judged(usual, problem, slot, explains)]
    return []


def _quantity(of: Numbers, slot: FieldSpec, usual: Usual, value: float) -> float:
    """What is compared, of a number in SI."""
    if usual.of.startswith("/"):
        return over(value, of(usual.of[1:]))
    return MEASURES[usual.of](of, slot.name, value) if usual.of else value


def _is_unusual(of: Numbers, slot: FieldSpec, usual: Usual, value: float) -> bool:
    """Whether a value (as the deck has it) is outside of a range that holds for it."""
    unit = slot.about.unit
    if (value == 0.0 and usual.of[:1] in ("", "/")) or not (usual.of or of.units.known or of.units.compares(unit)):
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
    if not math.isnan(usual.typical):
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
_THOUSANDS = re.compile(r"(?<![\d.,])\d{1,3},\d{3}(?:\.\d*)?(?![\d.,]*\d)")


def _seen(of: Numbers, slot: FieldSpec, usual: Usual, value: float) -> str:
    """What was found and what was expected, in words."""
    unit = slot.about.unit
    behind = of.units.behind(unit)
    written = int(value) if slot.kind is Kind.WHOLE and math.isfinite(value) else value
    said = f"{in_words(slot)} is {written!r}{behind}"
    if math.isnan(value):
        said = f"the {cast('Rows', slot.about).curve}{_name(of.part)}" if of.table is not None else slot.about.meaning
    why = f" ({usual.why})" if usual.why else ""
    if not usual.of:
        return f"{said}, expected {usual.span(of.units.size(unit))}{behind}{why}"
    quantity = _quantity(of, slot, usual, value * of.units.size(unit))
    other = next((f"times {one.label}" for one in of.columns if usual.of == f"/{one.name}"), usual.of)
    return f"{said}, {float(f'{quantity:.3g}'):g} {other}, expected {usual.span()}{why}"


def _name(part: Part) -> str:
    """The name that a curve defines, in quotes behind a blank, or ""."""
    named = (getattr(part, slot.name) for slot in record_schema(type(part)).slots if slot.about.defines)
    return next((f" {shown(name)}" for name in named if isinstance(name, str)), "")


_Advice = tuple[str, Sequence[FieldSpec]]
"""What to do about a value, in words, and the fields of its row that this explains."""


def _advice(of: Numbers, slot: FieldSpec, usual: Usual, value: float, where: Where) -> _Advice:
    """What to do about a value: the unit, the exchange or the comma that explains it."""
    if of.table is not None:
        return _advice_on_curve(of, slot, usual), ()
    if usual.of.startswith("m "):  # a distance in space, of which the number is a part
        return "correct it", ()
    if found := _explanation(of, slot, usual, value):
        return found, ()
    alone = usual.remark or usual.of.startswith("/") or usual.code == "UNT006" or math.isnan(value)
    if not alone and (exchanged := _exchange(of, slot, where)):
        return exchanged
    unit = slot.about.unit
    words = likely_slips(usual, value, unit, of.units, lambda number: _quantity(of, slot, usual, number))
    point = _lacks_point(of, slot, usual, value)
    if not words:
        return "correct it (a decimal point?)" if point else "correct it", ()
    return f"{'correct its decimal point, or ' * point}write it in{of.units.behind(unit)} ({words}?)", ()


def _lacks_point(of: Numbers, slot: FieldSpec, usual: Usual, value: float) -> bool:
    """Whether a decimal point may be lost or misplaced."""
    sized = value * of.units.size(slot.about.unit)
    return slot.kind is not Kind.WHOLE and lacks_point(usual, sized, lambda each: _quantity(of, slot, usual, each))


def _advice_on_curve(of: Numbers, slot: FieldSpec, usual: Usual) -> str:
    """What to do about a whole curve: exchange its columns, or write its ordinates in another unit."""
    columns = record_schema(cast("type[Part]", slot.row)).columns
    over, ordinate = (columns[axis] for axis in cast("Rows", slot.about).axes)
    if usual is BENT:
        return f"write {over.label} in{of.units.behind(over.about.unit)}"
    quantity = _quantity(of, slot, usual, math.nan)
    if usual.of == "as a stiffness" and quantity > 0.0 and usual.holds(1.0 / quantity):
        first = min(over, ordinate, key=lambda column: column.order)
        return f"its columns seem to be exchanged, write {first.label} first"
    own = of.units.size(ordinate.about.unit)
    words = likely_slips(usual, 1.0, ordinate.about.unit, of.units, lambda size: quantity * size / own)
    return f"write {ordinate.label} in{of.units.behind(ordinate.about.unit)}" + (f" ({words}?)" if words else "")


def _exchange(of: Numbers, slot: FieldSpec, where: Where) -> _Advice | None:
    """With which number beside it a value seems to be exchanged, or which comma is one too many; None if none."""
    row = [(one, number(of.part, one.name)) for one in of.columns if not one.key and not one.row]
    row = [(one, value) for one, value in row if not math.isnan(value)]
    fields, values = [one for one, _ in row], [value for _, value in row]
    for left, (one, other) in enumerate(pairwise(fields)):
        exchanged = [*values[:left], values[left + 1], values[left], *values[left + 2 :]]
        real = one.kind is other.kind is Kind.REAL and 0.0 not in values[left : left + 2]
        if slot in (one, other) and real and _all_usual(of, fields, exchanged, (one, other)):
            return f"{one.label} and {other.label} seem to be exchanged, write {one.label} first", (one, other)
    text = of.context.text
    line = text.source.line(text.place(Problem(UNT007, "", where=where)).line) if text else ""
    for comma in _THOUSANDS.finditer(line):
        left = line[: comma.start()].count(",")
        joined = [*values[:left], sum(values[left : left + 2], 999.0 * values[left]), *values[left + 2 :]]
        if len(joined) < len(values) and _all_usual(of, fields[:-1], joined, fields[:-1]):
            return f"a comma of thousands seems to stand in {comma[0]}, write {comma[0].replace(',', '')}", fields
    return None


def _all_usual(of: Numbers, fields: Sequence[FieldSpec], values: Sequence[float], asked: Sequence[FieldSpec]) -> bool:
    """Whether some fields of a row would be usual, and allowed, if it had other values (as the deck has them)."""
    sized = {one.name: value * of.units.size(one.about.unit) for one, value in zip(fields, values, strict=True)}
    other = of.having(sized)
    return not any(
        one.about.fault(value) or any(_is_unusual(other, one, usual, value) for usual in one.usuals)
        for one, value in zip(fields, values, strict=True)
        if one in asked
    )
