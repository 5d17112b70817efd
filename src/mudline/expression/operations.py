"""What operators and functions do with values, and when they refuse."""

from __future__ import annotations

import math
import operator as python
from collections.abc import Callable, Mapping, Sequence
from typing import Final, NamedTuple

from mudline.diagnostics import Span
from mudline.expression.errors import EvaluationError
from mudline.expression.functions import Function

Value = float | str

LONGEST_TEXT = 10_000
"""The longest text that joining may make, in code points: parameters can double one another without end."""

ARITHMETIC: Final[Mapping[str, Callable[[float, float], float]]] = {
    "+": python.add,
    "-": python.sub,
    "*": python.mul,
    "/": python.truediv,
}
_ORDER: Final[Mapping[str, Callable[[float, float], bool]]] = {
    "<": python.lt,
    "<=": python.le,
    ">": python.gt,
    ">=": python.ge,
    "=": python.eq,
    "<>": python.ne,
}


class Operand(NamedTuple):
    """A value and the part of the equation it came from."""

    value: Value
    span: Span

    @property
    def number(self) -> float:
        """The value as a number; text raises EvaluationError."""
        if isinstance(self.value, str):
            raise EvaluationError("expected a number, found text", *self.span)
        return self.value

    @property
    def truth(self) -> bool:
        """Whether the value is a number other than 0; text raises EvaluationError."""
        return self.number != 0.0


def _across(left: Operand, right: Operand) -> Span:
    return Span(left.span.start, right.span.end)


def finite(value: float, span: Span) -> float:
    """The value, unless it is beyond the range of a double."""
    if not math.isfinite(value):
        raise EvaluationError("the result is too large", *span)
    return value


def arithmetic(operator: str, left: Operand, right: Operand) -> Operand:
    """Sum, difference, product or quotient of two numbers; + also joins two texts."""
    whole = _across(left, right)
    if operator == "+" and isinstance(left.value, str) and isinstance(right.value, str):
        return Operand(_joined(left.value, right.value, whole), whole)
    a, b = left.number, right.number
    if operator == "/" and b == 0.0:
        raise EvaluationError("division by zero", *right.span)
    return Operand(finite(ARITHMETIC[operator](a, b), whole), whole)


def _joined(left: str, right: str, span: Span) -> str:
    if len(left) + len(right) > LONGEST_TEXT:
        raise EvaluationError(f"the text would be longer than {LONGEST_TEXT} characters", *span)
    return left + right


def power(base: Operand, exponent: Operand) -> float:
    """A number to the power of another."""
    a, b = base.number, exponent.number
    whole = _across(base, exponent)
    try:
        return math.pow(a, b)
    except OverflowError:
        raise EvaluationError("the result is too large", *whole) from None
    except ValueError:
        reason = "0 has no negative power" if a == 0.0 else "a negative number has no fractional power"
        raise EvaluationError(reason, *whole) from None


def compare(operator: str, left: Operand, right: Operand) -> float:
    """1 if the comparison holds, else 0; texts are equal or not, without regard to case."""
    if isinstance(left.value, str) and isinstance(right.value, str):
        if operator not in {"=", "<>"}:
            raise EvaluationError("text has no order, expected = or <>", *_across(left, right))
        return float((left.value.casefold() == right.value.casefold()) == (operator == "="))
    return float(_ORDER[operator](left.number, right.number))


def apply(function: Function, arguments: Sequence[Operand], span: Span) -> float:
    """The value of a function; the number of arguments has been checked."""
    values = [argument.number for argument in arguments]
    try:
        result = function.call(*values)
    except OverflowError:
        raise EvaluationError("the result is too large", *span) from None
    except (ValueError, ZeroDivisionError):
        shown = ", ".join(f"{value:.6g}" for value in values)
        raise EvaluationError(f"{function.name}({shown}) has no value", *span) from None
    return finite(result, span)
