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

from mudline.checks.context import LintContext
from mudline.checks.rules.coordinates import UNT006, height_over_depth
from mudline.checks.rules.measures import OF_DEPTH, OF_POINTS, WEIGHED, Numbers
from mudline.checks.rules.references import operator_files
from mudline.checks.unit_slips import DeckUnits, lacks_point, likely_slips, units_of
from mudline.language.codes.fields import SYN015
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.contents import in_words
from mudline.language.keywords.model import FieldSpec, Part, Path, Rows, record_schema
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


def of_code(context: LintContext, code: Code) -> list[Problem]:
    """Return the unusual values of one code."""
    return context.once(_by_code).get(code.code, [])


def _by_code(context: LintContext) -> dict[str, list[Problem]]:
    """Return the problems of values outside the usual range of their field by code.

    Lines in which SYN015 found decimal commas are left out. If gravity, a density or a length is unusual, the weight of
    a pipe counts as unknown. If nodes lie too high for the depth of the water, that depth counts as unknown.
    """
    deck = Numbers(context, units_of(context))
    with np.errstate(all="ignore"):  # numbers may be as large as they like
        judged = _of_deck(deck)
        measures = {each.usual.of for each in judged}
        heavy = bool(measures & WEIGHED) and any(each.problem.code in (UNT001, UNT004, UNT006) for each in judged)
        shallow = bool(measures & OF_DEPTH) and any(True for _ in height_over_depth(context))
        if heavy or shallow:
            judged = _of_deck(replace(deck, weighs=not heavy, deep=not shallow))
    text = context.text
    commas = {text.place(problem).line for problem in context.problems_of(SYN015)} if text and judged else set()
    by_code: dict[str, list[Problem]] = {}
    for problem in (each.problem for each in judged):
        if not commas or not text or text.place(problem).line not in commas:
            by_code.setdefault(problem.code.code, []).append(problem)
    return by_code


def _of_deck(deck: Numbers) -> list[Judged]:
    placed = deck.context.scene.context.placed.values()
    own = [judged for blocks in placed for where, block in blocks for judged in _inside(deck, block, None, where)]
    return [*own, *_in_files(deck)]


def _in_files(deck: Numbers) -> Iterator[Judged]:
    """Yield unusual values in the files of operators that a deck names, one finding for each file."""
    for file in deck.context.once(operator_files):
        from mudline.language.keywords.library.vessel_motions import VesselRao  # noqa: PLC0415 - few decks have one

        columns = record_schema(VesselRao).slots
        lines = next(slot for slot in columns if slot.name == "lines")
        of = replace(deck, where=file.where, columns=columns)
        for judged in _in_table(of, lines, Table(np.array(file.rows).reshape(len(file.rows), -1))):
            heading, frequency = file.rows[cast("int", cast("Where", judged.problem.where).path[-2])][:2]
            message = f"{file.name}, heading {heading:g}, frequency {frequency:g}: {judged.problem.message}"
            yield judged._replace(problem=replace(judged.problem, message=message, where=file.where))


# ------------------------------------------------------------------------------------------------------- what is judged


class Judged(NamedTuple):
    """Finding about a field, and the range that its value lies outside of.

    `explains` lists the fields of its row that are unusual for the same reason.
    """

    usual: Usual
    problem: Problem
    slot: FieldSpec
    explains: Sequence[FieldSpec]


def _inside(deck: Numbers, part: Part, holder: Part | None, where: Where, path: Path = ()) -> Iterator[Judged]:
    """Yield unusual values in a part and in the parts inside it, merged to one finding of each code for a part.

    `where` is the block, and `path` leads to the part in it.
    """
    own, outer = _judged(type(part), deck.units)
    suspects = [
        (slot, math.nan if isinstance(value, Part) else float(value))
        for slot, low, high in own
        if isinstance(value := getattr(part, slot.name, None), float | int | Part)
        and (isinstance(value, Part) or not low <= value <= high)
    ]
    held = [(slot, value) for slot in outer if (value := getattr(part, slot.name, None))]
    tables = [(slot, value) for slot, value in held if isinstance(value, Table)]
    if suspects or tables:
        of = replace(deck, part=part, holder=holder, where=where.inside(*path), columns=record_schema(type(part)).slots)
        yield from _of_row([entry for slot, value in suspects for entry in _compared(of, slot, value, slot.json)])
        for slot, table in tables:
            yield from _in_table(of, slot, table)
    for slot, value in held:
        if isinstance(value, Part):
            yield from _inside(deck, value, part, where, (*path, slot.json))
        for index, item in enumerate(value if isinstance(value, list) else ()):
            if isinstance(item, Part) and any(_judged(type(item), deck.units)):
                yield from _inside(deck, item, part, where, (*path, slot.json, index))


@lru_cache(512)
def _judged(part: type[Part], units: DeckUnits) -> tuple[list[tuple[FieldSpec, float, float]], list[FieldSpec]]:
    """Return the fields of a part that have usual values, and those that hold tables or parts with such fields.

    Each field has the range (as in the deck) that needs no check. If a field compares more than the number itself,
    every value needs a check: the range is NaN.
    """
    ranges = []
    for slot in (slot for slot in record_schema(part).slots if slot.usuals and not isinstance(slot.about, Rows)):
        usuals, size = slot.usuals, units.size(slot.about.unit)
        low, high = max(usual.low for usual in usuals), min(usual.high for usual in usuals)
        plain = not any(usual.of for usual in usuals)
        ranges.append((slot, low / size if plain else math.nan, high / size if plain else math.nan))
    slots = [slot for slot in record_schema(part).slots if slot.parts]
    return ranges, [slot for slot in slots if slot.usuals or any(any(_judged(sub, units)) for sub in slot.parts)]


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


_Advice = tuple[str, Sequence[FieldSpec]]
"""Advice on a value in words, and the fields of its row that it explains."""


def _advice(of: Numbers, slot: FieldSpec, usual: Usual, value: float, where: Where) -> _Advice:
    """Return the advice on a value: the unit, the exchange or the comma that explains it."""
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


def _exchange(of: Numbers, slot: FieldSpec, where: Where) -> _Advice | None:
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
