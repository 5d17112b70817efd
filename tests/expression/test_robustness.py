"""Whatever stands between the brackets: a value, or an error of ours with a place inside the text."""

from __future__ import annotations

import math

from hypothesis import example, given
from hypothesis import strategies as st

from mudline.expression.evaluation import FORMS, FUNCTIONS, evaluate
from mudline.expression.nodes import ExpressionError
from mudline.expression.parsing import parse

PARAMETERS: dict[str, float | str] = {"a": 2.0, "b c": -1e300, "t": "text"}

PIECES = st.sampled_from(
    [
        *"+-*/^()<>=,",
        *("**", "<=", ">=", "<>", "==", "!=", " ", "\t", "\n"),
        *("and", "or", "not", " AND ", " not ", "if(", "pi", "a", "b c", "t", "missing", "é"),
        *("0", "1", ".5", "2.", "1e3", "1d-3", "1e400", "9" * 400, '"x"', '"', "%", "[", "]", "'", "\x00", "\ud83d"),
        *(f"{name}(" for name in (*FUNCTIONS, *FORMS)),
    ],
)


def check(text: str) -> None:
    """Reading and evaluating gives a finite number, text, or an error inside the text."""
    outcome: float | str | ExpressionError
    try:
        outcome = evaluate(parse(text), PARAMETERS.__getitem__)
    except ExpressionError as error:
        outcome = error
    if isinstance(outcome, ExpressionError):
        assert 0 <= outcome.start <= outcome.end <= len(text)
        assert outcome.message.isprintable()
        assert len(outcome.message) < 200
    elif isinstance(outcome, float):
        assert math.isfinite(outcome)
    else:
        assert type(outcome) is str


@given(st.text())
def test_any_text(text: str) -> None:
    check(text)


@given(st.text(alphabet=st.characters(codec=None, categories=["Cs", "Cc", "Zs", "Mn", "Lo", "Nd", "Sm"])))
def test_text_of_unusual_characters(text: str) -> None:
    check(text)


@given(st.lists(PIECES, max_size=60).map("".join))
@example("9^9^9^9")
@example("(" * 10_000)
@example("-" * 10_001)
@example("not " * 2_500)
@example("2^" * 4_999 + "2")
@example("if(1," * 1_600 + "1" + ",0)" * 600)
@example('"' + "\x07" * 9_000)
@example("a" * 10_000 + "(")
def test_pieces_of_equations(text: str) -> None:
    check(text)
