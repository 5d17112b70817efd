"""The text of one field to its value, by the kind of the field."""

from __future__ import annotations

from difflib import get_close_matches

from mudline.codes import SYN002, SYN005, SYN015, SYN016
from mudline.diagnostics import Problem
from mudline.keywords.model import Slot
from mudline.keywords.values import Equation, Kind, Label
from mudline.syntax.fields import Field
from mudline.syntax.rows import read_number

Value = float | int | str | None
LARGEST_WHOLE = 2.0**53


class Unreadable(Exception):
    """A field that gives no value; the problem is the reason."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        super().__init__(problem.message)


def read_value(field: Field, slot: Slot, problems: list[Problem]) -> Value:
    """The value of a field; raises Unreadable. What is only doubtful is added to `problems`."""
    if slot.choices:
        return _choice(field, slot)
    if slot.kind is Kind.NAME:
        return field.text
    if equation := Equation.match(field.text):
        return equation
    number = read_number(field.text)
    match slot.kind:
        case Kind.REAL_OR_NAME:
            return field.text if number is None else number
        case Kind.WHOLE:
            return _whole(field, number, slot)
        case Kind.IDENT:
            return _ident(field, number, slot, problems)
        case _:
            if number is None:
                raise Unreadable(Problem(SYN002, number_fault(field.text, slot.label), field.span))
            return number


def number_fault(text: str, label: str) -> str:
    """Why a text is no number, in words that say what to do."""
    lower = text.lower().lstrip("+-")
    if lower in ("nan", "inf", "infinity"):
        return f"{text!r} is not a finite number: {label} needs a number"
    if text.startswith(("[", "=")):
        return f"{text!r} is no equation: write =[...] for {label}"
    if lower[:1].isdigit() and any(mark in lower for mark in "ed"):
        try:
            float(lower.replace("d", "e"))
        except ValueError:
            pass
        else:
            return f"{text} is too large for a double-precision number: {label} must be below 1.8E308"
    return f"{shown(text)} is no number: expected a number or an equation =[...] for {label}"


def shown(text: str) -> str:
    """A text of the deck in quotes, cut when long."""
    return repr(text if len(text) <= 60 else text[:57] + "...")


def suggestion(word: str, known: list[str]) -> str:
    """` (did you mean X?)` for the nearest known word, or nothing."""
    near = get_close_matches(word, known, 1, 0.75)
    return f" (did you mean {near[0]}?)" if near else ""


def decimal_comma(values: list[Field], expected: int) -> bool:
    """Whether a row of whole numbers with twice the fields expected looks like decimal commas."""
    return len(values) == 2 * expected and all(field.text.lstrip("+-").isdecimal() for field in values)


def decimal_comma_problem(values: list[Field]) -> Problem:
    """The finding about a decimal comma."""
    pair = f"{values[0].text},{values[1].text}"
    message = f"decimal comma? {pair} is two fields here: write {values[0].text}.{values[1].text}"
    return Problem(SYN015, message, values[0].span._replace(end=values[-1].span.end))


def _choice(field: Field, slot: Slot) -> str:
    word = " ".join(field.text.upper().split())
    if word in slot.choices:
        return word
    known = list(slot.choices)
    listed = ", ".join(known[:-1]) + f" or {known[-1]}" if len(known) > 1 else known[0]
    message = f"{shown(field.text)} is not allowed for {slot.label}: expected {listed}{suggestion(word, known)}"
    raise Unreadable(Problem(SYN005, message, field.span))


def _whole(field: Field, number: float | None, slot: Slot) -> int:
    if number is None:
        raise Unreadable(Problem(SYN002, number_fault(field.text, slot.label), field.span))
    if not number.is_integer() or abs(number) > LARGEST_WHOLE:
        message = f"{field.text} is no whole number: {slot.label} needs one"
        raise Unreadable(Problem(SYN002, message, field.span))
    return int(number)


def _ident(field: Field, number: float | None, slot: Slot, problems: list[Problem]) -> int | Label:
    if number is not None:
        return _whole(field, number, slot)
    if label := Label.match(field.text):
        return label
    braced = Label.match("{" + field.text + "}")
    if braced is None or not field.text or not field.text[0].isalpha():
        raise Unreadable(Problem(SYN002, number_fault(field.text, slot.label), field.span))
    message = f"{shown(field.text)} is no number: is it the label {braced}? Labels stand in braces"
    problems.append(Problem(SYN016, message, field.span))
    return braced
