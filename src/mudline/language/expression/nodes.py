"""Parts of an equation, as the grammar arranges them, each with its place in the text; errors of equations."""

from __future__ import annotations

from typing import NamedTuple

from mudline.language.diagnostics import Span


class ExpressionError(ValueError):
    """Equation that cannot be read or has no value.

    Attributes:
        message: what was found, and what was expected, in plain words.
        start, end: the faulty part, a half-open range of code points of the equation's text; empty if something is
            missing.
    """

    def __init__(self, message: str, start: int, end: int) -> None:
        super().__init__(message, start, end)
        self.message = message
        self.start = start
        self.end = end

    def __str__(self) -> str:
        return self.message

    @property
    def span(self) -> Span:
        """Faulty part."""
        return Span(self.start, self.end)


class UndefinedName(ExpressionError):  # noqa: N818 - the name of the fault, as rules and messages call it
    """Parameter that is not defined; the span is its name."""


class UnknownFunction(ExpressionError):  # noqa: N818 - as above
    """Function that this evaluator does not know, though the analysis program may; the span is its name."""


class EvaluationError(ExpressionError):
    """Part of an equation without a finite value, for example by division by zero, overflow or text in arithmetic."""


def shorten(text: str) -> str:
    """Return a piece of an equation for a message: at most 40 code points, none of them invisible."""
    visible = "".join(char if char.isprintable() else f"\\u{ord(char):04x}" for char in text[:40])
    return visible if len(text) <= 40 else visible + "..."


class Number(NamedTuple):
    """Number; infinite if the text names a number beyond the range of a double."""

    span: Span
    value: float


class Text(NamedTuple):
    """Text in double quotes; the value is without the quotes."""

    span: Span
    value: str


class Name(NamedTuple):
    """Parameter, or a constant such as pi, as written."""

    span: Span
    name: str


class Brackets(NamedTuple):
    """Part in brackets; the span includes the brackets."""

    span: Span
    inner: Node


class Prefix(NamedTuple):
    """Sign or `not` before its operand."""

    span: Span
    operator: str
    operand: Node


class Power(NamedTuple):
    """Base raised to an exponent."""

    span: Span
    base: Node
    exponent: Node


class Relation(NamedTuple):
    """Comparison of two parts; the operator is one of < <= > >= = <>."""

    span: Span
    operator: str
    left: Node
    right: Node


class OperatorChain(NamedTuple):
    """Operands joined from left to right by + and -, or by * and /: one operator less than operands."""

    span: Span
    operators: tuple[str, ...]
    operands: tuple[Node, ...]


class Logical(NamedTuple):
    """Operands joined by `and`, or by `or`."""

    span: Span
    operator: str
    operands: tuple[Node, ...]


class Call(NamedTuple):
    """Function with its arguments; the name is as written."""

    span: Span
    name: str
    name_span: Span
    arguments: tuple[Node, ...]


Node = Number | Text | Name | Brackets | Prefix | Power | Relation | OperatorChain | Logical | Call


class NameSpan(NamedTuple):
    """Use of a parameter: its name as written, and its place, a half-open range of code points."""

    name: str
    start: int
    end: int


class Expression(NamedTuple):
    """Equation that has been read.

    Attributes:
        text: the text between `=[` and `]`.
        name_spans: every use of a name that is not a function, in the order of the text; constants such as `pi` are
            included, since a parameter may have that name.
        functions: the functions called, as written, each spelling once, in the order of the text.
        root: the equation as a tree of parts.
    """

    text: str
    name_spans: tuple[NameSpan, ...]
    functions: tuple[str, ...]
    root: Node

    @property
    def names(self) -> tuple[str, ...]:
        """Names in `name_spans`, each spelling once, in the order of first use."""
        return tuple(dict.fromkeys(use.name for use in self.name_spans))
