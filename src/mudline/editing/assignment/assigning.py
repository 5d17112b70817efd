"""One value of a deck set: the edits of its text, aligned as before, or why the deck is left unchanged."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import cast

import numpy as np

from mudline.basics.arguments import ArgumentKindError
from mudline.basics.limits import LISTED
from mudline.basics.short_repr import cut
from mudline.basics.spelling import nearest
from mudline.editing.assignment.fields import Target, Value, blocks_of, target_of, values_of
from mudline.editing.assignment.paths import Assignment, Operand, parse_path
from mudline.language.codes.fields import SYN003
from mudline.language.deck.meaning import same_meaning
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import TextOrigin, read_source
from mudline.language.diagnostics import Diagnostic, Problem, Severity, Where
from mudline.language.keywords.model import Part, record_schema
from mudline.language.keywords.ranges import range_fault
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import Equation, Kind
from mudline.language.syntax.edits import TextEdit, edited_bytes
from mudline.language.syntax.layout import replacement_in_layout
from mudline.language.syntax.source import Source
from mudline.model.scene.model import resolve


class AssignmentError(ValueError):
    """Why a deck is left unchanged; `line` is where, None for the deck as a whole."""

    def __init__(self, message: str, line: int | None = None, diagnostics: Sequence[Diagnostic] = ()) -> None:
        self.line = line
        self.diagnostics = diagnostics
        super().__init__(message)


@dataclass(frozen=True, slots=True)
class Assigned:
    """The edits that set a value, none where it has it already; its line, and how it was and is written."""

    edits: tuple[TextEdit, ...]
    line: int
    before: str
    after: str


def assigned(deck: Deck, assignment: Assignment, target: Target, units: str | None = None) -> Assigned | None:
    """Set the value of a deck that was read from keyword text; None where the deck has no such value.

    `units` are those with which the deck was read. Raises AssignmentError for a value that is given by an equation, is
    left out in the deck, or is not the only one at the path, and for a deck that would be faulty, or another one but
    for this value.
    """
    operand = Operand.of(assignment.value)
    if not any(field.fits(operand) for field in target.fields):
        if next(values_of(deck, target), None) is None:
            return None
        expected = " or ".join(dict.fromkeys(_kinds(target)))
        near = nearest(assignment.value, {choice for field in target.fields for choice in field.slot.choices})
        hint = f" (did you mean {near}?)" if near else ""
        raise AssignmentError(f"{target.path} cannot be {assignment.value!r}: expected {expected}{hint}")
    found = _the_one(deck, target)
    if found is None:
        return None
    origin = cast("TextOrigin", deck.origin)
    span = origin.span(found.where)
    line = _line(deck, found)
    place = found.where._replace(path=found.where.path[:-2]) if isinstance(found.owner, Table) else found.where
    if span is None or not deck.written(place):
        raise AssignmentError(f"{target.path} is not written in the deck", line)
    if isinstance(found.value, Equation):
        raise AssignmentError(
            f"{target.path} is given by an equation, {cut(str(found.value), 60)}: change its parameters instead", line
        )
    wanted = _checked(found, operand, assignment, line)
    written = origin.source.text[slice(*span)]
    if _same(found.value, wanted):
        return Assigned((), line, written, written)
    edits = tuple(replacement_in_layout(origin.source, span, assignment.value))
    try:
        content = edited_bytes(origin.source, edits)
    except UnicodeEncodeError as error:
        message = f"the file's encoding, {origin.source.encoding}, lacks a character of the value"
        raise AssignmentError(message, line) from error
    after = read_source(Source.from_bytes(content, deck.file), units=units)
    after.folder = deck.folder
    _require_no_worse(deck, after, line)
    _require_only_this(deck, after, found, wanted, assignment, line)
    return Assigned(edits, line, written, assignment.value)


def set_value(deck: Deck, path: str, value: object) -> None:
    """Set the value at a path in the models of a deck, of one that several values make, all of them.

    Raises PathError for a path without a meaning, AssignmentError where the deck has no such value, several of them or
    an equation, and ValueError for what the field cannot have.
    """
    operand = None
    if isinstance(value, str):
        operand = Operand(value, Operand.of(value).number)
    elif isinstance(value, int | float | np.number):
        operand = Operand(str(value), float(value))
    elif not isinstance(value, list | tuple | np.ndarray | Table):
        raise ArgumentKindError(f"value must be a number, a text or several values, not {type(value).__name__}")
    target = target_of(parse_path(path), operand)
    found = _the_one(deck, target, left_out=True)
    if found is None:
        raise AssignmentError(f"the deck has no {target.path}")
    if isinstance(found.value, Equation):
        equation = cut(str(found.value), 60)
        raise AssignmentError(f"{target.path} is given by an equation, {equation}: change its parameters instead")
    if not isinstance(found.owner, Table):
        setattr(found.owner, found.field.slot.name, value)
        return
    *holder, name, row, column = found.where.path
    rows: list[list[object]] = [list(cells) for cells in found.owner]
    rows[int(row)][int(column)] = value
    block = deck.sections[found.where.section].blocks[found.where.block]
    record: Part = block.at(tuple(holder))[1]
    setattr(record, next(slot.name for slot in record_schema(type(record)).slots if slot.json == name), rows)


def _the_one(deck: Deck, target: Target, *, left_out: bool = False) -> Value | None:
    """The value at a path; None where the deck has no such record. Raises AssignmentError for several of them.

    One that is left out in the deck is refused, unless there may be none.
    """
    all_found = list(islice(values_of(deck, target), LISTED * 100))
    given = [one for one in all_found if one.value is not None]
    if len(given) > 1:
        lines = [str(_line(deck, one)) for one in given[: LISTED + 1]]
        listed = ", ".join(lines[:LISTED]) + (", ..." if len(lines) > LISTED else "")
        raise AssignmentError(
            f"{target.path} is ambiguous: the deck has several such values, in lines {listed}; choose one by the name "
            "of its set, as in KEYWORD[set=NAME].field, or by its number, as in KEYWORD[2].field"
        )
    if left_out and len(all_found) == 1:
        return all_found[0]
    if not given and all_found:
        raise AssignmentError(
            f"{target.path} is left out here: only a value that is written can be changed", _line(deck, all_found[0])
        )
    if not given and (faults := _read_faults(deck, target.path.keyword)):
        raise AssignmentError(
            f"*{target.path.keyword} cannot be read: correct its errors first", None, deck.diagnose(faults)
        )
    return given[0] if given else None


def _read_faults(deck: Deck, keyword: str) -> list[Problem]:
    """What could not be read of the blocks of a keyword, among whose lines may be the value that is not found."""
    read = deck.origin.read if isinstance(deck.origin, TextOrigin) else {}
    found = (read.get((where.section, where.block)) for where, _ in blocks_of(deck, keyword))
    return [problem for block in found if block for problem in block.problems if problem.weight is Severity.ERROR]


def _line(deck: Deck, found: Value) -> int:
    return deck.place(Problem(SYN003, "", where=found.where)).line


def _kinds(target: Target) -> Iterator[str]:
    """What the fields of a target can hold, in words."""
    for field in target.fields:
        if field.slot.choices:
            several = "one of " if len(field.slot.choices) > 1 else ""
            yield several + ", ".join(field.slot.choices)
        if field.slot.kind and field.slot.kind is not Kind.OTHER:
            yield field.slot.kind.value


def _checked(found: Value, operand: Operand, assignment: Assignment, line: int) -> float | str:
    """The value that is wanted, as a deck holds it; raises AssignmentError for one that the field cannot have."""
    slot = found.field.slot
    if operand.number is None or (slot.kind in (Kind.NAME, Kind.TITLE) and not slot.choices):
        return operand.text
    if slot.kind in (Kind.WHOLE, Kind.IDENT, Kind.WHOLE_OR_LABEL) and not operand.number.is_integer():
        raise AssignmentError(f"{assignment.path} cannot be {assignment.value!r}: expected a whole number", line)
    if fault := range_fault(operand.number, slot):
        raise AssignmentError(fault, line)
    return operand.number


def _same(one: object, other: object) -> bool:
    if isinstance(one, str) and isinstance(other, str):
        return one.casefold() == other.casefold()
    return one == other


def _require_no_worse(before: Deck, after: Deck, line: int) -> None:
    """Raise AssignmentError for a deck with errors that it did not have before."""
    old, new = (
        [problem for problem in resolve(deck).findings if problem.weight is Severity.ERROR] for deck in (before, after)
    )
    more = Counter(one.code.code for one in new) - Counter(one.code.code for one in old)
    if more:
        known = {one.message for one in old}
        added = [one for one in new if one.code.code in more and one.message not in known] or new
        raise AssignmentError("the deck would have a new error", line, after.diagnose(added))


def _require_only_this(
    before: Deck, after: Deck, found: Value, wanted: float | str, assignment: Assignment, line: int
) -> None:
    """Raise AssignmentError unless the decks differ in the one value, which is the wanted one; `before` is used up."""
    if before.units != after.units:
        raise AssignmentError(
            f"the units of the deck, {before.units}, would be taken for {after.units}: give them by --units", line
        )
    new = _at(after, found.where)
    if _same(new, wanted):
        if isinstance(found.owner, Table):
            _set_cell(found.owner, after, found.where)
        else:
            setattr(found.owner, found.field.slot.name, new)
        if same_meaning(before, after):
            return
    raise AssignmentError(f"{assignment.value!r} would change more than {assignment.path}", line)


def _set_cell(table: Table, after: Deck, where: Where) -> None:
    row, column = cast("tuple[int, int]", where.path[-2:])
    other = _at(after, where._replace(path=where.path[:-2]))
    if isinstance(other, Table) and other.values.shape == table.values.shape:
        table.values[row, column] = other.values[row, column]
        table.words.pop((row, column), None)
        if (row, column) in other.words:
            table.words[row, column] = other.words[row, column]


def _at(deck: Deck, where: Where) -> object:
    """What stands at a place of a deck; None where it has none."""
    try:
        return deck.sections[where.section].blocks[where.block].at(where.path)[1]
    except IndexError:
        return None
