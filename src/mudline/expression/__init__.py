"""Equations, `=[...]`: reading them and evaluating them, without the interpreter's own `eval`."""

from __future__ import annotations

from mudline.expression.errors import EvaluationError, ExpressionError, UndefinedName, UnknownFunction
from mudline.expression.evaluation import evaluate
from mudline.expression.functions import CONSTANTS, FORMS, FUNCTIONS, Form, Function
from mudline.expression.nodes import Expression, NameSpan
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
