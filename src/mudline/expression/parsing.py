"""Reading an equation: the grammar, the limits, and what is said of a text that does not fit.

The grammar defines what an equation is and what its terminals are. One regular expression reads plain equations,
recursive descent the others. What does not fit is given to the parser of the grammar, which has the words for it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from collections.abc import Set as AbstractSet
from functools import cache
from typing import Any, cast

from lark import Lark, Token, UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from mudline.diagnostics import Span
from mudline.expression.nodes import (
    Call,
    Chain,
    Comparison,
    Expression,
    ExpressionError,
    Group,
    Logical,
    Name,
    NameSpan,
    Node,
    Number,
    Plain,
    Power,
    Prefix,
    Text,
    shorten,
)
from mudline.limits import DEEPEST, LONGEST_EQUATION
from mudline.resources import grammar_file
from mudline.syntax.scanning import kept_parser, scanner

# -------------------------------------------------------------------------------------------------------- the readers

SAME_OPERATOR = {"==": "=", "!=": "<>"}
"""The one spelling of operators that have two."""

FORTRAN_EXPONENT = str.maketrans("dD", "ee")
"""The letters of an exponent as `float` reads them."""

_END = "$END"
_LEAVES = frozenset({"NAME", "NUMBER", "TEXT"})
_BEHIND_PRODUCT = frozenset({"ADD", "COMPARE", "AND", "OR", "COMMA", "RPAR", _END})


def plain_pattern(terminals: Mapping[str, str]) -> re.Pattern[str]:
    """Return the pattern of what `read_plain` reads, from the terminals of the grammar as regular expressions."""
    blanks = rf"(?:{terminals['BLANKS']})?+"
    leaf = rf"(?>({terminals['NAME']})|({terminals['NUMBER']}))"
    operator = rf"({terminals['ADD']}|{terminals['MULTIPLY']})"
    return re.compile(f"{blanks}{leaf}{blanks}(?:{operator}{blanks}{leaf}{blanks})?")


def read_plain(text: str, pattern: re.Pattern[str], read: Callable[[str], Node]) -> Expression | None:
    """Return an equation of one or two names or numbers; None where the text is none. `read` gives trees."""
    match = pattern.fullmatch(text)
    if match is None:
        return None
    name, number, operator, second, addend = match.groups()
    names: tuple[NameSpan, ...] = ()
    left = name if number is None else float(number.translate(FORTRAN_EXPONENT))
    if name is not None:
        names = (NameSpan(name, *match.span(1)),)
    right: str | float = 0.0
    if operator is not None:
        right = second if addend is None else float(addend.translate(FORTRAN_EXPONENT))
        if second is not None:
            names = (*names, NameSpan(second, *match.span(4)))
    return Expression(text, names, (), Plain(left, operator or "", right, read))


class _UnfitError(Exception):
    """The text is not an equation, or is nested too deep from the place (code points) on."""

    def __init__(self, place: int = 0) -> None:
        super().__init__()
        self.place = place


def descend(text: str, tokens: re.Pattern[str]) -> Expression:
    """Return an equation; raises ExpressionError where the text is not one, or is nested too deep.

    Args:
        text: what stands between `=[` and `]`.
        tokens: the terminals of the grammar, as `mudline.syntax.scanning.scanner` gives them.
    """
    try:
        return _descend(text, tokens)
    except _UnfitError as unfit:
        refuse(text)
        raise ExpressionError(
            f"the equation is nested more than {DEEPEST} levels deep", unfit.place, len(text)
        ) from None


def _descend(text: str, tokens: re.Pattern[str]) -> Expression:
    kinds: list[str] = []
    spans: list[Span] = []
    at = 0
    for match in tokens.finditer(text):
        span = Span(*match.span())
        if span.start != at:
            raise _UnfitError
        at = span.end
        if (kind := match.lastgroup) and kind != "BLANKS":
            kinds.append(kind)
            spans.append(span)
    if at != len(text):
        raise _UnfitError
    reader = _Reader(text, [*kinds, _END], spans)
    root = reader.disjunction()
    if reader.kinds[reader.at] != _END:
        raise _UnfitError
    return Expression(text, tuple(reader.names), tuple(dict.fromkeys(reader.functions)), root)


class _Reader:
    """One method per rule of the grammar; `at` is the index of the token that comes next."""

    def __init__(self, text: str, kinds: list[str], spans: list[Span]) -> None:
        self.text = text
        self.kinds = kinds
        self.spans = spans
        self.levels = DEEPEST
        self.at = 0
        self.names: list[NameSpan] = []
        self.functions: list[str] = []

    def disjunction(self) -> Node:
        """Read what stands between `=[` and `]`, between brackets, or as an argument."""
        return self._logical("OR", self._conjunction)

    def _conjunction(self) -> Node:
        return self._logical("AND", self._negation)

    def _logical(self, kind: str, rule: Callable[[], Node]) -> Node:
        first = rule()
        if self.kinds[self.at] != kind:
            return first
        operands = [first]
        while self.kinds[self.at] == kind:
            self.at += 1
            operands.append(rule())
        return Logical(Span(first.span.start, operands[-1].span.end), kind.lower(), tuple(operands))

    def _negation(self) -> Node:
        return self._prefix(self._negation) if self.kinds[self.at] == "NOT" else self._comparison()

    def _comparison(self) -> Node:
        left = self._sum()
        if self.kinds[self.at] != "COMPARE":
            return left
        operator = self._passed()
        right = self._sum()
        span = Span(left.span.start, right.span.end)
        return Comparison(span, SAME_OPERATOR.get(operator, operator), left, right)

    def _sum(self) -> Node:
        return self._chain("ADD", self._product)

    def _product(self) -> Node:
        if self.kinds[self.at] in _LEAVES and self.kinds[self.at + 1] in _BEHIND_PRODUCT:  # most of them, in less time
            return self._leaf()
        return self._chain("MULTIPLY", self._signed)

    def _chain(self, kind: str, rule: Callable[[], Node]) -> Node:
        first = rule()
        if self.kinds[self.at] != kind:
            return first
        operands = [first]
        operators: list[str] = []
        while self.kinds[self.at] == kind:
            operators.append(self._passed())
            operands.append(rule())
        return Chain(Span(first.span.start, operands[-1].span.end), tuple(operators), tuple(operands))

    def _signed(self) -> Node:
        if self.kinds[self.at] == "ADD":
            return self._prefix(self._signed)
        base = self._primary()
        if self.kinds[self.at] != "POWER":
            return base
        self.at += 1
        exponent = self._nested(self._signed)
        return Power(Span(base.span.start, exponent.span.end), base, exponent)

    def _primary(self) -> Node:
        kind = self.kinds[self.at]
        if kind in ("NAME", "AND", "OR") and self.kinds[self.at + 1] == "LPAR":
            return self._call()
        if kind == "LPAR":
            start = self.spans[self.at].start
            self.at += 1
            inner = self._nested(self.disjunction)
            return Group(Span(start, self._closing()), inner)
        return self._leaf()

    def _leaf(self) -> Node:
        kind = self.kinds[self.at]
        if kind not in _LEAVES:
            raise _UnfitError
        span = self.spans[self.at]
        written = self._passed()
        if kind == "NAME":
            self.names.append(NameSpan(written, *span))
            return Name(span, written)
        return Text(span, written[1:-1]) if kind == "TEXT" else Number(span, float(written.translate(FORTRAN_EXPONENT)))

    def _call(self) -> Node:
        span = self.spans[self.at]
        name = self._passed()
        self.functions.append(name)
        self.at += 1
        arguments: list[Node] = []
        while self.kinds[self.at] != "RPAR" or arguments:
            arguments.append(self._nested(self.disjunction))
            if self.kinds[self.at] != "COMMA":
                break
            self.at += 1
        return Call(Span(span.start, self._closing()), name, span, tuple(arguments))

    def _prefix(self, rule: Callable[[], Node]) -> Node:
        start = self.spans[self.at].start
        operator = self._passed().lower()
        operand = self._nested(rule)
        return Prefix(Span(start, operand.span.end), operator, operand)

    def _nested(self, rule: Callable[[], Node]) -> Node:
        """Read a part one level further inside."""
        if self.levels == 0:
            raise _UnfitError(self.spans[self.at - 1].start)
        self.levels -= 1
        node = rule()
        self.levels += 1
        return node

    def _passed(self) -> str:
        """Go on to the next token; returns the text of the one before."""
        start, end = self.spans[self.at]
        self.at += 1
        return self.text[start:end]

    def _closing(self) -> int:
        """Go on behind a closing bracket; returns where it ends."""
        if self.kinds[self.at] != "RPAR":
            raise _UnfitError
        self.at += 1
        return self.spans[self.at - 1].end


# ---------------------------------------------------------------------------------------------------------- the grammar


@cache
def _grammar() -> Lark:
    text = grammar_file("expression.lark").read_text(encoding="utf-8")
    return kept_parser("expression", text, lexer="basic")


@cache
def tokens() -> re.Pattern[str]:
    """Return the terminals of the grammar as one regular expression."""
    return scanner(_grammar())


@cache
def plain_equations() -> re.Pattern[str]:
    """Return the pattern of the equations that `read_plain` reads."""
    return plain_pattern({one.name: one.pattern.to_regexp() for one in _grammar().terminals})


def parse(text: str) -> Expression:
    """Read an equation: `text` is what stands between `=[` and `]`.

    Raises:
        ExpressionError: the text is not an equation, too long, or nested too deep (`docs/limits.md`).
    """
    if len(text) > LONGEST_EQUATION:
        raise ExpressionError(f"the equation is longer than {LONGEST_EQUATION} characters", LONGEST_EQUATION, len(text))
    if expression := read_plain(text, plain_equations(), tree):
        return expression
    if not text.strip():
        raise ExpressionError("the equation is empty", 0, len(text))
    return descend(text, tokens())


def tree(text: str) -> Node:
    """Return the parts of an equation; raises ExpressionError where it is not one."""
    return descend(text, tokens()).root


def refuse(text: str) -> None:
    """Raise ExpressionError with the words for what is wrong with a text; nothing if it is an equation."""
    try:
        _grammar().parse(text)
    except UnexpectedToken as error:
        raise _unexpected_token(text, error.token, _accepted(error)) from None
    except UnexpectedCharacters as error:
        raise _unexpected_character(text, cast("int", error.pos_in_stream), _accepted(error)) from None


def _accepted(error: UnexpectedInput) -> AbstractSet[str]:
    """The names of the tokens that could have stood where the reading failed."""
    parser: Any = error.interactive_parser  # has no types
    return frozenset(parser.accepts())


def _unexpected_token(text: str, token: Token, accepted: AbstractSet[str]) -> ExpressionError:
    if token.type == "$END":
        return ExpressionError(f"the equation is incomplete, missing {_expected(accepted)}", len(text), len(text))
    message = f"found {_found(token)}, expected {_expected(accepted)}"
    if token.type == "COMPARE" and "AND" in accepted and "NUMBER" not in accepted:
        message = f"found a second comparison '{token}', expected AND or OR between two comparisons"
    return ExpressionError(message, cast("int", token.start_pos), cast("int", token.end_pos))


def _unexpected_character(text: str, place: int, accepted: AbstractSet[str]) -> ExpressionError:
    if text[place] == '"':
        return ExpressionError("text opens with a quotation mark and does not close", place, len(text))
    return ExpressionError(f"found {text[place]!r}, expected {_expected(accepted)}", place, place + 1)


def _found(token: Token) -> str:
    """A token in plain words."""
    match token.type:
        case "NUMBER":
            return f"the number {shorten(token)}"
        case "NAME":
            return f"the name '{shorten(token)}'"
        case "TEXT":
            return "text in quotation marks"
        case "AND" | "OR" | "NOT":
            return token.upper()
        case _:
            return f"'{token}'"


def _expected(accepted: AbstractSet[str]) -> str:
    """What may stand next, in plain words, from the names of the tokens that may."""
    if "NUMBER" in accepted:
        choices = ["a number", "a name", "'('"]
    else:
        choices = ["'('"] if accepted == {"LPAR"} else ["an operator"]
    if "COMMA" in accepted:
        choices.append("','")
    if "RPAR" in accepted:
        choices.append("')'")
    return " or ".join(filter(None, [", ".join(choices[:-1]), choices[-1]]))
