"""The value of an equation.

A part is evaluated by a generator that yields the parts whose values it needs, one after the other. So no depth of
nesting can exhaust the interpreter's stack, and a part that is not asked for is not evaluated.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Generator, Sequence
from typing import assert_never, cast

from mudline.expression.errors import EvaluationError, UndefinedName, UnknownFunction, shorten
from mudline.expression.functions import CONSTANTS, FORMS, FUNCTIONS
from mudline.expression.nodes import (
    LEAVES,
    Call,
    Chain,
    Comparison,
    Expression,
    Group,
    Logical,
    Name,
    Node,
    Number,
    Plain,
    Power,
    Prefix,
    Text,
    children,
)
from mudline.expression.operations import Operand, Value, apply, arithmetic, compare, power
from mudline.expression.plain import plain_value

Lookup = Callable[[str], float | str]
Steps = Generator[Node, Value, Value]


def evaluate(expression: Expression, lookup: Lookup) -> float | str:
    """The value of an equation: a finite number, or text.

    A comparison, `and`, `or` and `not` give 1 or 0; any number but 0 counts as true. `if`, `and` and `or` evaluate
    only the parts they need.

    Args:
        expression: the equation, from `parse`.
        lookup: gives the value of a parameter by its name as written, or raises KeyError where there is none; then
            the constants (`pi`) are tried. Whatever else it raises passes through.

    Raises:
        UndefinedName: no parameter and no constant has this name.
        UnknownFunction: a function is not in `FUNCTIONS` or `FORMS`.
        EvaluationError: a part has no finite value, text is found where a number is expected, or a function has
            too many or too few arguments.
    """
    value: Value | None = None
    if isinstance(expression.content, Plain):
        value = plain_value(expression.content, lookup)
        if value is not None:
            return value
    waiting: list[Steps] = []
    steps = _steps(expression.root, lookup)
    while True:
        try:
            part = next(steps) if value is None else steps.send(value)
        except StopIteration as done:
            value = cast("Value", done.value)
            if not waiting:
                return value
            steps = waiting.pop()
        else:
            value = None
            waiting.append(steps)
            steps = _steps(part, lookup)


def _steps(node: Node, lookup: Lookup) -> Steps:
    """Evaluate one part: yields the parts it needs, is sent their values, returns its own."""
    match node:
        case Number() | Text() | Name():
            return _leaf(node, lookup)
        case Group():
            return (yield node.inner)
        case Prefix() | Power() | Comparison():
            return (yield from _operation(node))
        case Chain():
            return (yield from _chain(node, lookup))
        case Logical():
            return (yield from _logical(node.operator, node.operands))
        case Call():
            return (yield from _call(node))
        case _:
            assert_never(node)


def _leaf(node: Number | Text | Name, lookup: Lookup) -> Value:
    if isinstance(node, Name):
        return _parameter(node, lookup)
    if isinstance(node, Number) and not math.isfinite(node.value):
        raise EvaluationError("the number is too large", *node.span)
    return node.value


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


def _operation(node: Prefix | Power | Comparison) -> Steps:
    if isinstance(node, Prefix):
        return _prefixed(node.operator, Operand((yield node.operand), node.operand.span))
    first, second = children(node)
    left = Operand((yield first), first.span)
    right = Operand((yield second), second.span)
    return power(left, right) if isinstance(node, Power) else compare(node.operator, left, right)


def _prefixed(operator: str, operand: Operand) -> float:
    if operator == "not":
        return float(not operand.truth)
    return -operand.number if operator == "-" else operand.number


def _chain(node: Chain, lookup: Lookup) -> Steps:
    total: Operand | None = None
    for operator, part in zip(("", *node.operators), node.operands, strict=True):
        value = _leaf(part, lookup) if isinstance(part, LEAVES) else (yield part)
        operand = Operand(value, part.span)
        total = operand if total is None else arithmetic(operator, total, operand)
    return cast("Operand", total).value


def _logical(operator: str, operands: Sequence[Node]) -> Steps:
    decisive = operator == "or"
    for operand in operands:
        if Operand((yield operand), operand.span).truth is decisive:
            return float(decisive)
    return float(not decisive)


def _call(node: Call) -> Steps:
    name = node.name.lower()
    form = FORMS.get(name) or FUNCTIONS.get(name)
    if form is None:
        raise UnknownFunction(f"the function '{shorten(node.name)}' is not known", *node.name_span)
    if not form.takes(len(node.arguments)):
        raise EvaluationError(f"{name} wants {form.wants}, found {len(node.arguments)}", *node.span)
    if name == "if":
        condition, then, otherwise = node.arguments
        return (yield then if Operand((yield condition), condition.span).truth else otherwise)
    if name in FORMS:
        return (yield from _logical(name, node.arguments))
    arguments = []
    for argument in node.arguments:
        arguments.append(Operand((yield argument), argument.span))  # noqa: PERF401 - a comprehension cannot yield
    return apply(FUNCTIONS[name], arguments, node.span)
