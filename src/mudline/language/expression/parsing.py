"""Reading of equations: grammar, limits, and messages for text that is not an equation.

Lark reads an equation by `grammar/expression.lark` and creates the nodes while it reads, so nesting costs no stack.
"""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from functools import lru_cache
from typing import Any, NamedTuple, cast

from lark import Lark, Token, Transformer, UnexpectedCharacters, UnexpectedInput, UnexpectedToken, v_args

from mudline.basics.limits import DEEPEST, LONGEST_EQUATION
from mudline.language.diagnostics import Span
from mudline.language.syntax.grammars import parser


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


class Expression(NamedTuple):
    """Equation that has been read.

    Attributes:
        text: the text between `=[` and `]`.
        uses: every use of a name that is not a function, in the order of the text; constants such as `pi` are
            included, since a parameter may have that name.
        root: the equation as a tree of parts.
    """

    text: str
    uses: tuple[Name, ...]
    root: Node


SAME_OPERATOR = {"==": "=", "!=": "<>"}
"""Preferred spelling of operators that have two."""

FORTRAN_EXPONENT = str.maketrans("dD", "ee")
"""Letters of Fortran exponents, translated to those that `float` reads."""


@lru_cache(256)
def parse(text: str) -> Expression:
    """Return the equation in a text: the part between `=[` and `]`.

    The last equations are cached: decks of a project share theirs, and a deck is evaluated more than once.

    Raises:
        ExpressionError: the text is not an equation, too long, or nested too deep (`docs/limits.md`).
    """
    if len(text) > LONGEST_EQUATION:
        raise ExpressionError(f"the equation is longer than {LONGEST_EQUATION} characters", LONGEST_EQUATION, len(text))
    if not text.strip():
        raise ExpressionError("the equation is empty", 0, len(text))
    try:
        root = cast("Node", equation_grammar().parse(text))
    except UnexpectedToken as error:
        raise _unexpected_token(text, error.token, _accepted(error)) from None
    except UnexpectedCharacters as error:
        raise _unexpected_character(text, cast("int", error.pos_in_stream), _accepted(error)) from None
    return Expression(text, tuple(node for node in _nodes(text, root) if isinstance(node, Name)), root)


def equation_grammar() -> Lark:
    """Return the parser of equations, whose result are nodes."""
    return parser("expression", "disjunction", _Nodes)


# ----------------------------------------------------------------------------------------------------------- the nodes


@v_args(inline=True)
class _Nodes(Transformer[Token, Node]):
    """Nodes of the rules of the grammar: a method for each rule; a token with a name in the grammar is a part."""

    def number(self, token: Token) -> Number:
        return Number(_span(token), float(token.translate(FORTRAN_EXPONENT)))

    def text(self, token: Token) -> Text:
        return Text(_span(token), token[1:-1])

    def name(self, token: Token) -> Name:
        return Name(_span(token), str(token))

    def group(self, opening: Token, inner: Node, closing: Token) -> Brackets:
        return Brackets(_span(opening, closing), inner)

    def call(self, name: Token, _opening: Token, *others: Node | Token) -> Call:
        return Call(_span(name, others[-1]), str(name), _span(name), cast("tuple[Node, ...]", others[:-1]))

    def prefix(self, operator: Token, operand: Node) -> Prefix:
        return Prefix(_span(operator, operand), operator.lower(), operand)

    def power(self, base: Node, _operator: Token, exponent: Node) -> Power:
        return Power(_span(base, exponent), base, exponent)

    def comparison(self, left: Node, operator: Token, right: Node) -> Relation:
        return Relation(_span(left, right), SAME_OPERATOR.get(operator, str(operator)), left, right)

    def chain(self, *parts: Node | Token) -> OperatorChain:
        operators = tuple(str(token) for token in parts[1::2])
        return OperatorChain(_span(parts[0], parts[-1]), operators, cast("tuple[Node, ...]", parts[::2]))

    def logical(self, *parts: Node | Token) -> Logical:
        operator = str(parts[1]).lower()
        return Logical(_span(parts[0], parts[-1]), operator, cast("tuple[Node, ...]", parts[::2]))


MAKES = _Nodes
"""Class that creates an equation from the parts that the grammar names."""


def _span(first: Token | Node, last: Token | Node | None = None) -> Span:
    """Return the span from the start of a part to the end of the last part, or of the part itself."""
    start = first.start_pos if isinstance(first, Token) else first.span.start
    last = last or first
    end = last.end_pos if isinstance(last, Token) else last.span.end
    return Span(cast("int", start), cast("int", end))


def _nodes(text: str, root: Node) -> Iterator[Node]:
    """Yield all nodes in the order of the text; raise ExpressionError if they are nested too deep."""
    waiting = [(root, 0, 0)]
    while waiting:
        node, level, opening = waiting.pop()
        if level > DEEPEST:
            start = len(text) - len(text[opening:].lstrip())
            raise ExpressionError(f"the equation is nested more than {DEEPEST} levels deep", start, len(text))
        yield node
        waiting += reversed([(part, level + deeper, opening) for part, deeper, opening in _parts(node)])


def _parts(node: Node) -> list[tuple[Node, bool, int]]:
    """Return the inner parts of a node: part, True if a level deeper, offset from which its opening follows."""
    match node:
        case Brackets(inner=part) | Prefix(operand=part):
            return [(part, True, node.span.start)]
        case Power():
            return [(node.base, False, 0), (node.exponent, True, node.base.span.end)]
        case Relation():
            return [(node.left, False, 0), (node.right, False, 0)]
        case OperatorChain() | Logical():
            return [(part, False, 0) for part in node.operands]
        case Call(arguments=parts):
            before = [node.name_span.end, *(part.span.end for part in parts)]
            return [(part, True, end) for part, end in zip(parts, before, strict=False)]
        case _:
            return []


# ----------------------------------------------------------------------------------------------------------- the words


def _accepted(error: UnexpectedInput) -> AbstractSet[str]:
    """Return the names of the tokens that were allowed where reading failed."""
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
    """Return a token in plain words."""
    named = {"NUMBER": f"the number {shorten(token)}", "NAME": f"the name '{shorten(token)}'"}
    named |= {"TEXT": "text in quotation marks", **dict.fromkeys(("AND", "OR", "NOT"), token.upper())}
    return named.get(token.type, f"'{token}'")


def _expected(accepted: AbstractSet[str]) -> str:
    """Return the allowed next tokens in plain words, from their names."""
    if "NUMBER" in accepted:
        choices = ["a number", "a name", "'('"]
    else:
        choices = ["'('"] if accepted == {"LPAR"} else ["an operator"]
    if "COMMA" in accepted:
        choices.append("','")
    if "RPAR" in accepted:
        choices.append("')'")
    return " or ".join(filter(None, [", ".join(choices[:-1]), choices[-1]]))
