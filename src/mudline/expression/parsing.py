"""Reading an equation: the grammar, the limits, and what is said of a text that does not fit."""

from __future__ import annotations

from collections.abc import Set as AbstractSet
from functools import cache
from re import Pattern
from typing import Any, cast

from lark import Lark, Token, Transformer, Tree, UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from mudline.diagnostics import Span
from mudline.expression.descent import FORTRAN_EXPONENT, SAME_OPERATOR, descend, plain_pattern, read_plain
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
    Power,
    Prefix,
    Text,
    shorten,
    walk,
)
from mudline.resources import grammar_file
from mudline.syntax.scanning import kept_parser, scanner

LONGEST = 10_000
"""The longest equation that is read, in code points."""

DEEPEST = 100
"""The most levels of brackets, calls, signs, `not` and powers inside one another."""

Match = Node | Token


class Builder(Transformer[Token, Node]):
    """Makes the parts of an equation of what the rules of the grammar matched, innermost rules first."""

    def __default__(self, data: str, children: list[Match], meta: object) -> Node | Tree[Match]:  # noqa: C901, PLR0911
        """Return the part that a rule stands for."""
        if data.startswith("_"):  # a repetition, which the rule around it takes apart
            return Tree(data, [*children])
        span = _span(children)
        tokens = [str(part) for part in children if isinstance(part, Token)]
        nodes = tuple(part for part in children if not isinstance(part, Token))
        match data:
            case "number":
                return Number(span, float(tokens[0].translate(FORTRAN_EXPONENT)))
            case "text":
                return Text(span, tokens[0][1:-1])
            case "name":
                return Name(span, tokens[0])
            case "group":
                return Group(span, nodes[0])
            case "call":
                return Call(span, tokens[0], _span(children[:1]), nodes)
            case "signed" | "negation":
                return Prefix(span, tokens[0].lower(), nodes[0])
            case "power":
                return Power(span, *nodes)
            case "comparison":
                return Comparison(span, SAME_OPERATOR.get(tokens[0], tokens[0]), *nodes)
            case "sum" | "product":
                return Chain(span, tuple(tokens), nodes)
            case _:
                return Logical(span, tokens[0].lower(), nodes)


def _span(parts: list[Match]) -> Span:
    first, last = parts[0], parts[-1]
    start = first.start_pos if isinstance(first, Token) else first.span.start
    end = last.end_pos if isinstance(last, Token) else last.span.end
    return Span(cast("int", start), cast("int", end))  # tokens that were read from a text have a place


@cache
def _grammar() -> Lark:
    text = grammar_file("expression.lark").read_text(encoding="utf-8")
    return kept_parser("expression", text, lexer="basic", transformer=Builder())


@cache
def tokens() -> Pattern[str]:
    """Return the terminals of the grammar as one regular expression."""
    return scanner(_grammar())


@cache
def plain_equations() -> Pattern[str]:
    """Return the pattern of the equations that `read_plain` reads."""
    return plain_pattern({one.name: one.pattern.to_regexp() for one in _grammar().terminals})


def parse(text: str) -> Expression:
    """Read an equation: `text` is what stands between `=[` and `]`.

    Raises:
        ExpressionError: the text is not an equation, longer than 10 000 code points, or nested more than 100 deep.
    """
    if len(text) > LONGEST:
        raise ExpressionError(f"the equation is longer than {LONGEST} characters", LONGEST, len(text))
    if expression := read_plain(text, plain_equations(), tree):
        return expression
    if not text.strip():
        raise ExpressionError("the equation is empty", 0, len(text))
    return _read(text)


def tree(text: str) -> Node:
    """Return the parts of an equation; raises ExpressionError where it is not one."""
    return _read(text).root


def _read(text: str) -> Expression:
    return descend(text, tokens()) or by_grammar(text)


def by_grammar(text: str) -> Expression:
    """Return the equation as the grammar gives it; raises ExpressionError where it is not one."""
    return _expression(text, _root(text))


def _root(text: str) -> Node:
    try:
        return cast("Node", _grammar().parse(text))
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
        return ExpressionError(f"the equation ends too early, expected {_expected(accepted)}", len(text), len(text))
    message = f"found {_found(token)}, expected {_expected(accepted)}"
    if token.type == "COMPARE" and "AND" in accepted and "NUMBER" not in accepted:
        message = f"found a second comparison '{token}', expected AND or OR between two comparisons"
    return ExpressionError(message, cast("int", token.start_pos), cast("int", token.end_pos))


def _unexpected_character(text: str, place: int, accepted: AbstractSet[str]) -> ExpressionError:
    if text[place] == '"':
        return ExpressionError("text opens with a quotation mark and does not close", place, len(text))
    return ExpressionError(f"found {text[place]!r}, expected {_expected(accepted)}", place, place + 1)


def _expression(text: str, root: Node) -> Expression:
    names: list[NameSpan] = []
    functions: dict[str, None] = {}
    for node, depth in walk(root):
        if depth > DEEPEST:
            raise ExpressionError(f"the equation is nested more than {DEEPEST} levels deep", *node.span)
        if isinstance(node, Name):
            names.append(NameSpan(node.name, *node.span))
        elif isinstance(node, Call):
            functions[node.name] = None
    return Expression(text, tuple(names), tuple(functions), root)


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
