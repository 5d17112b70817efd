"""The functions an equation may call, and the constants it may name.

The manual of the language names `if` and CONVERT and says that others exist; their list is not public. INFERRED: the
functions here are the usual ones under their usual names, angles are radians, `log` is base 10 beside `ln` as in
spreadsheets, `mod`, `int`, `round` and `atan2` follow Fortran. CONVERT is left out: how it is called is not public.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Context, Decimal
from types import MappingProxyType
from typing import Final

CONSTANTS: Final[Mapping[str, float]] = MappingProxyType({"pi": math.pi})
"""Names that have a value when no parameter bears them; in lower case, and compared without case."""


@dataclass(frozen=True, slots=True)
class Form:
    """How a function is called; `most` None means any number of arguments."""

    name: str
    least: int
    most: int | None
    meaning: str

    @property
    def wants(self) -> str:
        """The number of arguments in words."""
        if self.most is None:
            return f"at least {_arguments(self.least)}"
        if self.most > self.least:
            return f"{self.least} or {_arguments(self.most)}"
        return _arguments(self.least)

    def takes(self, count: int) -> bool:
        """Whether that many arguments are right."""
        return self.least <= count and (self.most is None or count <= self.most)


@dataclass(frozen=True, slots=True)
class Function(Form):
    """A function of numbers; `call` may raise ValueError, ZeroDivisionError or OverflowError, or return inf."""

    call: Callable[..., float]


def _arguments(count: int) -> str:
    return "1 argument" if count == 1 else f"{count} arguments"


def _log(x: float, base: float = 10.0) -> float:
    return math.log10(x) if base == 10.0 else math.log(x, base)


def _round(x: float, digits: float = 0.0) -> float:
    if not digits.is_integer() or abs(digits) > 308:
        raise ValueError(digits)
    exact = Decimal(x)
    return float(exact.quantize(Decimal((0, (1,), -int(digits))), ROUND_HALF_UP, Context(prec=700)))


def _sign(x: float) -> float:
    return float((x > 0.0) - (x < 0.0))


def _table(*functions: Function) -> Mapping[str, Function]:
    return MappingProxyType({function.name: function for function in functions})


FUNCTIONS: Final = _table(
    Function("abs", 1, 1, "absolute value", abs),
    Function("acos", 1, 1, "arc cosine in radians, 0 to pi", math.acos),
    Function("asin", 1, 1, "arc sine in radians, -pi/2 to pi/2", math.asin),
    Function("atan", 1, 1, "arc tangent in radians, -pi/2 to pi/2", math.atan),
    Function("atan2", 2, 2, "atan2(y, x): angle of the point (x, y) in radians, -pi to pi", math.atan2),
    Function("ceil", 1, 1, "smallest whole number not below the argument", lambda x: float(math.ceil(x))),
    Function("cos", 1, 1, "cosine of radians", math.cos),
    Function("cosh", 1, 1, "hyperbolic cosine", math.cosh),
    Function("deg", 1, 1, "radians to degrees", math.degrees),
    Function("exp", 1, 1, "e to the power of the argument", math.exp),
    Function("floor", 1, 1, "largest whole number not above the argument", lambda x: float(math.floor(x))),
    Function("int", 1, 1, "whole part: the fraction is cut off, towards zero", lambda x: float(math.trunc(x))),
    Function("ln", 1, 1, "natural logarithm", math.log),
    Function("log", 1, 2, "log(x) to base 10, log(x, base) to the base given", _log),
    Function("log10", 1, 1, "logarithm to base 10", math.log10),
    Function("max", 1, None, "largest argument", lambda *x: max(x)),
    Function("min", 1, None, "smallest argument", lambda *x: min(x)),
    Function("mod", 2, 2, "mod(a, b): remainder of a/b, with the sign of a", math.fmod),
    Function("pi", 0, 0, "3.14159...", lambda: math.pi),
    Function("pow", 2, 2, "pow(a, b): a to the power b", math.pow),
    Function("rad", 1, 1, "degrees to radians", math.radians),
    Function("round", 1, 2, "round(x) to a whole number, round(x, n) to n decimals; halves away from zero", _round),
    Function("sign", 1, 1, "-1, 0 or 1", _sign),
    Function("sin", 1, 1, "sine of radians", math.sin),
    Function("sinh", 1, 1, "hyperbolic sine", math.sinh),
    Function("sqrt", 1, 1, "square root", math.sqrt),
    Function("tan", 1, 1, "tangent of radians", math.tan),
    Function("tanh", 1, 1, "hyperbolic tangent", math.tanh),
)
"""The functions of numbers, by their names in lower case; equations call them in any case."""

FORMS: Final[Mapping[str, Form]] = MappingProxyType(
    {
        "and": Form("and", 1, None, "1 if no argument is 0, else 0; stops at the first that is 0"),
        "if": Form("if", 3, 3, "if(condition, a, b): a if the condition is not 0, else b; the other is not evaluated"),
        "or": Form("or", 1, None, "0 if every argument is 0, else 1; stops at the first that is not 0"),
    },
)
"""What is called like a function but evaluates only the arguments it needs, by name in lower case."""
