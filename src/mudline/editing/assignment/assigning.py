"""Assignment of one value of a deck: edits of its text, aligned as before; after an error the deck is unchanged."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from typing import NamedTuple, cast

import numpy as np

from mudline.basics.arguments import ArgumentKindError
from mudline.basics.limits import LISTED
from mudline.basics.short_repr import cut
from mudline.editing.assignment.fields import FieldTarget, FieldValue, blocks_of, equals, target_of, values_of
from mudline.editing.assignment.paths import Assignment, WrittenOperand, parse_path
from mudline.language.deck.forms import KEYWORD
from mudline.language.deck.keyword_text import same_meaning
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Diagnostic, Severity, Where, new_codes
from mudline.language.keywords.contents import range_fault
from mudline.language.keywords.model import Part, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.text import suggestion
from mudline.language.keywords.values import WHOLE_KINDS, Equation, Kind
from mudline.language.syntax.edits import TextEdit, edited_bytes, replacement_in_layout
from mudline.model.scene.model import resolve

_BY_EQUATION = "{} is given by an equation, {}: change its parameters instead"


class AssignmentError(ValueError):
    """Reason why a deck is left unchanged; `line` is its place, None for the deck as a whole."""

    def __init__(self, message: str, line: int | None = None, diagnostics: Sequence[Diagnostic] = ()) -> None:
        self.line = line
        self.diagnostics = diagnostics
        super().__init__(message)


class Assigned(NamedTuple):
    """Edits that set a value.

    Attributes:
        edits: the edits; none if the deck has the value already.
        line: line of the value.
        before: the old value as written.
        after: the new value as written.
    """

    edits: tuple[TextEdit, ...]
    line: int
    before: str
    after: str


def assigned(deck: Deck, assignment: Assignment, target: FieldTarget, units: str | None = None) -> Assigned | None:
    """Return the edits that set a value of a deck read from keyword text; None if the deck has no such value.

    `units` are those with which the deck was read. Raises AssignmentError for a value that is an equation, is left out
    in the deck or is not unique at the path. Also raised if the edited deck would be faulty, or would differ in another
    value.
    """
    operand = WrittenOperand.of(assignment.value)
    if not any(field.fits(operand) for field in target.fields):
        if next(values_of(deck, target), None) is None:
            return None
        expected = " or ".join(dict.fromkeys(_kinds(target)))
        hint = suggestion(assignment.value, {choice for field in target.fields for choice in field.slot.choices})
        raise AssignmentError(f"{target.path} cannot be {assignment.value!r}: expected {expected}{hint}")
    current = _the_one(deck, target)
    if current is None:
        return None
    origin = cast("TextOrigin", deck.origin)
    span = origin.span(current.where)
    line = deck.place(current.where).line
    place = current.where._replace(path=current.where.path[:-2]) if isinstance(current.owner, Table) else current.where
    if span is None or not deck.written(place):
        raise AssignmentError(f"{target.path} is not written in the deck", line)
    if isinstance(current.value, Equation):
        raise AssignmentError(_BY_EQUATION.format(target.path, cut(str(current.value), 60)), line)
    _require_fitting(current, operand, assignment, line)
    written = origin.source.text[slice(*span)]
    if current.value is not None and equals(current.value, operand):
        return Assigned((), line, written, written)
    edits = tuple(replacement_in_layout(origin.source, span, assignment.value))
    try:
        content = edited_bytes(origin.source, edits)
    except UnicodeEncodeError as error:
        message = f"the file's encoding, {origin.source.encoding}, lacks a character of the value"
        raise AssignmentError(message, line) from error
    after = load_bytes(content, deck.file, form=KEYWORD, units=units, folder=deck.folder)
    _require_no_worse(deck, after, line)
    _require_only_this(deck, after, current, operand, assignment, line)
    return Assigned(edits, line, written, assignment.value)


def set_value(deck: Deck, path: str, value: object) -> None:
    """Set the value at a path in the models of a deck; several values set all values of a field.

    Raises PathError for a path without a meaning. Raises AssignmentError if the deck has no such value, several of them
    or an equation. Raises ValueError for a value that the field cannot have.
    """
    operand = None
    if isinstance(value, str):
        operand = WrittenOperand(value, WrittenOperand.of(value).number)
    elif isinstance(value, int | float | np.number):
        operand = WrittenOperand(str(value), float(value))
    elif not isinstance(value, list | tuple | np.ndarray | Table):
        raise ArgumentKindError(f"value must be a number, a text or several values, not {type(value).__name__}")
    target = target_of(parse_path(path), operand)
    current = _the_one(deck, target, left_out=True)
    if current is None:
        raise AssignmentError(f"the deck has no {target.path}")
    if isinstance(current.value, Equation):
        raise AssignmentError(_BY_EQUATION.format(target.path, cut(str(current.value), 60)))
    if not isinstance(current.owner, Table):
        setattr(current.owner, current.field.slot.name, value)
        return
    *holder, name, row, column = current.where.path
    rows: list[list[object]] = [list(cells) for cells in current.owner]
    rows[int(row)][int(column)] = value
    record: Part = deck.at(current.where._replace(path=tuple(holder)))
    setattr(record, next(slot.name for slot in record_schema(type(record)).slots if slot.json == name), rows)


def _the_one(deck: Deck, target: FieldTarget, *, left_out: bool = False) -> FieldValue | None:
    """Return the value at a path; None if the deck has no such record. Raises AssignmentError for several values.

    A value that the deck leaves out is refused unless `left_out`.
    """
    candidates = list(islice(values_of(deck, target), LISTED * 100))
    written = [value for value in candidates if value.value is not None]
    if len(written) > 1:
        lines = [str(deck.place(value.where).line) for value in written[: LISTED + 1]]
        listed = ", ".join(lines[:LISTED]) + (", ..." if len(lines) > LISTED else "")
        raise AssignmentError(
            f"{target.path} is ambiguous: the deck has several such values, in lines {listed}; choose one by the name "
            "of its set, as in KEYWORD[set=NAME].field, or by its number, as in KEYWORD[2].field"
        )
    if left_out and len(candidates) == 1:
        return candidates[0]
    if not written and candidates:
        message = f"{target.path} is left out here: only a value that is written can be changed"
        raise AssignmentError(message, deck.place(candidates[0].where).line)
    if written:
        return written[0]
    read = deck.origin.read if isinstance(deck.origin, TextOrigin) else {}
    blocks = (read.get((where.section, where.block)) for where, _ in blocks_of(deck, target.path.keyword))
    faults = [problem for block in blocks if block for problem in block.problems if problem.weight is Severity.ERROR]
    if faults:  # the missing value may be in a line that cannot be read
        message = f"*{target.path.keyword} cannot be read: correct its errors first"
        raise AssignmentError(message, None, deck.diagnose(faults))
    return None


def _kinds(target: FieldTarget) -> Iterator[str]:
    """Yield the kinds of values that the fields of a target accept, in words."""
    for field in target.fields:
        if field.slot.choices:
            several = "one of " if len(field.slot.choices) > 1 else ""
            yield several + ", ".join(field.slot.choices)
        if field.slot.kind and field.slot.kind is not Kind.OTHER:
            yield field.slot.kind.value


def _require_fitting(current: FieldValue, operand: WrittenOperand, assignment: Assignment, line: int) -> None:
    """Raise AssignmentError for a number that the field cannot have."""
    slot = current.field.slot
    if operand.number is None or (slot.kind in (Kind.NAME, Kind.TITLE) and not slot.choices):
        return
    if slot.kind in WHOLE_KINDS and not operand.number.is_integer():
        raise AssignmentError(f"{assignment.path} cannot be {assignment.value!r}: expected a whole number", line)
    if fault := range_fault(operand.number, slot):
        raise AssignmentError(fault, line)


def _require_no_worse(before: Deck, after: Deck, line: int) -> None:
    """Raise AssignmentError for a deck with errors that it did not have before."""
    old, new = (
        [problem for problem in resolve(deck).findings if problem.weight is Severity.ERROR] for deck in (before, after)
    )
    if more := new_codes(old, new):
        known = {problem.message for problem in old}
        added = [problem for problem in new if problem.code.code in more and problem.message not in known] or new
        raise AssignmentError("the deck would have a new error", line, after.diagnose(added))


def _require_only_this(
    before: Deck, after: Deck, current: FieldValue, operand: WrittenOperand, assignment: Assignment, line: int
) -> None:
    """Raise AssignmentError unless the decks differ only in the given value, now `operand`; changes `before`."""
    if before.units != after.units:
        message = f"the units of the deck, {before.units}, would be taken for {after.units}: give them by --units"
        raise AssignmentError(message, line)
    new = _at(after, current.where)
    if isinstance(new, float | int | str) and equals(new, operand):
        if isinstance(current.owner, Table):
            _set_cell(current.owner, after, current.where)
        else:
            setattr(current.owner, current.field.slot.name, new)
        if same_meaning(before, after):
            return
    raise AssignmentError(f"{assignment.value!r} would change more than {assignment.path}", line)


def _set_cell(table: Table, after: Deck, where: Where) -> None:
    row, column = cast("tuple[int, int]", where.path[-2:])
    changed = _at(after, where._replace(path=where.path[:-2]))
    if isinstance(changed, Table) and changed.values.shape == table.values.shape:
        table.values[row, column] = changed.values[row, column]
        table.words.pop((row, column), None)
        if (row, column) in changed.words:
            table.words[row, column] = changed.words[row, column]


def _at(deck: Deck, where: Where) -> object:
    """Return the object at a place of a deck; None if there is none."""
    try:
        return deck.at(where)
    except IndexError:
        return None
