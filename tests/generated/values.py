"""Strategies for the values that fields of a kind hold, as JSON has them."""

from __future__ import annotations

from hypothesis import strategies as st

from mudline.keywords.values import Kind
from mudline.syntax.rows import spells_number
from tests.reading.spellings import EQUATIONS, NAMES

SPECIAL = [
    -0.0,
    0.0,
    5e-324,
    -2.2250738585072014e-308,
    1.7976931348623157e308,
    1e22,
    1e23,
    0.1 + 0.2,
    1e-5,
    123456789.0,
]

reals = st.sampled_from(SPECIAL) | st.floats(allow_nan=False, allow_infinity=False) | st.floats(-1e4, 1e4)
"""Finite doubles: the smallest, the largest, those that are hard to spell."""

wholes = st.integers(-(2**53), 2**53) | st.integers(0, 300)
equations = st.sampled_from(EQUATIONS) | st.text("abc +-*/()^019._\u00e9", max_size=12).map(lambda inner: f"=[{inner}]")
labels = st.sampled_from(["{Seabed End}", "{a, b}", "{}", "{1}", "{\u00e9 \xa0}", '{"}', "{=[x]}"])

_WORDS = [
    "_x",
    "__",
    "Gr\u00f6\u00dfe 2",
    "\u6d77\u5e95",
    "a\u2028b",
    "\U0001f30a",
    "%su%",
    "C",
    "c x",
    "GEN",
    "it's",
    "a.b-c",
    "#1",
    "\\",
]


def sayable(name: str) -> bool:
    """Whether a name is a field by itself wherever a name may stand; numbers parted by blanks are several."""
    words = name.split()
    numbers = [word for word in words if spells_number(word)]
    return name == name.strip(" \t") and bool(words) and (len(words) == 1 or len(numbers) < len(words))


names = st.sampled_from([*NAMES, *_WORDS]) | st.text(
    "abcXYZ019 ._%+-:;()'\u00e9\u00df\xa0\u2028", min_size=1, max_size=10
).map(str.strip).filter(sayable)
"""Names that keyword text can say, those that look like something else included."""


def _no_number(name: str) -> bool:
    return not spells_number(name) and name.lower().lstrip("+-") not in ("nan", "inf", "infinity")


BY_KIND: dict[Kind, st.SearchStrategy[object]] = {
    Kind.REAL: st.one_of(reals, reals, reals, wholes, equations),
    Kind.WHOLE: st.one_of(wholes, wholes, equations),
    Kind.IDENT: st.one_of(wholes, wholes, labels),
    Kind.REAL_OR_NAME: st.one_of(reals, equations, names.filter(_no_number)),
    Kind.NAME: names,
}
