"""Fields that a path names, their values in a deck, and conditions such as `OCEAN.depth > 100`."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from itertools import islice
from types import MappingProxyType
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from mudline.basics.limits import LISTED
from mudline.basics.spelling import equally_near
from mudline.editing.assignment.paths import (
    FieldPath,
    PathBuilder,
    PathError,
    Selector,
    WrittenOperand,
    folded_name,
    parsed,
)
from mudline.language.deck.model import Deck, Opaque
from mudline.language.deck.parameters import NoValueError, Parameters
from mudline.language.diagnostics import Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.model import Block, FieldSpec, ListRow, Part, Rows, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import Equation, Kind, Label

Selectors = tuple[Selector, ...]


class DeclaredField(NamedTuple):
    """A field of a keyword.

    Attributes:
        names: the names that lead to the field.
        slot: its declaration.
        column: its column, if the field is a column of a table.
        whole: True if the field holds several values: a row, a table, a list.
    """

    names: tuple[str, ...]
    slot: FieldSpec
    column: int | None = None
    whole: bool = False

    def fits(self, operand: WrittenOperand) -> bool:
        """Return True if a text may be a value of the field, or be compared with a value."""
        if operand.text.casefold() in (choice.casefold() for choice in self.slot.choices):
            return True
        if Equation.match(operand.text) or operand.number is not None:
            return self.slot.kind is not None
        if self.slot.kind is Kind.IDENT:
            return Label.match(operand.text) is not None
        return self.slot.kind in (Kind.NAME, Kind.TITLE, Kind.REAL_OR_NAME)


class FieldTarget(NamedTuple):
    """A keyword and its fields that a path names, as far as they accept the value to be set or compared."""

    path: FieldPath
    fields: tuple[DeclaredField, ...]


class FieldValue(NamedTuple):
    """A value of a deck, with its place, its declaration and its record (or the table that contains it)."""

    where: Where
    value: float | str | None
    field: DeclaredField
    owner: Part | Table


def target_of(path: FieldPath, operand: WrittenOperand | None) -> FieldTarget:
    """Return the fields that a path names; raises PathError for a keyword or a field that is not declared.

    Of several fields with the same name, those that accept the operand are chosen, and of these the outermost. Without
    an operand, fields of several values are chosen.
    """
    blocks = catalogue.declarations(path.keyword)
    if not blocks and catalogue.sections_of(path.keyword) is not None:
        raise PathError(f"the lines of *{path.keyword} are passed through unchanged: no value in them can be named")
    if not blocks:
        near = catalogue.suggest_keyword(path.keyword)
        hint = f": did you mean {near}?" if near else ": see docs/keywords.md"
        raise PathError(f"*{path.keyword} is not a known keyword{hint}")
    known = [field for block in blocks for field in declared_fields(block) if field.whole is (operand is None)]
    named = [field for field in known if _ends_with(field, path.names)]
    if not named:
        raise PathError(_unknown_field(path, known))
    fitting = [field for field in named if operand and field.fits(operand)] or named
    outermost = min(len(field.names) for field in fitting)
    fields = tuple(field for field in fitting if len(field.names) == outermost)
    selectable = {name for block in blocks for field in declared_fields(block) for name in _names_of(field.slot)}
    for selector in path.selectors:
        if selector.name and selector.name not in selectable:
            raise PathError(f"{path}: *{path.keyword} has no field {selector.name!r}{_hint(selector.name, selectable)}")
    return FieldTarget(path, fields)


def values_of(deck: Deck, target: FieldTarget) -> Iterator[FieldValue]:
    """Return the values at a path in the blocks of a deck, in the order of the file."""
    values = (
        value
        for where, block in blocks_of(deck, target.path.keyword)
        for field in target.fields
        if any(field is own for own in declared_fields(type(block)))
        for value in _values([block], where, field, target.path.selectors)
    )
    count = target.path.count
    return values if count is None else islice(values, count - 1, count)


# --------------------------------------------------------------------------------------------------- declared fields


@cache
def declared_fields(block: type[Block]) -> tuple[DeclaredField, ...]:
    """Return every field of a keyword, including the parts of fields of several values."""
    return tuple(_fields_of(block, ()))


def _fields_of(part: type[Part], before: tuple[str, ...]) -> Iterator[DeclaredField]:
    for slot in record_schema(part).slots:
        names = (*before, slot.json)
        if slot.many or slot.row:
            yield DeclaredField(names, slot, whole=True)
        if isinstance(slot.about, Rows):
            columns = record_schema(slot.row).columns if slot.row else []
            yield from (DeclaredField((*names, column.json), column, i) for i, column in enumerate(columns))
            continue
        for inner in (*slot.record.values(), *([slot.row] if slot.row else [])):
            yield from _fields_of(inner, names)
        if not slot.many and (slot.kind or slot.choices):
            yield DeclaredField(names, slot)


def _names_of(slot: FieldSpec) -> set[str]:
    """Return the names of a field: its name in JSON, its KEY, and further names in its declaration."""
    return {folded_name(name) for name in (slot.json, slot.key, slot.about.also) if name}


def _ends_with(field: DeclaredField, names: Sequence[str]) -> bool:
    """Return True if the path to a field ends with the given names."""
    *before, last = names
    if last not in _names_of(field.slot) or len(names) > len(field.names):
        return False
    between = field.names[len(field.names) - len(names) : -1]
    return all(folded_name(own) == name for own, name in zip(between, before, strict=True))


def _unknown_field(path: FieldPath, known: Sequence[DeclaredField]) -> str:
    # as in a path, without the list of records at the beginning
    names = dict.fromkeys(".".join(field.names[1:] or field.names) for field in known)
    hint = _hint(path.names[-1], {name for field in known for name in _names_of(field.slot)})
    listed = ", ".join(list(names)[:LISTED]) + (", ..." if len(names) > LISTED else "")
    return f"*{path.keyword} has no field {'.'.join(path.names)!r}" + (hint or f": it has {listed or 'none'}")


def _hint(word: str, known: set[str]) -> str:
    near = sorted(equally_near(word, known))
    return f": did you mean {' or '.join(near)}?" if near else ""


# ------------------------------------------------------------------------------------------------ values of a deck


def blocks_of(deck: Deck, keyword: str) -> Iterator[tuple[Where, Block]]:
    """Yield the blocks of a keyword in the deck's own sections whose lines were read, with their places."""
    for where, _, block in deck.alone.every_block():
        if block.keyword == keyword and not isinstance(block, Opaque):
            yield where, block


def _values(parts: list[Part], where: Where, field: DeclaredField, selectors: Selectors) -> Iterator[FieldValue]:
    """Yield the values of a field below the last of nested parts."""
    part, name = parts[-1], field.names[len(parts) - 1]
    for index, slot in enumerate(record_schema(type(part)).slots):
        if slot.json != name:
            continue
        inner: Any = getattr(part, slot.name, None)
        place = where.inside(index if isinstance(part, ListRow) else name)
        if len(parts) == len(field.names):
            single = not isinstance(inner, Part | list | Table)
            if (field.whole or single) and all(_fits(parts, selector) for selector in selectors):
                yield FieldValue(place, inner, field, part)
        elif isinstance(inner, Table):
            yield from _cells(inner, slot, parts, place, field, selectors)
        elif isinstance(inner, Part):
            yield from _values([*parts, inner], place, field, selectors)
        elif isinstance(inner, list):
            for number, item in enumerate(inner):
                if isinstance(item, Part):
                    yield from _values([*parts, item], place.inside(number), field, selectors)


def _fits(parts: Sequence[Part], selector: Selector) -> bool:
    """Return True if a selector matches the innermost of nested parts that has its field."""
    for part in reversed(parts):
        schema = record_schema(type(part))
        for slot in schema.slots if selector.name else filter(None, [schema.name]):
            if not selector.name or selector.name in _names_of(slot):
                value = getattr(part, slot.name, None)
                if value is None and slot.kind is Kind.NAME:
                    value = slot.about.default or None
                if isinstance(value, int | float | str):
                    return equals(value, selector.value)
    return False


def equals(value: float | str, operand: WrittenOperand) -> bool:
    """Return True if a value of a deck equals the operand; texts compare without case."""
    if isinstance(value, int | float):
        return operand.number is not None and float(value) == operand.number
    return value.strip().casefold() == operand.text.strip().casefold()


def _cells(
    table: Table, slot: FieldSpec, parts: list[Part], where: Where, field: DeclaredField, selectors: Selectors
) -> Iterator[FieldValue]:
    """Yield the values of a column in the rows that the selectors choose."""
    columns = record_schema(slot.row).columns if slot.row else []
    outside = set(selectors)
    chosen = np.ones(len(table), dtype=np.bool_)
    for index, column in enumerate(columns):
        for selector in selectors:
            if selector.name in _names_of(column):
                outside.discard(selector)
                chosen &= _rows_with(table, index, selector.value)
    if field.column is None or not all(_fits(parts, selector) for selector in outside):
        return
    for row in np.flatnonzero(chosen).tolist():
        value = table.cell(row, field.column) if field.column < table.lengths[row] else None
        missing = isinstance(value, float) and np.isnan(value)
        yield FieldValue(where.inside(row, field.column), None if missing else value, field, table)


def _rows_with(table: Table, column: int, operand: WrittenOperand) -> NDArray[np.bool_]:
    matches: NDArray[np.bool_] = table.column(column) == (np.nan if operand.number is None else operand.number)
    for (row, at), word in table.words.items():
        if at == column and word is not None:
            matches[row] = equals(str(word), operand)
    return matches


# --------------------------------------------------------------------------------------------- conditions on values

_ORDER: Mapping[str, Callable[[float, float], bool]] = MappingProxyType(
    {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}
)
_Holds = Callable[[Deck, Parameters], bool]


class ConditionError(Exception):
    """Reason why a condition cannot be decided for a deck."""


def parse_condition(text: str) -> Callable[[Deck], bool]:
    """Return a condition as a predicate: comparisons of fields with numbers or texts, joined by and, or, not.

    A comparison holds if any value at its path satisfies it, and never if the deck has no such value. Raises PathError.
    The predicate raises ConditionError for an equation without a value.
    """
    holds = cast("_Holds", parsed(text, "condition", _ConditionBuilder))
    return lambda deck: holds(deck, Parameters(deck))


class _ConditionBuilder(PathBuilder):
    def comparison(self, parts: list[Any]) -> _Holds:
        """Return a comparison; texts have no order."""
        path, written, value = parts
        operand = WrittenOperand.of(value)
        if written in _ORDER and operand.number is None:
            raise PathError(f"{path} {written} {value}: a text is compared by == or !=, an order needs a number")
        target = target_of(path, operand)

        def fits(candidate: FieldValue, parameters: Parameters) -> bool:
            found = _evaluated(candidate, path, parameters)
            if found is None:
                return False
            if compare := _ORDER.get(written):
                return isinstance(found, int | float) and operand.number is not None and compare(found, operand.number)
            return equals(found, operand) is (written in ("=", "=="))

        return lambda deck, parameters: any(fits(each, parameters) for each in values_of(deck, target))

    def negated(self, parts: list[_Holds]) -> _Holds:
        """Return a negation."""
        (holds,) = parts
        return lambda *deck: not holds(*deck)

    def conjunction(self, parts: list[_Holds]) -> _Holds:
        """Return conditions joined by and."""
        return lambda *deck: all(holds(*deck) for holds in parts)

    def disjunction(self, parts: list[_Holds]) -> _Holds:
        """Return conditions joined by or."""
        return lambda *deck: any(holds(*deck) for holds in parts)


def _evaluated(field_value: FieldValue, path: FieldPath, parameters: Parameters) -> float | str | None:
    value = field_value.value
    if not isinstance(value, Equation):
        return value
    try:
        return parameters.evaluate(value, field_value.where)
    except NoValueError as error:
        why = f": {error}" if str(error) else ""
        raise ConditionError(f"{path} is given by an equation without a value, {value}{why}") from error
