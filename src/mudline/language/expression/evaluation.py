"""Values of equations: operators, functions, and the errors that they raise.

The manual of the language names `if` and CONVERT and says that other functions exist; their list is not public.
INFERRED: the functions here are the usual functions under their usual names. Angles are radians, `log` is base 10
and `ln` natural as in spreadsheets; `mod`, `int`, `round` and `atan2` follow Fortran. CONVERT is left out, since
its arguments are not public.
"""

from __future__ import annotations

import math
import operator as python
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Context, Decimal
from types import MappingProxyType
from typing import Final, NamedTuple, assert_never

from mudline.basics.limits import LONGEST_TEXT
from mudline.basics.short_repr import counted
from mudline.language.diagnostics import Span
from mudline.language.expression.parsing import (
    Brackets,
    Call,
    EvaluationError,
    Expression,
    Logical,
    Name,
    Node,
    Number,
    OperatorChain,
    Power,
    Prefix,
    Relation,
    Text,
    UndefinedName,
    UnknownFunction,
    shorten,
)

CONSTANTS: Final[Mapping[str, float]] = MappingProxyType({"pi": math.pi})
"""Values of names that no parameter has; in lower case, compared without case."""


@dataclass(frozen=True, slots=True)
class Signature:
    """Signature of a function; `most` None means any number of arguments."""

    name: str
    least: int
    most: int | None
    meaning: str

    @property
    def wants(self) -> str:
        """Number of arguments in words."""
        if self.most is None:
            return f"at least {counted(self.least, 'argument')}"
        if self.most > self.least:
            return f"{self.least} or {counted(self.most, 'argument')}"
        return counted(self.least, "argument")

    def takes(self, count: int) -> bool:
        """Return True if a call may have this number of arguments."""
        return self.least <= count and (self.most is None or count <= self.most)


@dataclass(frozen=True, slots=True)
class Function(Signature):
    """Function of numbers; `call` may raise ValueError, ZeroDivisionError or OverflowError, or return inf."""

    call: Callable[..., float]


def _log(x: float, base: float = 10.0) -> float:
    return math.log10(x) if base == 10.0 else math.log(x, base)


def _round(x: float, digits: float = 0.0) -> float:
    if not digits.is_integer() or abs(digits) > 308:
        raise ValueError(digits)
    exact = Decimal(x)
    return float(exact.quantize(Decimal((0, (1,), -int(digits))), ROUND_HALF_UP, Context(prec=700)))


def _sign(x: float) -> float:
    return float((x > 0.0) - (x < 0.0))


def _table(*functions: Function) -> Mapping[str, Function]:
    return MappingProxyType({function.name: function for function in functions})


FUNCTIONS: Final = _table(
    Function("abs", 1, 1, "absolute value", abs),
    Function("acos", 1, 1, "arc cosine in radians, 0 to pi", math.acos),
    Function("asin", 1, 1, "arc sine in radians, -pi/2 to pi/2", math.asin),
    Function("atan", 1, 1, "arc tangent in radians, -pi/2 to pi/2", math.atan),
    Function("atan2", 2, 2, "atan2(y, x): angle of the point (x, y) in radians, -pi to pi", math.atan2),
    Function("ceil", 1, 1, "smallest whole number not below the argument", lambda x: float(math.ceil(x))),
    Function("cos", 1, 1, "cosine of radians", math.cos),
    Function("cosh", 1, 1, "hyperbolic cosine", math.cosh),
    Function("deg", 1, 1, "radians to degrees", math.degrees),
    Function("exp", 1, 1, "e to the power of the argument", math.exp),
    Function("floor", 1, 1, "largest whole number not above the argument", lambda x: float(math.floor(x))),
    Function("int", 1, 1, "whole part: the fraction is cut off, towards zero", lambda x: float(math.trunc(x))),
    Function("ln", 1, 1, "natural logarithm", math.log),
    Function("log", 1, 2, "log(x) to base 10, log(x, base) to the base given", _log),
    Function("log10", 1, 1, "logarithm to base 10", math.log10),
    Function("max", 1, None, "largest argument", lambda *x: max(x)),
    Function("min", 1, None, "smallest argument", lambda *x: min(x)),
    Function("mod", 2, 2, "mod(a, b): remainder of a/b, with the sign of a", math.fmod),
    Function("pi", 0, 0, "3.14159...", lambda: math.pi),
    Function("pow", 2, 2, "pow(a, b): a to the power b", math.pow),
    Function("rad", 1, 1, "degrees to radians", math.radians),
    Function("round", 1, 2, "round(x) to a whole number, round(x, n) to n decimals; halves away from zero", _round),
    Function("sign", 1, 1, "-1, 0 or 1", _sign),
    Function("sin", 1, 1, "sine of radians", math.sin),
    Function("sinh", 1, 1, "hyperbolic sine", math.sinh),
    Function("sqrt", 1, 1, "square root", math.sqrt),
    Function("tan", 1, 1, "tangent of radians", math.tan),
    Function("tanh", 1, 1, "hyperbolic tangent", math.tanh),
)
"""Functions of numbers by their names in lower case; equations call them in any case."""

FORMS: Final[Mapping[str, Signature]] = MappingProxyType(
    {
        "and": Signature("and", 1, None, "1 if no argument is 0, else 0; stops at the first that is 0"),
        "if": Signature("if", 3, 3, "if(condition, a, b): a if the condition is not 0, else b; only that is evaluated"),
        "or": Signature("or", 1, None, "0 if every argument is 0, else 1; stops at the first that is not 0"),
    },
)
"""Functions that evaluate only the arguments they need, by name in lower case."""


Value = float | str


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


class EvaluatedPart(NamedTuple):
    """Value, and the part of the equation it came from."""

    value: Value
    span: Span

    @property
    def number(self) -> float:
        """Value as a number; text raises EvaluationError."""
        if isinstance(self.value, str):
            raise EvaluationError("expected a number, found text", *self.span)
        return self.value

    @property
    def truth(self) -> bool:
        """True if the value is a number other than 0; text raises EvaluationError."""
        return self.number != 0.0


def _across(left: EvaluatedPart, right: EvaluatedPart) -> Span:
    return Span(left.span.start, right.span.end)


def finite(value: float, span: Span) -> float:
    """Return the value; raise EvaluationError if it is beyond the range of a double."""
    if not math.isfinite(value):
        raise EvaluationError("the result is too large", *span)
    return value


def arithmetic(operator: str, left: EvaluatedPart, right: EvaluatedPart) -> EvaluatedPart:
    """Return the sum, difference, product or quotient of two numbers; + also joins two texts."""
    whole = _across(left, right)
    if operator == "+" and isinstance(left.value, str) and isinstance(right.value, str):
        if len(left.value) + len(right.value) > LONGEST_TEXT:
            raise EvaluationError(f"the text would be longer than {LONGEST_TEXT} characters", *whole)
        return EvaluatedPart(left.value + right.value, whole)
    a, b = left.number, right.number
    if operator == "/" and b == 0.0:
        raise EvaluationError("division by zero", *right.span)
    return EvaluatedPart(finite(ARITHMETIC[operator](a, b), whole), whole)


def power(base: EvaluatedPart, exponent: EvaluatedPart) -> float:
    """Return a number to the power of another."""
    a, b = base.number, exponent.number
    whole = _across(base, exponent)
    try:
        return math.pow(a, b)
    except OverflowError:
        raise EvaluationError("the result is too large", *whole) from None
    except ValueError:
        reason = "0 has no negative power" if a == 0.0 else "a negative number has no fractional power"
        raise EvaluationError(reason, *whole) from None


def compare(operator: str, left: EvaluatedPart, right: EvaluatedPart) -> float:
    """Return 1 if the comparison holds, else 0; texts are equal or not, without regard to case."""
    if isinstance(left.value, str) and isinstance(right.value, str):
        if operator not in {"=", "<>"}:
            raise EvaluationError("text has no order, expected = or <>", *_across(left, right))
        return float((left.value.casefold() == right.value.casefold()) == (operator == "="))
    return float(_ORDER[operator](left.number, right.number))


def apply(function: Function, arguments: Sequence[EvaluatedPart], span: Span) -> float:
    """Return the value of a function; the number of arguments has been checked."""
    values = [argument.number for argument in arguments]
    try:
        result = function.call(*values)
    except OverflowError:
        raise EvaluationError("the result is too large", *span) from None
    except (ValueError, ZeroDivisionError):
        shown = ", ".join(f"{value:.6g}" for value in values)
        raise EvaluationError(f"{function.name}({shown}) has no value", *span) from None
    return finite(result, span)


Lookup = Callable[[str], float | str]


def evaluate(expression: Expression, lookup: Lookup) -> float | str:
    """Return the value of an equation: a finite number, or text.

    A comparison, `and`, `or` and `not` give 1 or 0; any number but 0 counts as true. `if`, `and` and `or` evaluate
    only the parts they need.

    Args:
        expression: the equation, from `parse`.
        lookup: gives the value of a parameter by its name as written, or raises KeyError if there is none; then the
            constants (`pi`) are tried. Any other exception passes through.

    Raises:
        UndefinedName: no parameter and no constant has this name.
        UnknownFunction: a function is not in `FUNCTIONS` or `FORMS`.
        EvaluationError: a part has no finite value, text is found where a number is expected, or a function has
            too many or too few arguments.
    """
    return _evaluated(expression.root, lookup).value


def _evaluated(node: Node, lookup: Lookup) -> EvaluatedPart:
    """Return the value of a part; it evaluates its inner parts only as it needs them."""
    match node:
        case Number() | Text():
            value: Value = node.value
            if isinstance(value, float) and not math.isfinite(value):
                raise EvaluationError("the number is too large", *node.span)
        case Name():
            value = _parameter(node, lookup)
        case Brackets():
            value = _evaluated(node.inner, lookup).value
        case Prefix():
            part = _evaluated(node.operand, lookup)
            signed = -part.number if node.operator == "-" else part.number
            value = float(not part.truth) if node.operator == "not" else signed
        case Power():
            value = power(_evaluated(node.base, lookup), _evaluated(node.exponent, lookup))
        case Relation():
            value = compare(node.operator, _evaluated(node.left, lookup), _evaluated(node.right, lookup))
        case OperatorChain():
            total = _evaluated(node.operands[0], lookup)
            for operator, operand in zip(node.operators, node.operands[1:], strict=True):
                total = arithmetic(operator, total, _evaluated(operand, lookup))
            value = total.value
        case Logical():
            value = _logical(node.operator, node.operands, lookup)
        case Call():
            value = _call(node, lookup)
        case _:
            assert_never(node)
    return EvaluatedPart(value, node.span)


def _parameter(node: Name, lookup: Lookup) -> Value:
    try:
        value = lookup(node.name)
    except KeyError:
        constant = CONSTANTS.get(node.name.lower())
        if constant is None:
            raise UndefinedName(f"the parameter '{shorten(node.name)}' is not defined", *node.span) from None
        return constant
    if isinstance(value, str):
        return value
    if not -sys.float_info.max <= value <= sys.float_info.max:
        raise EvaluationError(f"the parameter '{shorten(node.name)}' is not a finite number", *node.span)
    return float(value)


def _logical(operator: str, operands: Sequence[Node], lookup: Lookup) -> float:
    decisive = operator == "or"
    found = any(_evaluated(operand, lookup).truth is decisive for operand in operands)
    return float(found) if decisive else float(not found)


def _call(node: Call, lookup: Lookup) -> Value:
    name = node.name.lower()
    form = FORMS.get(name) or FUNCTIONS.get(name)
    if form is None:
        raise UnknownFunction(f"the function '{shorten(node.name)}' is not known", *node.name_span)
    if not form.takes(len(node.arguments)):
        raise EvaluationError(f"{name} needs {form.wants}, found {len(node.arguments)}", *node.span)
    if name == "if":
        condition, then, otherwise = node.arguments
        return _evaluated(then if _evaluated(condition, lookup).truth else otherwise, lookup).value
    if name in FORMS:
        return _logical(name, node.arguments, lookup)
    return apply(FUNCTIONS[name], [_evaluated(argument, lookup) for argument in node.arguments], node.span)
