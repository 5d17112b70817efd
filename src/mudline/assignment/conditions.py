"""Whether a condition holds for a deck: its comparisons are of declared fields, and nothing in it is run."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from mudline.assignment.fields import Target, Value, equals, target_of, values_of
from mudline.assignment.paths import Comparison, Condition, FieldPath, Joined, Negated
from mudline.deck.model import Deck
from mudline.deck.parameters import NoValueError, Parameters
from mudline.keywords.values import Equation

_ORDER: Mapping[str, Callable[[float, float], bool]] = MappingProxyType(
    {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}
)


class ConditionError(Exception):
    """Why it cannot be said whether a condition holds for a deck."""


@dataclass(frozen=True, slots=True)
class DeckCondition:
    """A condition with what its paths mean; made by `of`, which finds faults of the paths before a deck is read."""

    condition: Condition
    targets: Mapping[Comparison, Target]

    @classmethod
    def of(cls, condition: Condition) -> DeckCondition:
        """The condition, its paths looked up; raises PathError."""
        return cls(condition, {one: target_of(one.path, one.operand) for one in _comparisons(condition)})

    def holds(self, deck: Deck) -> bool:
        """Whether the condition holds for a deck. Raises ConditionError for an equation without a value.

        A comparison holds where one of the values at its path fits; none does where the deck has no such value.
        """
        return self._holds(self.condition, deck, Parameters(deck))

    def _holds(self, condition: Condition, deck: Deck, parameters: Parameters) -> bool:
        if isinstance(condition, Negated):
            return not self._holds(condition.condition, deck, parameters)
        if isinstance(condition, Joined):
            found = (self._holds(one, deck, parameters) for one in condition.conditions)
            return any(found) if condition.any_of else all(found)
        values = values_of(deck, self.targets[condition])
        return any(_fits(value, condition, parameters) for value in values)


def _comparisons(condition: Condition) -> list[Comparison]:
    if isinstance(condition, Negated):
        return _comparisons(condition.condition)
    if isinstance(condition, Joined):
        return [found for one in condition.conditions for found in _comparisons(one)]
    return [condition]


def _fits(found: Value, comparison: Comparison, parameters: Parameters) -> bool:
    value = _evaluated(found, comparison.path, parameters)
    if value is None:
        return False
    if compare := _ORDER.get(comparison.operator):
        number = comparison.operand.number
        return isinstance(value, int | float) and number is not None and compare(value, number)
    return equals(value, comparison.operand) is (comparison.operator == "==")


def _evaluated(found: Value, path: FieldPath, parameters: Parameters) -> float | str | None:
    value = found.value
    if not isinstance(value, Equation):
        return value
    try:
        return parameters.evaluate(value, found.where)
    except NoValueError as error:
        why = f": {error}" if str(error) else ""
        raise ConditionError(f"{path} is given by an equation without a value, {value}{why}") from error
