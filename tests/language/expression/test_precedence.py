"""Equations against Python: parts that belong together, and their values."""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable

from hypothesis import given
from hypothesis import strategies as st

from mudline.language.expression.evaluation import evaluate
from mudline.language.expression.parsing import EvaluationError, parse

PARAMETERS = {"x": 2.5, "y": -3.0, "zero": 0.0, "big": 1e200}

BINARY: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: math.pow,
}
COMPARE: dict[type[ast.cmpop], Callable[[float, float], bool]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}


UNARY: dict[type[ast.unaryop], Callable[[float], float]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Not: operator.not_,
}


def fold(node: ast.expr) -> float:
    """The value of a syntax tree of Python; ArithmeticError or ValueError where there is none."""
    match node:
        case ast.Constant(value=int() | float() as number):
            result = float(number)
        case ast.Name(id=name):
            result = PARAMETERS[name]
        case ast.UnaryOp(op=op, operand=operand):
            result = float(UNARY[type(op)](fold(operand)))
        case ast.BinOp(left=left, op=op, right=right):
            result = BINARY[type(op)](fold(left), fold(right))
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            result = float(COMPARE[type(op)](fold(left), fold(right)))
        case ast.BoolOp(op=op, values=values):
            result = float((all if isinstance(op, ast.And) else any)(map(fold, values)))
        case _:
            raise TypeError(ast.dump(node))
    if not math.isfinite(result):
        raise OverflowError(result)
    return result


def joined(operand: st.SearchStrategy[str], operators: list[str], most: int) -> st.SearchStrategy[str]:
    """Operands with operators between them, without any brackets: what belongs to what is the reader's task."""
    tail = st.lists(st.tuples(st.sampled_from(operators), operand), max_size=most)
    return st.builds(lambda first, rest: first + "".join(f" {op} {part}" for op, part in rest), operand, tail)


def signed(operand: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    """An operand with up to two signs."""
    return st.builds(operator.add, st.sampled_from(["", "", "-", "+", "- -"]), operand)


def arithmetic(operand: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    """Sums, products and powers of operands."""
    return joined(signed(operand), ["+", "-", "*", "/", "**"], 5)


def logical(operand: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    """Comparisons of operands joined by words."""
    comparison = joined(operand, ["<", "<=", ">", ">=", "==", "!="], 1)
    return joined(st.builds(operator.add, st.sampled_from(["", "not ", "not not "]), comparison), ["and", "or"], 3)


ATOMS = st.sampled_from(["0", "1", "2", "3", "0.5", "10.", "1e2", ".25", *PARAMETERS])
LEVELLED = st.recursive(
    ATOMS, lambda inner: st.one_of(arithmetic(inner), logical(inner)).map(lambda text: f"({text})"), max_leaves=25
)


@given(st.one_of(arithmetic(LEVELLED), logical(arithmetic(LEVELLED))))
def test_parts_belong_together_as_in_python(text: str) -> None:
    tree = ast.parse(text, mode="eval").body
    ours = text.replace("==", "=").replace("!=", "<>")
    try:
        expected = fold(tree)
    except (ArithmeticError, ValueError) as refused:
        for variant in (text, ours):
            try:
                found = evaluate(parse(variant), PARAMETERS.__getitem__)
            except EvaluationError:
                continue
            raise AssertionError((variant, found)) from refused
    else:
        assert evaluate(parse(text), PARAMETERS.__getitem__) == expected
        assert evaluate(parse(ours.replace("**", "^").upper()), lambda name: PARAMETERS[name.lower()]) == expected
