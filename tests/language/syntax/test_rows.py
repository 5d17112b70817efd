"""The slow row reader says what a table is; the fast one answers the same to the last bit, or declines."""

from __future__ import annotations

import math
import re
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mudline.language.diagnostics import Span
from mudline.language.syntax import rows as reader
from mudline.language.syntax.rows import RawRows, read_number, read_rows, read_rows_slow
from tests.helpers.builders.spellings import ODD_NUMBERS, numbers

NO_NUMBERS = [
    *("", " ", "1 ", " 1", "e5", "1e", "1e+", ".", "+", "-", "--1", "+-1", "1.2.3", "1,5", "0x10", "1_000", "1f"),
    *("1\n", "1e400", "-1e400", "1D400", "9" * 309, "1" * 401, "nan", "NaN", "inf", "-Infinity", "true"),
    *("\u0661\u0662", "1\xa0", "\uff11", "'1'", "\\1", "#1", "x", "1;2"),
]
"""What looks like a number."""
STRANGE = [
    *NO_NUMBERS,
    *("1e-400", "null", "[1]", "=[a,b]", "{a, b}", '"1,2"', "1d", "9" * 401, "1e9999999999", "\ufeff1"),
    *("00", "-00", "-01", "+0", "-0e0", "-0.e5", "-0,", "1 2", "=[", "{", '"', "1\x0b", "0." + "0" * 390 + "1"),
    *("2.2250738585072011e-308", "2.225073858507201e-308", "4.940656458412465e-324", "2e-324"),
    *("1.7976931348623159e308", "9007199254740993", "-9007199254740993.0", "123456789012345678901234567890"),
    "0.1000000000000000055511151231257827",
]
cells = st.one_of(numbers, numbers, st.sampled_from(ODD_NUMBERS), st.sampled_from(STRANGE))


def whole(text: str) -> Span:
    return Span(0, len(text))


def is_same(one: RawRows, other: RawRows) -> bool:
    """Return True for rows that are equal to the last bit, NaN and the sign of zero included."""
    return (
        one.values.shape == other.values.shape
        and one.values.tobytes() == other.values.tobytes()
        and bool(np.array_equal(one.lengths, other.lengths))
        and one.words == other.words
    )


def compared(text: str, columns: int) -> RawRows:
    """The rows of a text by the slow reader, with which the fast one is compared on the whole and on small pieces."""
    slow = read_rows_slow(text, whole(text), columns)
    assert is_same(read_rows(text, whole(text), columns), slow)
    for piece in (reader.PIECE, 12):
        with patch.object(reader, "PIECE", piece):
            assert is_same(read_rows(text, whole(text), columns), slow)
    return slow


def bits(value: float) -> str:
    return value.hex()


@st.composite
def tables(draw: st.DrawFn, fields: st.SearchStrategy[str], *, blanks: bool = True) -> str:
    """Rows with commas, blanks, tabs, any LF or CRLF, of one length or ragged."""
    width = draw(st.integers(1, 4))
    lengths = st.just(width) if draw(st.booleans()) else st.integers(1, 5)
    comma = st.sampled_from([",", ",", ", ", " ,", "\t,\t"] + ([" "] if blanks and draw(st.booleans()) else []))
    lines = []
    for _ in range(draw(st.integers(1, 5))):
        words = draw(lengths.flatmap(lambda count: st.lists(fields, min_size=count, max_size=count)))
        line = words[0] + "".join(draw(comma) + word for word in words[1:])
        lines.append(draw(st.sampled_from(["", " ", "\t"])) + line + draw(st.sampled_from(["", "", " ", ",", ", ,"])))
    end = draw(st.sampled_from(["\n", "\n", "\r\n"]))
    return end.join(lines) + draw(st.sampled_from(["", end]))


@given(tables(cells), st.integers(1, 5))
@example("-0,-0\n", 2)
@example("-0 \n", 1)
@example("-0,-0.0\r\n+0,0\r\n", 2)
@example("1,2\n\n3,4\n", 2)
@example("1,2\n,\n", 2)
@example("1,2,\n", 2)
@example("1,2],[3,4\n", 2)
@example("1e308,1e309\n", 2)
@example("12345678901234567890123,1\n", 2)
@example("1 2\n3 4\n", 2)
@example(" \n", 1)
@example("0,0,0,\n0,0 0", 4)
@example("2.2250738585072011e-308", 1)
def test_fast_is_slow_or_declines(text: str, columns: int) -> None:
    compared(text, columns)


@given(st.lists(st.sampled_from([*"0123456789+-.eEdD, \t\n", "\r\n"]), max_size=40).map("".join), st.integers(1, 4))
@example("-+5\n", 1)
@example("1. .5\n-.5 +2.D1\n", 2)
@example("1 - 2\n", 3)
@example("1..2\n", 2)
@example("1,2\n \n3,4\n", 2)
@example("\ufeff1,2\n3,4\n", 2)
@example(f"0.{'1' * 500}\n", 1)
def test_any_text_of_the_fast_alphabet(text: str, columns: int) -> None:
    compared(text, columns)


@given(
    st.lists(
        st.lists(st.sampled_from(["1", "2.5", "-0.0", "3."]), min_size=2, max_size=3).map(",".join)
        | st.lists(cells, min_size=1, max_size=3).map(", ".join),
        min_size=1,
        max_size=8,
    ),
    st.sampled_from(["\n", "\r\n"]),
    st.integers(1, 4),
)
@example(["1,2", "=[a, b],2", "3,4"], "\n", 2)
@example(["=[a],2", "3,4"], "\r\n", 2)
@example(["3,4", "{A b},2,5"], "\n", 3)
def test_odd_lines_between_plain_ones(lines: list[str], end: str, columns: int) -> None:
    text = end.join(lines)
    for given_text in (text, text + end):
        compared(given_text, columns)


def test_words_lengths_and_columns() -> None:
    rows = compared(" 1, =[a, b],, {x, y}\n 2\n 3, 4, 5, 6, 7\n 1.5 2.5\n 1, 2, 3, 4,,\n", 4)
    assert rows.words == {(0, 1): "=[a, b]", (0, 2): "", (0, 3): "{x, y}"}
    assert rows.lengths.tolist() == [4, 1, 5, 2, 4]
    assert rows.values[2].tolist() == [3.0, 4.0, 5.0, 6.0]
    assert rows.values[3, :2].tolist() == [1.5, 2.5]
    assert np.isnan(rows.values[0, 1:]).all()
    assert np.isnan(rows.values[1, 1:]).all()


@pytest.mark.parametrize(
    ("text", "value"),
    [
        *(("1", 1.0), ("1.", 1.0), (".5", 0.5), ("+1", 1.0), ("01", 1.0), ("-0", -0.0), ("-0.0", -0.0)),
        *(("1e3", 1000.0), ("1D3", 1000.0), ("1d-3", 0.001), ("1.5D+02", 150.0), ("4.9e-324", 5e-324)),
        *(("1e-400", 0.0), ("-1e-400", -0.0), ("9007199254740993", 9007199254740992.0)),
        ("1.7976931348623157E308", 1.7976931348623157e308),
    ],
)
def test_numbers(text: str, value: float) -> None:
    read = read_number(text)
    assert read is not None
    assert bits(read) == bits(value)


@pytest.mark.parametrize("text", NO_NUMBERS)
def test_no_numbers(text: str) -> None:
    assert read_number(text) is None


@given(st.text("0123456789+-.eEdD_ naif", max_size=12))
def test_a_number_is_finite_and_what_python_reads(text: str) -> None:
    value = read_number(text)
    if value is not None:
        assert math.isfinite(value)
        assert bits(value) == bits(float(text.lower().replace("d", "e")))


@given(st.text('=[]"{},/ 1a*\t', max_size=24), st.integers(1, 5))
@example(" 1, =[a*2], 3 ", 4)
@example("=[a[1]], 2", 3)
@example("1, =[a,b], =[", 4)
@example("1]=[2],3", 2)
def test_a_row_of_simple_equations_is_cut_as_any_row(body: str, columns: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        found = reader.row_words(body, columns)
        patch.setattr(reader, "_ONLY_EQUATIONS", re.compile("(?!)"))
        assert found == reader.row_words(body, columns)
