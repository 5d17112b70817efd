"""The value of an equation, and the part at fault where it has none."""

from __future__ import annotations

import math

import pytest

from mudline.basics.limits import DEEPEST
from mudline.language.expression.evaluation import evaluate
from mudline.language.expression.parsing import EvaluationError, ExpressionError, UndefinedName, UnknownFunction, parse

PARAMETERS: dict[str, float | str] = {
    "x": 3.0,
    "y": -2.0,
    "zero": 0.0,
    "whole": 7,
    "Water Depth": 500.0,
    "Folder": "Near",
    "nan": math.nan,
    "huge": 10**400,
}


def value(text: str, **parameters: float | str) -> float | str:
    """The value of an equation with the parameters of this file and some more."""
    return evaluate(parse(text), (PARAMETERS | parameters).__getitem__)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 + 2 * 3", 7.0),
        ("(1 + 2) * 3", 9.0),
        ("10 - 4 - 3", 3.0),
        ("24 / 4 / 2", 3.0),
        ("24 / 4 * 2", 12.0),
        ("2 - 3 + 4", 3.0),
        ("2 * 3 ^ 2", 18.0),
        ("2 ^ 3 ^ 2", 512.0),
        ("2 ** 3 ** 2", 512.0),
        ("(2 ^ 3) ^ 2", 64.0),
        ("-2 ^ 2", -4.0),
        ("(-2) ^ 2", 4.0),
        ("2 ^ -1", 0.5),
        ("2 ^ -2 ^ 2", 0.0625),
        ("2 * -3", -6.0),
        ("2 - -3", 5.0),
        ("--x", 3.0),
        ("+-+x", -3.0),
        ("-x ^ 2 + 1", -8.0),
        ("Water Depth + 5", 505.0),
        ("whole / 2", 3.5),
    ],
)
def test_arithmetic(text: str, expected: float) -> None:
    assert value(text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 < 2", 1),
        ("2 <= 2", 1),
        ("1 > 2", 0),
        ("2 >= 3", 0),
        ("x = 3", 1),
        ("x == 3", 1),
        ("x <> 3", 0),
        ("x != 3", 0),
        ("1 + 1 = 2 * 1", 1),
        ("(1 < 2) + (2 < 3)", 2),
        ("1 < 2 and 2 < 3", 1),
        ("1 AND 0", 0),
        ("0 Or -0.5", 1),
        ("0 or 0 or 0", 0),
        ("1 and 2 and 3", 1),
        ("not 0", 1),
        ("NOT 2", 0),
        ("not 1 = 2", 1),
        ("not not 5", 1),
        ("not (0) + 1", 0),
        ("1 or 1 and 0", 1),
        ("(1 or 1) and 0", 0),
        ("not 1 or 1", 1),
        ("not 0 and 0", 0),
        ("and(1, 2, 0)", 0),
        ("AND (1, 2)", 1),
        ("or(0, 0)", 0),
        ("or(0, 3) + 1", 2),
        ("and(1) and or(1)", 1),
        ("not(0)", 1),
        ('Folder = "near"', 1),
        ('Folder <> "near"', 0),
        ('"a" == "b"', 0),
        ('"a" != "b"', 1),
    ],
)
def test_logic(text: str, expected: float) -> None:
    assert value(text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("if(1, 2, 1/0)", 2.0),
        ("if(0, missing, 2)", 2.0),
        ("IF(x > 0, if(y > 0, unknown(1), x), 1e400)", 3.0),
        ("if(1, 5, sqrt(1, 2))", 5.0),
        ('if(0, "Far", Folder)', "Near"),
        ("zero <> 0 and 1 / zero > 2", 0.0),
        ("zero = 0 or 1 / zero > 2", 1.0),
        ("and(zero, missing)", 0.0),
        ("or(1, missing)", 1.0),
    ],
)
def test_parts_that_are_not_needed_are_not_evaluated(text: str, expected: float | str) -> None:
    assert value(text) == expected


def test_only_the_parameters_that_are_needed_are_looked_up() -> None:
    asked: list[str] = []

    def lookup(name: str) -> float:
        asked.append(name)
        return 1.0

    assert evaluate(parse("if(a, b + B, c) and d"), lookup) == 1.0
    assert asked == ["a", "b", "B", "d"]


def test_a_parameter_goes_before_a_constant() -> None:
    assert value("2*PI") == 2 * math.pi
    assert value("pi()") == math.pi
    assert value("2*pi", pi=3.0) == 6.0


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Folder", "Near"),
        ("(Folder)", "Near"),
        ('"a, b] " + Folder', "a, b] Near"),
        ('"a" + "" + "b" + "c"', "abc"),
        ('""', ""),
    ],
)
def test_text(text: str, expected: str) -> None:
    assert value(text) == expected


WANTS_NUMBER = "expected a number, found text"
TOO_LARGE = "the result is too large"


@pytest.mark.parametrize(
    ("text", "part", "message"),
    [
        ("1 + 2 / zero", "zero", "division by zero"),
        ("1 / (x - 3)", "(x - 3)", "division by zero"),
        ("x + 1e400", "1e400", "the number is too large"),
        ("1" * 400, "1" * 400, "the number is too large"),
        ("9^9^9^9", "9^9^9", TOO_LARGE),
        ("1 + 10 ^ 308 * 10 * 0", "10 ^ 308 * 10", TOO_LARGE),
        ("1e308 + 1 + 1e308 - 1e308", "1e308 + 1 + 1e308", TOO_LARGE),
        ("1 + exp(1000)", "exp(1000)", TOO_LARGE),
        ("deg(1e308)", "deg(1e308)", TOO_LARGE),
        ("1 + (y + 1) ^ 0.5", "(y + 1) ^ 0.5", "a negative number has no fractional power"),
        ("zero ^ -1 + 1", "zero ^ -1", "0 has no negative power"),
        ("1 + sqrt(-4)", "sqrt(-4)", "sqrt(-4) has no value"),
        ("LN(0)", "LN(0)", "ln(0) has no value"),
        ("log(8, 1)", "log(8, 1)", "log(8, 1) has no value"),
        ("mod(5, 0)", "mod(5, 0)", "mod(5, 0) has no value"),
        ("round(1, 0.5)", "round(1, 0.5)", "round(1, 0.5) has no value"),
        ("round(1, 1e9)", "round(1, 1e9)", "round(1, 1e+09) has no value"),
        ("2 * Sqrt(1, 2)", "Sqrt(1, 2)", "sqrt needs 1 argument, found 2"),
        ("ln(8, 2)", "ln(8, 2)", "ln needs 1 argument, found 2"),
        ("min()", "min()", "min needs at least 1 argument, found 0"),
        ("atan2(1)", "atan2(1)", "atan2 needs 2 arguments, found 1"),
        ("pi(1)", "pi(1)", "pi needs 0 arguments, found 1"),
        ("round(1, 2, 3)", "round(1, 2, 3)", "round needs 1 or 2 arguments, found 3"),
        ("if(1, 2)", "if(1, 2)", "if needs 3 arguments, found 2"),
        ("1 + and()", "and()", "and needs at least 1 argument, found 0"),
        ("1 + nan", "nan", "the parameter 'nan' is not a finite number"),
        ("1 + huge", "huge", "the parameter 'huge' is not a finite number"),
        ("x * Folder", "Folder", WANTS_NUMBER),
        ("Folder + 1", "Folder", WANTS_NUMBER),
        ('x + "1"', '"1"', WANTS_NUMBER),
        ('"a" - "b"', '"a"', WANTS_NUMBER),
        ("-(Folder)", "(Folder)", WANTS_NUMBER),
        ("not Folder", "Folder", WANTS_NUMBER),
        ("2 ^ Folder", "Folder", WANTS_NUMBER),
        ("1 and Folder", "Folder", WANTS_NUMBER),
        ("if(Folder, 1, 2)", "Folder", WANTS_NUMBER),
        ("max(1, Folder)", "Folder", WANTS_NUMBER),
        ("Folder = x", "Folder", WANTS_NUMBER),
        ('1 + ("a" < Folder)', '"a" < Folder', "text has no order, expected = or <>"),
    ],
)
def test_faults(text: str, part: str, message: str) -> None:
    expression = parse(text)
    with pytest.raises(EvaluationError) as caught:
        evaluate(expression, PARAMETERS.__getitem__)
    assert str(caught.value) == message
    if text == "9^9^9^9":
        assert caught.value.span == (2, 7)
    else:
        assert caught.value.span == (text.index(part), text.index(part) + len(part))


@pytest.mark.parametrize(
    ("text", "kind", "span", "message"),
    [
        ("x + Missing", UndefinedName, (4, 11), "the parameter 'Missing' is not defined"),
        ("(no such)", UndefinedName, (1, 8), "the parameter 'no such' is not defined"),
        ("1 + convert(1, 2)", UnknownFunction, (4, 11), "the function 'convert' is not known"),
        ('CONVERT(x, "m", "ft")', UnknownFunction, (0, 7), "the function 'CONVERT' is not known"),
        ("x(2)", UnknownFunction, (0, 1), "the function 'x' is not known"),
        ("n" * 50, UndefinedName, (0, 50), f"the parameter '{'n' * 40}...' is not defined"),
    ],
)
def test_unknown_names(text: str, kind: type[ExpressionError], span: tuple[int, int], message: str) -> None:
    expression = parse(text)
    with pytest.raises(kind) as caught:
        evaluate(expression, PARAMETERS.__getitem__)
    assert type(caught.value) is kind
    assert (caught.value.span, caught.value.message) == (span, message)


def test_joined_text_is_limited() -> None:
    half = "a" * 5000
    assert value("t + t", t=half) == half + half
    with pytest.raises(EvaluationError, match="longer than 10000 characters") as caught:
        value('"b" + t + t', t=half)
    assert caught.value.span == (0, 11)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("+".join(["x"] * 5000), 15000.0),
        ("-".join(["1"] * 5000), -4998.0),
        ("*".join(["1"] * 5000), 1.0),
        (" or ".join(["0"] * 2000), 0.0),
        ("max(" + ",".join(["1"] * 4000) + ")", 1.0),
        ("1+(" * DEEPEST + "0" + ")" * DEEPEST, DEEPEST),
    ],
)
def test_long_equations(text: str, expected: float) -> None:
    assert value(text) == expected
