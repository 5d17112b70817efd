"""Equations, `=[...]`: reading them and evaluating them, without the interpreter's own `eval`."""

from __future__ import annotations

from mudline.expression.evaluation import CONSTANTS, FORMS, FUNCTIONS, Form, Function, evaluate
from mudline.expression.nodes import (
    EvaluationError,
    Expression,
    ExpressionError,
    NameSpan,
    UndefinedName,
    UnknownFunction,
)
from mudline.expression.parsing import DEEPEST, LONGEST, parse

__all__ = [
    "CONSTANTS",
    "DEEPEST",
    "FORMS",
    "FUNCTIONS",
    "LONGEST",
    "EvaluationError",
    "Expression",
    "ExpressionError",
    "Form",
    "Function",
    "NameSpan",
    "UndefinedName",
    "UnknownFunction",
    "evaluate",
    "parse",
]
