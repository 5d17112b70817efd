"""Conditions on the values of a deck, such as `OCEAN.depth > 100 and UNITS.units == METRIC`."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, cast

from mudline.editing.assignment.fields import FieldValue, equals, target_of, values_of
from mudline.editing.assignment.paths import FieldPath, PathBuilder, PathError, WrittenOperand, parsed
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import NoValueError, Parameters
from mudline.language.keywords.values import Equation

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
