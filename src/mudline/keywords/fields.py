"""The text of one field to its value, by the kind of the field."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from mudline.codes import SYN002, SYN005, SYN015, SYN016
from mudline.diagnostics import Problem
from mudline.keywords.layout import Slot
from mudline.keywords.table import Column
from mudline.keywords.table_reading import fewest
from mudline.keywords.text import either, number_fault, shown, suggestion, whole_fault
from mudline.keywords.values import LARGEST_WHOLE, Equation, Kind, Label, unbraced_label
from mudline.syntax.fields import Field
from mudline.syntax.rows import read_number

Value = float | int | str | None

_WHOLE = re.compile(r"[-+]?[0-9]+")


class Reading(NamedTuple):
    """The value of a field, None when it has none, and what is wrong or doubtful about it."""

    value: Value
    problem: Problem | None = None


def read_value(field: Field, slot: Slot) -> Reading:
    """The value of a field that is not empty."""
    if slot.choices:
        return _choice(field, slot)
    if slot.kind is Kind.NAME:
        return Reading(field.text)
    if slot.kind is Kind.IDENT:
        return _ident(field, slot.label)
    if equation := Equation.match(field.text):
        return Reading(equation)
    return _number(field, slot.label, slot.kind or Kind.REAL)


def missing_braces(field: Field, label: Label) -> Problem:
    """The finding about a label without braces."""
    message = f"{shown(field.text)} is no number: is it the label {shown(label)}? Labels stand in braces"
    return Problem(SYN016, message, field.span)


def decimal_comma(fields: Sequence[Field], columns: Sequence[Column]) -> Problem | None:
    """The finding about a row of whole numbers whose count is right if every real one takes two fields, else None."""
    for length in range(max(fewest(columns), 1), len(columns) + 1):
        kinds = [column.kind for column in columns[:length]]
        twos = [kind in (Kind.REAL, Kind.REAL_OR_NAME) for kind in kinds]
        if length < len(fields) == length + sum(twos) <= _numbers_in(fields) + kinds.count(Kind.NAME):
            one, two = fields[twos.index(True) :][:2]
            pair, joined = shown(f"{one.text},{two.text}"), shown(f"{one.text}.{two.text}")
            message = f"decimal comma? {pair} is two fields here: write {joined}"
            return Problem(SYN015, message, one.span._replace(end=two.span.end))
    return None


def _numbers_in(fields: Sequence[Field]) -> int:
    return sum(_WHOLE.fullmatch(field.text) is not None for field in fields)


def _unreadable(field: Field, message: str) -> Reading:
    return Reading(None, Problem(SYN002, message, field.span))


def _choice(field: Field, slot: Slot) -> Reading:
    word = " ".join(field.text.upper().split())
    if word in slot.choices:
        return Reading(word)
    guess = suggestion(word, slot.choices)
    message = f"{shown(field.text)} is not allowed for {slot.label}: expected {either(slot.choices)}{guess}"
    return Reading(None, Problem(SYN005, message, field.span))


def _number(field: Field, label: str, kind: Kind) -> Reading:
    number = read_number(field.text)
    if number is not None:
        return _whole(field, number, label) if kind is Kind.WHOLE else Reading(number)
    if kind is Kind.REAL_OR_NAME and not field.text.startswith("=["):
        return Reading(field.text)
    return _unreadable(field, number_fault(field.text, label, kind.value))


def _whole(field: Field, number: float, label: str) -> Reading:
    if not number.is_integer() or abs(number) > LARGEST_WHOLE:
        return _unreadable(field, whole_fault(field.text, label))
    return Reading(int(number))


def _ident(field: Field, label: str) -> Reading:
    number = read_number(field.text)
    if number is not None:
        return _whole(field, number, label)
    if braced := Label.match(field.text):
        return Reading(braced)
    if guess := unbraced_label(field.text):
        return Reading(guess, missing_braces(field, guess))
    return _unreadable(field, number_fault(field.text, label, Kind.IDENT.value))
