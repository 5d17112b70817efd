"""Every function against a worked value, and what its entry in the table says."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.language.expression.evaluation import FUNCTIONS, evaluate
from mudline.language.expression.parsing import parse

# Function -> calls and their values; whole numbers and closed forms, so that nothing is taken from the function itself.
WORKED: dict[str, list[tuple[str, float]]] = {
    "abs": [("abs(-2.5)", 2.5), ("abs(3)", 3.0)],
    "acos": [("acos(1)", 0.0), ("acos(0)", math.pi / 2), ("acos(-1)", math.pi)],
    "asin": [("asin(1)", math.pi / 2), ("asin(-0.5)", -math.pi / 6)],
    "atan": [("atan(1)", math.pi / 4), ("atan(-1)", -math.pi / 4)],
    "atan2": [("atan2(1, -1)", 3 * math.pi / 4), ("atan2(-1, 0)", -math.pi / 2)],
    "ceil": [("ceil(1.1)", 2.0), ("ceil(-1.9)", -1.0), ("ceil(1e300)", 1e300)],
    "cos": [("cos(0)", 1.0), ("cos(pi/3)", 0.5), ("cos(pi)", -1.0)],
    "cosh": [("cosh(0)", 1.0), ("cosh(ln(2))", 1.25)],
    "deg": [("deg(pi)", 180.0)],
    "exp": [("exp(0)", 1.0), ("exp(ln(7))", 7.0)],
    "floor": [("floor(1.9)", 1.0), ("floor(-1.1)", -2.0)],
    "int": [("int(1.9)", 1.0), ("int(-1.9)", -1.0), ("INT(-1e300)", -1e300)],
    "ln": [("ln(1)", 0.0), ("ln(exp(1))", 1.0)],
    "log": [("log(1000)", 3.0), ("log(8, 2)", 3.0), ("log(1000, 10)", 3.0), ("log(0.25, 0.5)", 2.0)],
    "log10": [("log10(0.001)", -3.0)],
    "max": [("max(1, 5, -9)", 5.0), ("max(-2)", -2.0)],
    "min": [("min(1, 5, -9)", -9.0), ("min(4)", 4.0)],
    "mod": [("mod(7, 3)", 1.0), ("mod(-7, 3)", -1.0), ("mod(7, -3)", 1.0), ("mod(5.5, 2)", 1.5)],
    "pi": [("pi()", math.pi)],
    "pow": [("pow(2, 10)", 1024.0), ("pow(-2, 3)", -8.0), ("pow(9, 0.5)", 3.0)],
    "rad": [("rad(180)", math.pi), ("sin(rad(30))", 0.5)],
    "round": [
        ("round(2.5)", 3.0),
        ("round(-2.5)", -3.0),
        ("round(2.4999999999999996)", 2.0),
        ("round(0.49999999999999994)", 0.0),
        ("round(1.25, 1)", 1.3),
        ("round(2.675, 2)", 2.67),  # the double nearest 2.675 lies below it
        ("round(1234.5, -2)", 1200.0),
        ("round(1e308, 5)", 1e308),
        ("round(5e-324, 308)", 0.0),
    ],
    "sign": [("sign(-3)", -1.0), ("sign(0)", 0.0), ("sign(1e-300)", 1.0)],
    "sin": [("sin(0)", 0.0), ("sin(pi/6)", 0.5)],
    "sinh": [("sinh(ln(2))", 0.75)],
    "sqrt": [("sqrt(2)*sqrt(2)", 2.0), ("sqrt(144)", 12.0)],
    "tan": [("tan(pi/4)", 1.0)],
    "tanh": [("tanh(ln(2))", 0.6), ("tanh(1000)", 1.0)],
}


def value(text: str) -> float | str:
    """The value of an equation without parameters."""
    parameters: dict[str, float] = {}
    return evaluate(parse(text), parameters.__getitem__)


@pytest.mark.parametrize(("text", "expected"), [case for cases in WORKED.values() for case in cases])
def test_worked_values(text: str, expected: float) -> None:
    assert value(text) == pytest.approx(expected, rel=4e-16, abs=4e-16)
    assert value(text.upper()) == value(text)


def test_every_function_is_worked() -> None:
    assert set(WORKED) == set(FUNCTIONS)


@given(st.floats(min_value=-1e9, max_value=1e9), st.integers(min_value=-3, max_value=5))
def test_round_is_the_nearest_decimal(x: float, digits: int) -> None:
    rounded = value(f"round({x!r}, {digits})")
    assert isinstance(rounded, float)
    half_spacing = math.ulp(rounded) / 2  # the decimal is the nearest float64
    assert abs(rounded - x) <= 0.5 * 10.0**-digits * (1 + 1e-9) + half_spacing
    assert rounded == float(f"{rounded:.{max(digits, 0)}f}")
