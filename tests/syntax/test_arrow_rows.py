"""Rows that pyarrow reads are those of the slow reader to the last bit; what it reads otherwise is left to ours."""

from __future__ import annotations

import struct
import subprocess
import sys
from collections.abc import Iterator
from itertools import cycle
from types import ModuleType
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import mudline
from mudline.diagnostics import DeckError, Span
from mudline.syntax import number_rows
from mudline.syntax.rows import read_number, read_rows, read_rows_slow
from tests.syntax.test_rows import STRANGE

pytest.importorskip("pyarrow.csv", reason="pyarrow is not installed")

SPELLINGS = [
    *STRANGE,
    *("1D3", "1d-3", "1.5D+03", ".5", "5.", "-.5", "+1", "+.5", "1.e5", "-0.0", "0e999", "007", "1e05", "1E+05"),
    *("'1'", "\\1", "#1", "x", "1\t", "\t1", " 1 ", "1;2", "1,", "0" * 500, "1" * 390 + ".5"),
    *("0." + "3" * 398, "0." + "3" * 399, "1e" + "0" * 399 + "1", "1" * 200 + "." + "1" * 200),
]


def bits(value: int) -> str:
    """The shortest spelling of a finite double of any bits."""
    number = struct.unpack("<d", struct.pack("<Q", value))[0]
    return repr(number) if np.isfinite(number) else "0"


PLAIN = st.one_of(
    st.integers(0, 2**64 - 1).map(bits),
    st.integers(-(10**20), 10**20).map(str),
    st.builds("{}{}{}{}".format, st.sampled_from(["", "-"]), st.integers(0, 10**25), st.sampled_from(["", ".", ".50"]),
              st.one_of(st.just(""), st.integers(-330, 310).map("e{}".format), st.integers(0, 310).map("E+{}".format))),
)  # fmt: skip


@pytest.fixture(autouse=True)
def always(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Pyarrow is tried with any text that is not read by itself."""
    monkeypatch.setattr(number_rows, "_PAYS", 0)
    with patch("mudline.syntax.rows._SHORT", 0):
        yield


def arrow() -> ModuleType:
    found = number_rows.arrow_csv(10**9)
    assert found is not None
    return found


def holds_the_slow_rows(text: str, columns: int) -> None:
    span = Span(0, len(text))
    slow = read_rows_slow(text, span, columns)
    for piece in (1, 40, number_rows.ARROW_PIECE):
        with patch.object(number_rows, "ARROW_PIECE", piece), patch("mudline.syntax.rows.PIECE", max(piece // 2, 1)):
            assert read_rows(text, span, columns).same(slow)
    values = number_rows.read_with_arrow(arrow(), text, columns)
    if values is not None:
        assert not slow.words
        assert (slow.lengths == values.shape[1]).all()
        assert values.tobytes() == slow.values.tobytes()


@pytest.mark.untraced
@pytest.mark.parametrize(
    ("spelling", "end"), list(zip(SPELLINGS, cycle(["\n", "\r\n", "\n"]), strict=False)), ids=ascii
)
def test_every_spelling(spelling: str, end: str) -> None:
    for rows in (["1, 2", f"3, {spelling}", "5, 6"], [f"{spelling}, 1", "2, 3"], ["1,2", f"3,{spelling}"]):
        for text in (end.join(rows), end.join([*rows, ""])):
            holds_the_slow_rows(text, 2)
            holds_the_slow_rows(text, 3)


@given(
    st.lists(st.lists(st.one_of(PLAIN, st.sampled_from(SPELLINGS)), min_size=1, max_size=4), min_size=1, max_size=8),
    st.sampled_from([", ", ",", " ", "\t,", " ,\t"]),
    st.sampled_from(["\n", "\r\n", " \n", "\n\n", "\n \n", "\n\t\r\n"]),
    st.integers(1, 4),
)
def test_rows_of_any_fields(rows: list[list[str]], comma: str, end: str, columns: int) -> None:
    holds_the_slow_rows(end.join(comma.join(row) for row in rows), columns)


@given(st.lists(st.tuples(PLAIN, PLAIN, PLAIN), min_size=2, max_size=30), st.sampled_from(["\n", "\r\n"]))
def test_plain_numbers_are_read_by_pyarrow(rows: list[tuple[str, str, str]], end: str) -> None:
    text = end.join(", ".join(row) for row in rows)
    expected = [[read_number(field) for field in row] for row in rows]
    if all(None not in row for row in expected):
        values = number_rows.read_with_arrow(arrow(), text, 3)
        assert values is not None
        assert values.tobytes() == np.array(expected, np.float64).tobytes()


@given(st.text(st.sampled_from("1.5e+-, \t\n\r\0\x0b\ufeff\"'"), max_size=60))
@example("1,2\r3,4\n")
@example("\ufeff1,2\n3,4\n")
@example("1,2\n\n3,4\n")
def test_any_text(text: str) -> None:
    holds_the_slow_rows(text.replace("\r", "\r\n"), 2)


def test_a_return_within_a_line_ends_none() -> None:
    assert number_rows.read_with_arrow(arrow(), "1,2\r3,4\n5,6", 2) is None
    assert number_rows.read_with_arrow(arrow(), "1,2\r\n3,4\r", 2) is not None


@pytest.mark.parametrize(
    "digits", ["1" * 400 + "e-300", "-0." + "1" * 398, "1" * 200 + "." + "1" * 198 + "e+" + "1" * 3]
)
def test_long_numbers_are_refused_wherever_they_stand(digits: str) -> None:
    assert read_number(digits) is None
    for before in range(40):
        assert number_rows.read_with_arrow(arrow(), f"{'1' * (before + 1)},2\n{digits},4\n" + "5,6\n" * 30, 2) is None


def test_a_piece_that_is_refused_leaves_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    lines = [f"{n}.25, {n / 7!r}" for n in range(4000)]
    lines[1500] = "1500.25, 1D3"
    text = "\n".join(lines)
    read: list[bool] = []

    def noted(library: ModuleType, piece: str, columns: int) -> object:
        values = original(library, piece, columns)
        read.append(values is not None)
        return values

    original = number_rows.read_with_arrow
    monkeypatch.setattr(number_rows, "ARROW_PIECE", 10_000)
    monkeypatch.setattr(number_rows, "read_with_arrow", noted)
    assert read_rows(text, Span(0, len(text)), 2).same(read_rows_slow(text, Span(0, len(text)), 2))
    assert read.count(False) == 1
    assert read.count(True) > 5
    read.clear()
    text = text.replace(", ", " ")
    read_rows(text, Span(0, len(text)), 2)
    assert read == [False, False]


def test_faults_and_their_places_are_the_same() -> None:
    rows = [f" {n}.25, {n}.5" for n in range(3000)]
    for at, row in ((7, " 1, nan"), (1200, " 2, 1e400"), (1201, " 3"), (2998, " 4, 5, 6"), (2999, " 5, 2O")):
        rows[at] = row
    text = "\n".join(["$MODEL", "*SEABED STIFFNESS", " CURVE=clay", *rows, ""])
    found = []
    for least in (0, 10**9):
        with patch.object(number_rows, "_PAYS", least), pytest.raises(DeckError) as caught:
            mudline.from_keyword(text)
        found.append([(one.code, one.line, one.column, one.message) for one in caught.value.diagnostics])
    assert found[0] == found[1]
    assert [line for _, line, _, _ in found[0]] == [11, 1204, 1205, 3002, 3003]


def test_a_short_text_does_not_import_pyarrow() -> None:
    code = """
import sys
from mudline.syntax.number_rows import arrow_csv
assert arrow_csv(9_999_999) is None and "pyarrow" not in sys.modules
assert arrow_csv(10_000_000) and arrow_csv(300_000) and not arrow_csv(200_000)
"""
    subprocess.run([sys.executable, "-c", code], check=True)


def test_without_pyarrow() -> None:
    with patch.dict("sys.modules", {"pyarrow": None, "pyarrow.csv": None}):
        assert number_rows.arrow_csv(10**9) is None
        text = "1, 2\n" * 1000
        assert read_rows(text, Span(0, len(text)), 2).values.shape == (1000, 2)
