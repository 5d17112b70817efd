"""The deck that a scene is made from: its equations are replaced by their values, so that nothing there meets one."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache, partial
from typing import Any, NewType

from mudline.codes.fields import SYN002
from mudline.deck.model import Deck
from mudline.deck.parameters import NoValueError, Parameters, Value, whole_fault
from mudline.diagnostics import Blocks, Problem, Where
from mudline.keywords.model import ListRow, Part, Slot, columns_of, layout
from mudline.keywords.table import Table
from mudline.keywords.values import Equation, Kind

_PLAIN = frozenset({float, int, str})
_EVALUATED = (Kind.REAL, Kind.WHOLE, Kind.REAL_OR_NAME)
_DEFINING = "PREPROCESSOR"
"""The section of the parameters; `mudline.deck.parameters` and `mudline.variations` evaluate what stands there."""

EvaluatedDeck = NewType("EvaluatedDeck", Deck)
"""A deck without equations in the sections of the model and of the analysis; only `evaluated` makes one.

A value that an equation did not give is NaN, or None in a field of whole numbers.
"""


def evaluated(deck: Deck) -> tuple[EvaluatedDeck, list[Problem]]:
    """The deck with its equations evaluated, and a problem for each that has no value.

    Without a value of `$MODEL` nothing can be evaluated, were it only because a function is not known, which is a
    warning. What other sections hold has no influence on the contact.
    """
    parameters = Parameters(deck)
    evaluator = _Evaluator(parameters)
    sections = []
    for i, section in enumerate(deck.sections):
        blocks = list(section.blocks)
        if section.name != _DEFINING:
            evaluator.blocks = Blocks.ALWAYS if section.name == "MODEL" else Blocks.NEVER
            for j, block in enumerate(section.blocks):
                if _has_equation(block):
                    blocks[j] = evaluator.part(block, Where(i, j))
        sections.append(type(section)(section.name, blocks, section.comments, section.lines))
    ready = EvaluatedDeck(replace(deck, sections=sections))
    noticed = parameters.problems
    if evaluator.lacks_parameter:
        noticed = [replace(problem, blocks=Blocks.ALWAYS) for problem in noticed]
    return ready, noticed + evaluator.problems


@cache
def _evaluated_slots(part: type[Part]) -> tuple[str, ...]:
    """Names of the fields that can hold an equation, or parts that can."""
    return tuple(slot.name for slot in layout(part).slots if slot.row or slot.record or slot.kind in _EVALUATED)


def _has_equation(value: object) -> bool:
    """Whether there is an equation in a value or below it."""
    kind = type(value)
    if value is None or kind in _PLAIN:
        return False
    if isinstance(value, list):
        return any(map(_has_equation, value))
    if issubclass(kind, Part):
        return any(map(_has_equation, map(partial(getattr, value), _evaluated_slots(kind))))
    if isinstance(value, Table):
        return value.equations
    return isinstance(value, Equation)


class _Evaluator:
    def __init__(self, parameters: Parameters) -> None:
        self.parameters = parameters
        self.problems: list[Problem] = []
        self.lacks_parameter = False
        self.blocks = Blocks.ALWAYS

    def part(self, part: Any, where: Where) -> Any:
        """A part without equations; the same object if it has none."""
        changed: dict[str, object] = {}
        kind: type[Part] = type(part)
        for slot in layout(kind).slots:
            value = getattr(part, slot.name)
            inner = where._replace(path=(*where.path, slot.json))
            new = self._value(value, slot, inner)
            if new is not value:
                changed[slot.name] = new
        return part.model_copy(update=changed) if changed else part

    def _value(self, value: object, slot: Slot, where: Where) -> object:
        if isinstance(value, Equation):
            return self._number(value, slot.kind or Kind.REAL, slot.label, where)
        if isinstance(value, Table):
            return self._table(value, slot, where) if value.equations else value
        if isinstance(value, ListRow):
            return self._list_row(value, where)
        if isinstance(value, Part):
            return self.part(value, where)
        if isinstance(value, list) and value and isinstance(value[0], Part):
            new = [self.part(item, where._replace(path=(*where.path, i))) for i, item in enumerate(value)]
            return new if any(a is not b for a, b in zip(new, value, strict=True)) else value
        return value

    def _list_row(self, row: ListRow, where: Where) -> ListRow:
        """Its fields have the index as path, as JSON holds them in a list."""
        changed: dict[str, object] = {}
        for index, slot in enumerate(layout(type(row)).columns):
            value = getattr(row, slot.name)
            if isinstance(value, Equation):
                place = where._replace(path=(*where.path, index))
                changed[slot.name] = self._number(value, slot.kind or Kind.REAL, slot.label, place)
        return row.model_copy(update=changed) if changed else row

    def _number(self, equation: Equation, kind: Kind, label: str, where: Where) -> Value | None:
        """The value of an equation; without one NaN, or None where a whole number belongs."""
        whole = kind in (Kind.WHOLE, Kind.IDENT)
        nothing = None if whole else math.nan
        try:
            value = self.parameters.evaluate(equation, where)
        except NoValueError as reason:
            if reason.problem:
                self.problems.append(replace(reason.problem, blocks=self.blocks))
            elif self.blocks is Blocks.ALWAYS:  # the problem is placed where the parameter is defined
                self.lacks_parameter = True
            return nothing
        if isinstance(value, str):
            if kind is Kind.REAL_OR_NAME:
                return value
            message = f"{equation} gives the text {value!r}: {label} needs a number"
            self.problems.append(Problem(SYN002, message, where=where, blocks=self.blocks))
            return nothing
        if not whole:
            return value
        if value.is_integer():
            return int(value)
        self.problems.append(replace(whole_fault(equation, value, label, where), blocks=self.blocks))
        return None

    def _table(self, table: Table, slot: Slot, where: Where) -> Table:
        columns = columns_of(slot)
        values = table.values.copy()
        words = dict(table.words)
        for (row, column), word in table.words.items():
            if isinstance(word, Equation):
                place = where._replace(path=(*where.path, row, column))
                number = self._number(word, columns[column].kind, columns[column].label, place)
                values[row, column] = math.nan if number is None else number
                del words[row, column]
        return Table(values, table.lengths, words)
