"""Equations, `=[...]`: reading them and evaluating them, without the interpreter's own `eval`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
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

_HOMES = {
    name: home
    for home, names in {
        "evaluation": ["CONSTANTS", "FORMS", "FUNCTIONS", "Form", "Function", "evaluate"],
        "nodes": ["EvaluationError", "Expression", "ExpressionError", "NameSpan", "UndefinedName", "UnknownFunction"],
        "parsing": ["DEEPEST", "LONGEST", "parse"],
    }.items()
    for name in names
}


def __getattr__(name: str) -> object:
    """Public names are imported when they are first used: most decks have no equation."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module  # noqa: PLC0415 - as above

    found = globals()[name] = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
    return found


def __dir__() -> list[str]:
    return __all__
