"""Recursive descent against the grammar: the same trees, and nothing read that the grammar does not read."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.expression import DEEPEST, Expression, ExpressionError, parse
from mudline.expression.descent import LEVELS, descend
from mudline.expression.parsing import by_grammar, tokens

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
