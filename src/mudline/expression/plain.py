"""Equations of one or two names or numbers, which most are: read by one regular expression, evaluated without a tree.

The grammar defines what an equation is, and `mudline.expression.evaluation` what its value is, or why it has none. An
equation or a value that does not fit here is left to them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping

from mudline.expression.builder import FORTRAN_EXPONENT
from mudline.expression.nodes import Expression, NameSpan, Node, Plain
from mudline.expression.operations import ARITHMETIC

_FIRST, _SECOND = 1, 4
"""The groups of the names."""


def plain_pattern(terminals: Mapping[str, str]) -> re.Pattern[str]:
    """Return the pattern of what is read here, from the terminals of the grammar as regular expressions."""
    blanks = rf"(?:{terminals['BLANKS']})?+"
    leaf = rf"(?>({terminals['NAME']})|({terminals['NUMBER']}))"
    operator = rf"({terminals['ADD']}|{terminals['MULTIPLY']})"
    return re.compile(f"{blanks}{leaf}{blanks}(?:{operator}{blanks}{leaf}{blanks})?")


def read_plain(text: str, pattern: re.Pattern[str], read: Callable[[str], Node]) -> Expression | None:
    """Return an equation of one or two names or numbers; None where the text is none. `read` gives trees."""
    match = pattern.fullmatch(text)
    if match is None:
        return None
    name, number, operator, second, addend = match.groups()
    names: tuple[NameSpan, ...] = ()
    left = name if number is None else float(number.translate(FORTRAN_EXPONENT))
    if name is not None:
        names = (NameSpan(name, *match.span(_FIRST)),)
    right: str | float = 0.0
    if operator is not None:
        right = second if addend is None else float(addend.translate(FORTRAN_EXPONENT))
        if second is not None:
            names = (*names, NameSpan(second, *match.span(_SECOND)))
    return Expression(text, names, (), Plain(left, operator or "", right, read))


def plain_value(plain: Plain, lookup: Callable[[str], float | str]) -> float | None:
    """Return the value of a plain equation; None unless it and those in it are finite numbers that `lookup` has."""
    left, operator, right, _ = plain
    try:
        a = lookup(left) if isinstance(left, str) else left
        b = lookup(right) if isinstance(right, str) else right
        if type(a) is not float or type(b) is not float:
            return None
        value = ARITHMETIC[operator](a, b) if operator else a
    except (KeyError, ZeroDivisionError):
        return None
    return value if math.isfinite(a) and math.isfinite(b) and math.isfinite(value) else None
