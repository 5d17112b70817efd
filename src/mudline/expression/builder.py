"""From the grammar's matches to the parts of an equation."""

from __future__ import annotations

from typing import cast

from lark import Token, Transformer

from mudline.diagnostics import Span
from mudline.expression.nodes import Call, Chain, Comparison, Group, Logical, Name, Node, Number, Power, Prefix, Text

Match = Node | Token

SAME_OPERATOR = {"==": "=", "!=": "<>"}
"""The one spelling of operators that have two."""

FORTRAN_EXPONENT = str.maketrans("dD", "ee")
"""The letters of an exponent as `float` reads them."""


class Builder(Transformer[Token, Node]):
    """One method per rule of the grammar, called with what the rule matched, innermost rules first."""

    def number(self, parts: list[Match]) -> Node:
        """A number literal."""
        return Number(_span(parts), float(_tokens(parts)[0].translate(FORTRAN_EXPONENT)))

    def text(self, parts: list[Match]) -> Node:
        """Text in double quotes."""
        return Text(_span(parts), _tokens(parts)[0][1:-1])

    def name(self, parts: list[Match]) -> Node:
        """A parameter or constant."""
        return Name(_span(parts), str(_tokens(parts)[0]))

    def group(self, parts: list[Match]) -> Node:
        """A part in brackets."""
        return Group(_span(parts), _nodes(parts)[0])

    def call(self, parts: list[Match]) -> Node:
        """A function call."""
        name = _tokens(parts)[0]
        return Call(_span(parts), str(name), _span([name]), _nodes(parts))

    def prefix(self, parts: list[Match]) -> Node:
        """A sign or `not` with its operand."""
        return Prefix(_span(parts), _tokens(parts)[0].lower(), _nodes(parts)[0])

    def power(self, parts: list[Match]) -> Node:
        """A power."""
        base, exponent = _nodes(parts)
        return Power(_span(parts), base, exponent)

    def comparison(self, parts: list[Match]) -> Node:
        """A comparison."""
        operator = str(_tokens(parts)[0])
        left, right = _nodes(parts)
        return Comparison(_span(parts), SAME_OPERATOR.get(operator, operator), left, right)

    def chain(self, parts: list[Match]) -> Node:
        """A sum or a product."""
        return Chain(_span(parts), tuple(str(token) for token in _tokens(parts)), _nodes(parts))

    def logical(self, parts: list[Match]) -> Node:
        """Operands joined by `and`, or by `or`."""
        return Logical(_span(parts), _tokens(parts)[0].lower(), _nodes(parts))

    negation = signed = prefix
    sum = product = chain
    conjunction = disjunction = logical


def _tokens(parts: list[Match]) -> list[Token]:
    return [part for part in parts if isinstance(part, Token)]


def _nodes(parts: list[Match]) -> tuple[Node, ...]:
    return tuple(part for part in parts if not isinstance(part, Token))


def _span(parts: list[Match]) -> Span:
    first, last = parts[0], parts[-1]
    start = first.start_pos if isinstance(first, Token) else first.span.start
    end = last.end_pos if isinstance(last, Token) else last.span.end
    return Span(cast("int", start), cast("int", end))  # tokens that were read from a text have a place
