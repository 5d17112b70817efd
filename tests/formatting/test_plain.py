"""Rows laid out as arrays of characters are those that the row-by-row way gives."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.formatting.rows import Columns, PlainRows, RowKind, WordRows, word_rows
from mudline.keywords.library.element import ElementRow
from mudline.keywords.library.node import NodeRow
from mudline.keywords.model import Row, record_schema
from mudline.syntax.rows import read_number
from tests.builders.spellings import numbers


def kind(row: type[Row]) -> RowKind:
    columns = record_schema(row).columns
    return RowKind(columns[0], tuple(columns), table=True)


def laid_out(rows: WordRows | PlainRows, row: type[Row], *others: WordRows | PlainRows) -> str:
    columns = Columns(kind(row))
    for part in (rows, *others):
        part.measure(columns)
    return rows.lines(columns.shapes())


_fields = st.one_of(numbers, numbers, st.just(""), st.just("1" * 40), st.sampled_from(["0", "1.5", "-2E+3", "+.5d0"]))
_pads = st.sampled_from(["", " ", "\t", "  "])
_row = st.lists(st.tuples(_pads, _fields, _pads).map("".join), min_size=1, max_size=5).map(",".join)
_ends = st.sampled_from(["\n", "\n", "\r\n", ",\n", " , ,\n"])
_lines = st.lists(
    st.tuples(_row.filter(lambda row: bool(row.strip(" \t"))), _ends).map("".join), min_size=1, max_size=8
)


@given(_lines.map("".join), st.booleans())
@settings(max_examples=125)
def test_both_ways_give_the_same(text: str, cut: bool) -> None:
    text = text.rstrip("\r\n") if cut else text
    plain = PlainRows.read(text, 4)
    words = word_rows(text, 4)
    if plain is not None:
        assert laid_out(plain, NodeRow) == laid_out(words, NodeRow)
        other = word_rows("1234567.5, {label}, =[a, b]\n", 4)
        assert laid_out(plain, ElementRow, other) == laid_out(words, ElementRow, other)


@given(
    st.lists(st.lists(numbers.filter(lambda text: read_number(text) is not None), min_size=2, max_size=4), min_size=1)
)
@settings(max_examples=60)
def test_numbers_parted_by_blanks(rows: list[list[str]]) -> None:
    text = "".join(" \t" + "  ".join(row) + " \r\n" for row in rows)
    plain = PlainRows.read(text, 4)
    assert plain is not None
    assert laid_out(plain, NodeRow) == laid_out(word_rows(text, 4), NodeRow)


@pytest.mark.parametrize(
    "text",
    [
        "1, =[a]\n",
        "1, {a}\n",
        "1, abc\n",
        "1, \xe9\n",
        "1, e5\n",
        "1, 2\n3 4\n",
        "1, 2\n, ,\n",
        ",\n",
        "1, 2, 3, 4, 5\n",
        "1 , 2 3\n",
    ],
)
def test_what_is_not_simply_numbers_is_declined(text: str) -> None:
    assert PlainRows.read(text, 4) is None


def test_empty_fields_behind_those_that_count_go() -> None:
    rows = PlainRows.read("1,2,3,4,\n10,20,30,40,, ,\n5,6\n", 4)
    assert rows is not None
    assert laid_out(rows, NodeRow) == "  1,  2,  3,  4\n 10, 20, 30, 40\n  5,  6\n"


def test_decimal_points_stand_under_each_other() -> None:
    rows = PlainRows.read("1,0,-1.5E+02\n10,100.25,3D0\n100,.5,,\n", 4)
    assert rows is not None
    assert laid_out(rows, NodeRow) == "   1,   0,    -1.5E+02\n  10, 100.25,  3D0\n 100,    .5\n"


def test_a_very_long_number_does_not_widen_its_column() -> None:
    text = f"1,{'1' * 33},5\n20,2,6\n"
    rows = PlainRows.read(text, 4)
    assert rows is not None
    assert laid_out(rows, NodeRow) == f"  1, {'1' * 33}, 5\n 20, 2, 6\n"
    assert laid_out(word_rows(text, 4), NodeRow) == laid_out(rows, NodeRow)
