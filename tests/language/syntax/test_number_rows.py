"""Rows of numbers that are read many at once: each number is the double that `float` gives, in every spelling."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

import mudline
from mudline.language.diagnostics import DeckError, Span
from mudline.language.syntax.rows import read_number, read_rows, read_rows_slow
from mudline.language.syntax.source import Source
from tests.language.syntax.test_rows import is_same

RNG = np.random.default_rng(20)
MANY = 10_000


def bit_patterns() -> NDArray[np.float64]:
    found = RNG.integers(0, 2**64, MANY + 200, dtype=np.uint64).view(np.float64)
    return found[np.isfinite(found)][:MANY]


UNIFORM = RNG.uniform(-1000.0, 1000.0, MANY)
SMALL = RNG.random(MANY)
WIDE = 10.0 ** RNG.uniform(-20, 20, MANY)
TIES = RNG.integers(2**52, 2**53, MANY)
SPELLINGS: dict[str, tuple[NDArray[np.generic], Callable[..., str]]] = {
    "three places": (UNIFORM, "{:.3f}".format),
    "nine digits": (UNIFORM, "{:.9g}".format),
    "shortest": (UNIFORM, repr),
    "shortest below one": (SMALL, repr),
    "seventeen digits": (UNIFORM, "{:.16E}".format),
    "six places and exponent": (WIDE, "{:.6E}".format),
    "any bits": (bit_patterns(), repr),
    "any bits, more digits than needed": (bit_patterns(), "{:.24e}".format),
    "exact decimals": (SMALL, "{:.40f}".format),
    "integers": (RNG.integers(-(10**18), 10**18, MANY), str),
    "nineteen digits": (RNG.integers(10**18, 9 * 10**18, MANY), "{}.".format),
    "ties": (TIES, "{}.5".format),
    "nearly ties": (TIES, "{}.50000000000000000001".format),
    "subnormals": (SMALL * 1e-308, repr),
    "largest": (SMALL * 0.79 + 1.0, "{!r}e308".format),
    "no whole part": (SMALL, lambda value: f"{value:.6f}"[1:]),
    "no fraction": (UNIFORM, "{:.0f}.".format),
    "plus": (UNIFORM, "{:+.4f}".format),
    "exponent D": (WIDE, lambda value: f"{value:.8e}".replace("e", "D")),
    "zeros in front": (UNIFORM, "{:030.12f}".format),
}


@pytest.mark.untraced
@pytest.mark.parametrize("name", SPELLINGS)
@pytest.mark.parametrize("comma", [", ", " "], ids=["commas", "blanks"])
def test_many_numbers_of_a_spelling(name: str, comma: str) -> None:
    values, spelling = SPELLINGS[name]
    words = [spelling(value) for value in values.tolist()][comma == " " :: 2]
    text = "".join(f" {first}{comma}{second}\n" for first, second in zip(words[::2], words[1::2], strict=False))
    found = read_rows(text, Span(0, len(text)), 2)
    given_words = words[: 2 * (len(words) // 2)]
    expected = np.array([read_number(word) for word in given_words], dtype=np.float64)
    assert found.values.ravel().tobytes() == expected.tobytes()
    assert found.words == {}


BAD = {
    "letter": ("{}, 2O.5", 2),
    "points": ("{}, 1.2.3", 2),
    "signs": ("{}, --1", 2),
    "exponent": ("{}, 1e", 2),
    "too large": ("{}, 1e400", 2),
    "not a number": ("{}, nan", 2),
    "script": ("{}, \u0661", 2),
    "no field": ("{}, ", 2),
    "one field": ("{}", 1),
    "three fields": ("{}, 1, 2", 1),
}


@pytest.mark.parametrize("kind", BAD)
def test_every_bad_field_of_a_long_table_is_named(kind: str) -> None:
    row, field = BAD[kind]
    head = ["$MODEL", "*SEABED STIFFNESS", " CURVE=clay"]
    lines = [f" {n}.25, {n}.5" for n in range(30_000)]
    wrong = [0, 1, 2, 777, 12_000, 12_001, 20_000, 29_998]
    for n in wrong:
        lines[n] = f" {row.format(f'{n}.25')}"
    with pytest.raises(DeckError) as caught:
        mudline.from_keyword("\n".join([*head, *lines, ""]))
    found = [(one.line, one.column) for one in caught.value.diagnostics]
    columns = [lines[n].index(",") + 3 if field == 2 and kind != "no field" else 2 for n in wrong]
    if kind != "no field":
        assert found == [(len(head) + n + 1, column) for n, column in zip(wrong, columns, strict=True)]
    else:
        assert [line for line, _ in found] == [len(head) + n + 1 for n in wrong]


@pytest.mark.covered
def test_long_tables_are_slow_rows_whatever_stands_in_a_few_lines() -> None:
    lines = [f" {n}, {n / 7!r}" for n in range(40_000)]
    for n, line in ((3, "=[a*2], 4"), (9_999, "{end}, 1"), (20_000, "1, 2, 3, 4"), (20_001, "1 2"), (39_999, "7")):
        lines[n] = f" {line}"
    for end in ("\n", "\r\n"):
        text = end.join(lines)
        for columns in (2, 3):
            found = read_rows(text, Span(0, len(text)), columns)
            assert is_same(found, read_rows_slow(text, Span(0, len(text)), columns))


@given(st.text(st.sampled_from("1*$\x0c\x1a \r\n\xe9\u2028"), max_size=40))
def test_lines_begin_behind_every_line_end(text: str) -> None:
    source = Source("", text)
    ends = text.replace("\r\n", "\x00\n").replace("\r", "\n").replace("\x00", " ")
    assert list(source.line_starts) == [0, *(at + 1 for at, char in enumerate(ends) if char == "\n")]
    for offset in range(len(text) + 1):
        assert source.offset(*source.position(offset)) == offset
