"""What can be wrong with an equation, each with the part of its text at fault."""

from __future__ import annotations

from mudline.diagnostics import Span


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
