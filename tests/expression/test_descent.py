"""Recursive descent and plain equations against the grammar: the same trees, and nothing that it does not read."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.expression.evaluation import evaluate
from mudline.expression.nodes import Expression, ExpressionError
from mudline.expression.parsing import (
    LEVELS,
    by_grammar,
    descend,
    parse,
    plain_equations,
    read_plain,
    tokens,
    tree,
)
from mudline.limits import DEEPEST

MARKS = st.sampled_from([*'+-*/^(),=<>"#[ \t', "**", "==", "!=", "<>", "<=", ">=", '""'])
WORDS = st.sampled_from(["and", "or", "not", "AND", "Or", "NOT", "and_1", "nothing", "x", "x y not", "Water Depth"])
VALUES = st.sampled_from(["1", "2.", ".5", "1e3", "1.0D+3", "1e", "1e999", "Größe", "e\u0301t", "b.1", '"text"'])
CALLS = st.sampled_from(["if(", "max(", "f()"])
ANYTHING = st.lists(st.one_of(MARKS, WORDS, VALUES, CALLS), max_size=14).map("".join)


def _joined(parts: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    operators = st.sampled_from([*"+-*/^<=", " and ", " OR ", "**", "<>", "!="])
    return st.one_of(
        st.builds("{}{}{}".format, parts, operators, parts),
        st.builds("{}{}{} {} {}".format, parts, operators, parts, operators, parts),
        st.builds("({})".format, parts),
        st.builds("{}{}".format, st.sampled_from(["-", "+", "not ", "NOT "]), parts),
        st.lists(parts, max_size=3).map(lambda given: f"max({', '.join(given)})"),
        st.lists(parts, min_size=1, max_size=2).map(lambda given: f"and({' ,'.join(given)})"),
    )


EQUATIONS = st.recursive(st.sampled_from(["1", "2.5D1", "x", "Water Depth", '"t"']), _joined, max_leaves=12)


def _shown(expression: Expression | None) -> str:
    """All of an equation, spans and values too."""
    return repr(expression and (expression, expression.root))


def _by_grammar(text: str) -> Expression | None:
    try:
        return by_grammar(text)
    except ExpressionError:
        return None


@given(st.one_of(ANYTHING, EQUATIONS))
def test_the_equation_is_that_of_the_grammar(text: str) -> None:
    assert _shown(descend(text, tokens())) == _shown(_by_grammar(text))


@given(st.one_of(ANYTHING, EQUATIONS, st.lists(st.one_of(MARKS, WORDS, VALUES), max_size=4).map(" ".join)))
def test_a_plain_equation_is_that_of_the_grammar(text: str) -> None:
    found = read_plain(text, plain_equations(), tree)
    assert found is None or _shown(found) == _shown(_by_grammar(text))


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        *((text, True) for text in ("x", " 1 ", "Water Depth+1", "p2 * p1", "1.D3/x y ")),
        *((text, False) for text in ("-1", "x**2", "x and y", '"t"', "f()", "1 + 2 + 3", "1 2", "")),
    ],
)
def test_equations_of_one_or_two_names_or_numbers_are_plain(text: str, *, plain: bool) -> None:
    assert (read_plain(text, plain_equations(), tree) is not None) == plain


def _outcome(expression: Expression, values: dict[str, float | str]) -> str:
    """The value of an equation, or why it has none; the sign of zero included."""
    try:
        return repr(evaluate(expression, values.__getitem__))
    except ExpressionError as error:
        return repr((type(error), error.message, error.span))


LEAVES = st.sampled_from(["x", "y", "pi", "nothing", "0", "1", "2.5D1", "1e308", "1e999"])
NUMBERS = st.one_of(st.sampled_from([0.0, -0.0, math.inf, math.nan, "text", 3]), st.floats())


@given(LEAVES, st.sampled_from(["", *"+-*/"]), LEAVES, NUMBERS, NUMBERS)
def test_a_plain_equation_has_the_value_of_its_tree(
    left: str, operator: str, right: str, x: float | str, y: float | str
) -> None:
    text = f"{left}{operator}{right}" if operator else left
    plain = read_plain(text, plain_equations(), tree)
    assert plain is not None
    assert _outcome(plain, {"x": x, "y": y}) == _outcome(by_grammar(text), {"x": x, "y": y})


@given(EQUATIONS)
def test_what_is_written_as_an_equation_is_mostly_read(text: str) -> None:
    """The strategy gives equations of every form, but for a comparison or a `not` where none may stand."""
    if descend(text, tokens()) is None:
        assert any(mark in text.lower() for mark in ("<", "=", "not"))


def _deep(levels: int) -> Iterator[str]:
    for opening, closing in (("(", ")"), ("-", ""), ("2^", ""), ("not ", ""), ("f(", ")")):
        yield opening * levels + "x" + closing * levels


@pytest.mark.parametrize("text", [*_deep(LEVELS), *_deep(LEVELS + 1), *_deep(DEEPEST)])
def test_deep_nesting_is_left_to_the_grammar(text: str) -> None:
    found = descend(text, tokens())
    assert (found is None) == (text not in list(_deep(LEVELS)))
    assert _shown(parse(text)) == _shown(by_grammar(text))


@pytest.mark.parametrize("text", list(_deep(DEEPEST + 1)))
def test_nesting_beyond_the_limit_is_refused_as_before(text: str) -> None:
    with pytest.raises(ExpressionError, match="nested more than"):
        parse(text)
