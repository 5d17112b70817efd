"""What is read as an equation, where its parts stand, and what is said of everything else."""

from __future__ import annotations

import math

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mudline.basics.limits import DEEPEST, LONGEST_EQUATION
from mudline.language.diagnostics import Span
from mudline.language.expression.evaluation import FORMS, FUNCTIONS, evaluate
from mudline.language.expression.parsing import Expression, ExpressionError, Name, parse


def names_in(expression: Expression) -> list[str]:
    return [use.name for use in expression.uses]


def test_text_and_names_are_kept_as_written() -> None:
    expression = parse("if(Gravity<10, Depth, Depth*LengthFactor) + MAX(depth, Max(1, 2))")
    assert expression.text == "if(Gravity<10, Depth, Depth*LengthFactor) + MAX(depth, Max(1, 2))"
    assert names_in(expression) == ["Gravity", "Depth", "Depth", "LengthFactor", "depth"]
    assert expression.uses[:2] == (Name(Span(3, 10), "Gravity"), Name(Span(15, 20), "Depth"))


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("Water Depth", ("Water Depth",)),
        ("Water Depth 2 + Vessel Offset", ("Water Depth 2", "Vessel Offset")),
        ("a AND b", ("a", "b")),
        ("a b Or not c d", ("a b", "c d")),
        ("android or nothing", ("android", "nothing")),
        ("and_1 + or.2 + notch", ("and_1", "or.2", "notch")),
        ("sea and_x", ("sea and_x",)),
        ("_under + тяга + 深さ", ("_under", "тяга", "深さ")),
        ("e\u0301tage", ("e\u0301tage",)),
        ("2*pi*r", ("pi", "r")),
        ("  x\t", ("x",)),
    ],
)
def test_names(text: str, names: tuple[str, ...]) -> None:
    assert names_in(parse(text)) == [*names]


VALUE = "a number, a name or '('"


@pytest.mark.parametrize(
    ("text", "start", "end", "message"),
    [
        ("", 0, 0, "the equation is empty"),
        (" \t", 0, 2, "the equation is empty"),
        ("1 +", 3, 3, f"the equation is incomplete, missing {VALUE}"),
        ("(1", 2, 2, "the equation is incomplete, missing an operator or ')'"),
        ("max(1 ", 6, 6, "the equation is incomplete, missing an operator, ',' or ')'"),
        ("pi(", 3, 3, "the equation is incomplete, missing a number, a name, '(' or ')'"),
        ("1)", 1, 2, "found ')', expected an operator"),
        ("max(1,)", 6, 7, f"found ')', expected {VALUE}"),
        ("()", 1, 2, f"found ')', expected {VALUE}"),
        ("1,5", 1, 2, "found ',', expected an operator"),
        ("2 3.5", 2, 5, "found the number 3.5, expected an operator"),
        ("2x", 1, 2, "found the name 'x', expected an operator"),
        ("a  b", 3, 4, "found the name 'b', expected an operator"),
        ('a "b"', 2, 5, "found text in quotation marks, expected an operator"),
        ("2*not x", 2, 5, f"found NOT, expected {VALUE}"),
        ("a and or b", 9, 10, "found the name 'b', expected '('"),
        ("2 * / 3", 4, 5, f"found '/', expected {VALUE}"),
        ("= 3", 0, 1, f"found '=', expected {VALUE}"),
        ("0 < x < 2", 6, 7, "found a second comparison '<', expected AND or OR between two comparisons"),
        ("10 % 3", 3, 4, "found '%', expected an operator"),
        ("[a]", 0, 1, f"found '[', expected {VALUE}"),
        ("a+\x07", 2, 3, f"found '\\x07', expected {VALUE}"),
        ("a+\ud800", 2, 3, f"found '\\ud800', expected {VALUE}"),
        ("1+٣", 2, 3, f"found '٣', expected {VALUE}"),
        ('a + "b', 4, 6, "text opens with a quotation mark and does not close"),
        ("1 " + "2" * 50, 2, 52, "found the number " + "2" * 40 + "..., expected an operator"),
    ],
)
def test_faults(text: str, start: int, end: int, message: str) -> None:
    with pytest.raises(ExpressionError) as caught:
        parse(text)
    assert (caught.value.start, caught.value.end, str(caught.value)) == (start, end, message)
    assert caught.value.span == (start, end)


def nested(levels: int) -> list[str]:
    """Equations with that many levels of one kind inside one another."""
    return [
        "(" * levels + "1" + ")" * levels,
        "-" * levels + "1",
        "+-" * (levels // 2) + "-" * (levels % 2) + "1",
        "not " * levels + "1",
        "2^" * levels + "2",
        "2^-" * (levels // 2) + "(" * (levels % 2) + "2" + ")" * (levels % 2),
        "if(1," * levels + "1" + ",0)" * levels,
        "1+(2*" * levels + "3" + ")" * levels,
    ]


@pytest.mark.parametrize("text", nested(DEEPEST))
def test_nesting_up_to_the_limit_is_read(text: str) -> None:
    assert isinstance(parse(text), Expression)


@pytest.mark.parametrize("text", nested(DEEPEST + 1) + nested(1500))
def test_deeper_nesting_is_refused(text: str) -> None:
    with pytest.raises(ExpressionError, match=r"nested more than 30|longer than 10000") as caught:
        parse(text)
    assert 0 < caught.value.start < caught.value.end <= len(text)


@pytest.mark.parametrize(("opening", "closing", "at"), [("(", ")", 0), ("- ", "", 0), ("2 ^ ", "", 2), ("f (", ")", 2)])
def test_the_fault_of_deep_nesting_begins_where_the_first_part_too_deep_opens(
    opening: str, closing: str, at: int
) -> None:
    text = opening * 2000 + "1" + closing * 2000
    with pytest.raises(ExpressionError, match="nested more than 30") as caught:
        parse(text)
    assert caught.value.span == (DEEPEST * len(opening) + at, len(text))


def test_length_limit() -> None:
    assert not names_in(parse("1".ljust(LONGEST_EQUATION)))
    with pytest.raises(ExpressionError, match="longer than 10000 characters") as caught:
        parse("1".ljust(LONGEST_EQUATION + 3))
    assert caught.value.span == (LONGEST_EQUATION, LONGEST_EQUATION + 3)


PARAMETERS: dict[str, float | str] = {"a": 2.0, "b c": -1e300, "t": "text"}

PIECES = st.sampled_from(
    [
        *"+-*/^()<>=,",
        *("**", "<=", ">=", "<>", "==", "!=", " ", "\t", "\n"),
        *("and", "or", "not", " AND ", " not ", "if(", "pi", "a", "b c", "t", "missing", "é"),
        *("0", "1", ".5", "2.", "1e3", "1d-3", "1e400", "9" * 400, '"x"', '"', "%", "[", "]", "'", "\x00", "\ud83d"),
        *(f"{name}(" for name in (*FUNCTIONS, *FORMS)),
    ]
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
