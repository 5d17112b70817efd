"""Small faults, one at a time, in the functions of a module: what a mutant is.

Comparisons get or lose their border, are turned round; `and` is `or`; `+ * /` and the like are their opposites; numbers
grow by one; conditions are negated; a return gives nothing; a call loses a named argument or is left out; `break` and
`continue` change places. Texts stay, and so does `strict=`, which only guards against faults elsewhere.
What a module does when it is imported (tables, defaults) is not changed.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import NamedTuple

_PAIRS = (
    *((ast.Lt, ast.LtE), (ast.Gt, ast.GtE), (ast.Eq, ast.NotEq), (ast.Is, ast.IsNot), (ast.In, ast.NotIn)),
    *((ast.Add, ast.Sub), (ast.Mult, ast.Div), (ast.LShift, ast.RShift), (ast.BitAnd, ast.BitOr), (ast.And, ast.Or)),
    (ast.Break, ast.Continue),
)
_OPPOSITE: dict[type[ast.AST], type[ast.AST]] = {
    **{one: other for pair in _PAIRS for one, other in (pair, reversed(pair))},
    **dict.fromkeys((ast.FloorDiv, ast.Mod, ast.Pow), ast.Mult),
    ast.BitXor: ast.BitAnd,
    ast.USub: ast.UAdd,
}
_LEFT = {"annotation", "returns", "decorator_list", "args", "type_params"}
"""Fields of definitions and annotations that are no work of the function."""


class Mutant(NamedTuple):
    """A fault: its line, what stands there and what instead, and the lines of the statement it is in."""

    line: int
    before: str
    after: str
    lines: range


def mutants(tree: ast.Module) -> Iterator[Mutant]:
    """Yield the mutants of a module; while one is yielded the tree has it."""
    for node, lines in _within_functions(tree, inside=False, lines=range(0)):
        for field, value in _edits(node):
            held, before = getattr(node, field), _shown(node)
            setattr(node, field, value)
            ast.fix_missing_locations(tree)
            try:
                yield Mutant(getattr(node, "lineno", lines.start), before, _shown(node), lines)
            finally:
                setattr(node, field, held)


def _within_functions(node: ast.AST, *, inside: bool, lines: range) -> Iterator[tuple[ast.AST, range]]:
    """Every node in the body of a function, with the lines of its statement, of a compound one those of its head."""
    definition = isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
    if isinstance(node, ast.stmt | ast.ExceptHandler | ast.Lambda):
        body = getattr(node, "body", None)
        end = body[0].lineno - 1 if isinstance(body, list) else node.end_lineno or node.lineno
        lines = range(node.lineno, max(end, node.lineno) + 1)
    if inside:
        yield node, lines
    for field, value in ast.iter_fields(node):
        if field in _LEFT and (definition or not isinstance(node, ast.Call)):
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not (isinstance(child, ast.keyword) and child.arg == "strict"):
                yield from _within_functions(child, inside=inside or definition, lines=lines)


def _edits(node: ast.AST) -> Iterator[tuple[str, object]]:
    """The fields of a node that can be changed, each with what it becomes."""
    yield from _conditions(node)
    match node:
        case ast.BinOp(op=op) | ast.BoolOp(op=op) | ast.AugAssign(op=op) | ast.UnaryOp(op=op) if type(op) in _OPPOSITE:
            yield "op", _OPPOSITE[type(op)]()
        case ast.Constant(value=bool() as value):
            yield "value", not value
        case ast.Constant(value=int() | float() as value):
            yield "value", value + 1
        case ast.Return(value=ast.expr() as given) if ast.unparse(given) != "None":
            yield "value", None
        case ast.Expr(value=ast.Call()):
            yield "value", ast.Constant(None)
        case ast.Call(keywords=named):
            for index, keyword in enumerate(named):
                if keyword.arg not in {None, "strict"}:
                    yield "keywords", [*named[:index], *named[index + 1 :]]
        case ast.Break() | ast.Continue():
            yield "__class__", _OPPOSITE[type(node)]


def _conditions(node: ast.AST) -> Iterator[tuple[str, object]]:
    match node:
        case ast.Compare(ops=ops):
            for index, op in enumerate(ops):
                others = [_OPPOSITE[type(op)]]
                if isinstance(op, ast.Lt | ast.LtE | ast.Gt | ast.GtE):
                    others.append(ast.Gt if isinstance(op, ast.Lt | ast.LtE) else ast.Lt)
                for other in others:
                    yield "ops", [*ops[:index], other(), *ops[index + 1 :]]
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield "operand", _negated(operand)
        case ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test):
            if not isinstance(test, ast.Compare | ast.UnaryOp):
                yield "test", _negated(test)
        case ast.comprehension(ifs=ifs):
            for index, test in enumerate(ifs):
                yield "ifs", [*ifs[:index], _negated(test), *ifs[index + 1 :]]


def _negated(test: ast.expr) -> ast.expr:
    return ast.UnaryOp(ast.Not(), test)


def _shown(node: ast.AST) -> str:
    """A node as text, of a compound statement its condition."""
    if isinstance(node, ast.comprehension):
        return ast.unparse(ast.ListComp(ast.Name("each"), [node]))
    return ast.unparse(node.test if isinstance(node, ast.If | ast.While) else node)
