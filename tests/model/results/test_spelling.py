"""How values are spelled in JSON and CSV."""

from __future__ import annotations

import csv
import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.basics.quantities import csv_lines, shown
from mudline.model.results.forms.text import Spelling

JSON = Spelling(json.dumps, "null")
CSV = Spelling(lambda name: name, "")
FLOATS = st.floats(allow_infinity=False)


@given(st.lists(FLOATS))
def test_numbers_come_back_to_the_last_bit(values: list[float]) -> None:
    column = np.array(values)
    for spelling in (JSON, CSV):
        spelled = spelling.column(column)
        back = np.array([math.nan if text == spelling.nothing else float(text) for text in spelled])
        assert np.array_equal(back, column, equal_nan=True)
        assert np.array_equal(np.signbit(back[~np.isnan(back)]), np.signbit(column[~np.isnan(column)]))
    assert json.loads(f"[{','.join(JSON.column(column))}]") == [None if math.isnan(v) else v for v in values]


def test_what_overflowed_is_no_value() -> None:
    column = np.array([1.5, math.inf, -math.inf])
    assert CSV.column(column) == ["1.5", "", ""]
    assert JSON.column(column) == ["1.5", "null", "null"]


@given(st.lists(st.lists(st.text(st.characters(exclude_characters="\r", codec="utf-8")), min_size=2, max_size=4)))
def test_csv_is_read_back(rows: list[list[str]]) -> None:
    assert list(csv.reader("".join(csv_lines(rows)).splitlines(keepends=True))) == rows or any(
        "\n" in text or not text.isprintable() for row in rows for text in row
    )


def test_csv_values() -> None:
    lines = list(csv_lines([("a", 1, 0.1, 1e22, None, True, False, 'b"c'), ()]))
    assert lines == ['a,1,0.1,1e+22,,true,false,"b""c"\n', "\n"]


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (1234567.0, "1.23457e+06"),
        (0.000123456789, "0.000123457"),
        (None, ""),
        (math.nan, ""),
        (math.inf, "inf"),
        (-0.5, "-0.5"),
    ],
)
def test_numbers_for_people(value: float | None, text: str) -> None:
    assert shown(value) == text
