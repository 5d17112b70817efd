"""The parts of an equation, as the grammar arranges them, each with its place in the text, and its errors."""

from __future__ import annotations

from typing import NamedTuple

from mudline.language.diagnostics import Span


class ExpressionError(ValueError):
    """An equation that cannot be read or has no value.

    Attributes:
        message: what was found, and what was expected, in plain words.
        start, end: the part at fault, a half-open range of code points of the equation's text; empty where something
            is missing.
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
        """The part at fault."""
        return Span(self.start, self.end)


class UndefinedName(ExpressionError):  # noqa: N818 - the name of the fault, as rules and messages call it
    """A parameter that nothing defines; the span is its name."""


class UnknownFunction(ExpressionError):  # noqa: N818 - as above
    """A function this evaluator does not know, though the analysis program may; the span is its name."""


class EvaluationError(ExpressionError):
    """A part of an equation without a finite value: division by zero, overflow, text in arithmetic and the like."""


def shorten(text: str) -> str:
    """A piece of an equation as a message quotes it: at most 40 code points, none of them invisible."""
    visible = "".join(char if char.isprintable() else f"\\u{ord(char):04x}" for char in text[:40])
    return visible if len(text) <= 40 else visible + "..."


class Number(NamedTuple):
    """A number; infinite where the text names one beyond the range of a double."""

    span: Span
    value: float


class Text(NamedTuple):
    """Text in double quotes; the value is without them."""

    span: Span
    value: str


class Name(NamedTuple):
    """A parameter, or a constant such as pi, as written."""

    span: Span
    name: str


class Group(NamedTuple):
    """A part in brackets; the span holds the brackets."""

    span: Span
    inner: Node


class Prefix(NamedTuple):
    """A sign or `not` before its operand."""

    span: Span
    operator: str
    operand: Node


class Power(NamedTuple):
    """A base raised to an exponent."""

    span: Span
    base: Node
    exponent: Node


class Comparison(NamedTuple):
    """Two parts compared; the operator is one of < <= > >= = <>."""

    span: Span
    operator: str
    left: Node
    right: Node


class Chain(NamedTuple):
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
    """A function with its arguments; the name is as written."""

    span: Span
    name: str
    name_span: Span
    arguments: tuple[Node, ...]


Node = Number | Text | Name | Group | Prefix | Power | Comparison | Chain | Logical | Call

LEAVES = (Number, Text, Name)
"""The parts without parts."""


class NameSpan(NamedTuple):
    """One use of a parameter: its name as written, and the half-open range of code points where it stands."""

    name: str
    start: int
    end: int


class Expression(NamedTuple):
    """An equation that has been read.

    Attributes:
        text: what stands between `=[` and `]`.
        name_spans: every use of a name that is not a function, in the order of the text; constants such as `pi` are
            among them, as a parameter may bear that name.
        functions: the functions called, as written, each spelling once, in the order of the text.
        root: the whole as a tree of parts.
    """

    text: str
    name_spans: tuple[NameSpan, ...]
    functions: tuple[str, ...]
    root: Node

    @property
    def names(self) -> tuple[str, ...]:
        """The names of `name_spans`, each spelling once, in the order of first use."""
        return tuple(dict.fromkeys(use.name for use in self.name_spans))
