"""Whatever is formatted: the deck stays the same, twice is once, and nothing but layout is touched."""

from __future__ import annotations

import re
from collections import Counter
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.editing.formatting.document import FormatError, formatted
from mudline.editing.formatting.rows import Columns, NumberRows, RowKind, WordRows, word_rows
from mudline.language.codes.lines import SYN014
from mudline.language.deck.keyword_text import same_meaning
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.model import Opaque
from mudline.language.diagnostics import DeckError, Severity
from mudline.language.keywords.library.mesh import ElementRow, NodeRow
from mudline.language.keywords.model import Row, record_schema
from mudline.language.syntax.source import Source
from tests.helpers.builders.keyword_texts import deck_texts, mutated
from tests.helpers.builders.spellings import numbers
from tests.helpers.growth import FOURFOLD, TWOFOLD, call_growth, calls, growth
from tests.helpers.samples import FAULTY, SAMPLES

pytestmark = pytest.mark.slow

FILES = sorted(path for path in SAMPLES.iterdir() if path.is_file())
DECKS = [path for path in FILES if path.suffix.startswith(".key") and path.name not in FAULTY]
BOM = b"\xef\xbb\xbf"
FORMS = list(product([b"\n", b"\r\n", b"\r"], [b"", BOM]))
"""Line ends, and with or without a mark: each sample is tried in one of these forms, and the longest in all."""
LAID_OUT = [
    pytest.param(path, *form, id=f"{path.name}-{form[0]!r}{'-BOM' * bool(form[1])}")
    for number, path in enumerate(FILES)
    for form in (FORMS if path == max(DECKS, key=lambda one: one.stat().st_size) else [FORMS[number % len(FORMS)]])
]


def check(data: bytes, name: str = "deck.keyxm") -> bytes:
    """Format, and hold what came out against what went in."""
    before = load_bytes(data, name)
    if any(problem.weight is Severity.ERROR for problem in before.problems):
        with pytest.raises(DeckError):
            formatted(data, name)
        return data
    if any(problem.code is SYN014 for problem in before.problems):
        with pytest.raises(FormatError, match="cut off"):
            formatted(data, name)
        return data
    new = formatted(data, name)
    after = load_bytes(new, name)
    assert same_meaning(before, after)
    assert Counter(problem.code for problem in after.problems) == Counter(problem.code for problem in before.problems)
    assert formatted(new, name) == new
    opaque = [block for section in before.sections for block in section.blocks if isinstance(block, Opaque)]
    assert opaque == [block for section in after.sections for block in section.blocks if isinstance(block, Opaque)]
    ends = (new.count(b"\r\n"), new.count(b"\n") - new.count(b"\r\n"), new.count(b"\r") - new.count(b"\r\n"))
    assert sum(count > 0 for count in ends) <= 1
    lines = new.removeprefix(BOM).rstrip(b"\x1a")  # an end-of-file mark stays where it is
    assert not lines or lines.endswith((b"\n", b"\r"))
    assert new.startswith(BOM) == data.startswith(BOM)
    assert ink(new) == ink(data)
    return new


def ink(data: bytes) -> str:
    """A text without what layout is made of: blanks, line ends, commas, upper and lower case."""
    return re.sub(r"[\s,]", "", Source.from_bytes(data, "deck.keyxm").text).upper()


@pytest.mark.untraced
@pytest.mark.parametrize(("path", "end", "mark"), LAID_OUT)
def test_samples(path: Path, end: bytes, mark: bytes) -> None:
    data = path.read_bytes()
    expected = check(data)
    assert check(mark + data.replace(b"\n", end)) == mark + expected.replace(b"\n", end)
    check(mark + data.replace(b"\n", end).rstrip())


@pytest.mark.untraced
def test_a_long_table_takes_little_time() -> None:
    def table(count: int) -> bytes:
        rows = "".join(f"{node},{node * 0.37:.3f} ,\t{node / 7}\n" for node in range(1, count + 1))
        return f"$MODEL\n*NODE\n{rows}".encode()

    def laid_out(data: bytes) -> bytes:
        return formatted(data, "deck.keyxm")

    long = table(100_000)
    assert call_growth(laid_out, table(5_000), table(10_000)) < TWOFOLD
    assert calls(lambda: laid_out(long)) < 100_000 / 6  # many rows with each call
    assert growth(laid_out, table(10_000), table(40_000)) < FOURFOLD
    assert {line.index(b".") for line in check(long).splitlines()[2:]} == {14}


@pytest.mark.parametrize("form", ["json", "yaml"])
@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.name)
def test_what_conversion_writes_is_canonical(path: Path, form: str) -> None:
    deck = load_bytes(path.read_bytes(), path.name)
    data = dump(deck, form).encode()
    assert formatted(data, f"deck.{form}") == data


_sample_bytes = st.sampled_from([path.read_bytes()[:6000] for path in FILES if path.suffix.startswith(".key")])


@given(mutated(st.one_of(deck_texts().map(str.encode), _sample_bytes)))
def test_mutated_decks(data: bytes) -> None:
    check(data.replace(b"\x00", b"\x01"))  # with a NUL, few bytes and a line end more may look like UTF-16


@pytest.mark.parametrize(
    "data",
    [
        b"\x1a",
        b"\x1a+EMBEDMENT\n",
        b"x\n\x1a",
        b"$MODEL\n*X\n \x1a a",
        b"\nCabc\x1a",
        b"\vCabc\x1a",
        b"$MODEL\x1a\x1a \n \x1a",
        b" raw\x1a\n  \n",
        b"$MODEL\n*NEW\n raw\n\n\x1a",
    ],
)
def test_an_end_of_file_mark(data: bytes) -> None:
    assert b"\x1a" in check(data)


@given(st.text(st.sampled_from('$*C c=1-,.\t\r\nx[]{}"/\x85\u2028\u0660\x0b\x0c\xdf'), max_size=60))
def test_random_lines(text: str) -> None:
    check(text.encode())
    check(b"$MODEL\n*SEABED STIFFNESS\nCURVE=x\n" + text.encode())
    check(b"$PREPROCESSOR\n*PARAMETERS\n" + text.encode())


def kind(row: type[Row]) -> RowKind:
    columns = record_schema(row).columns
    return RowKind(columns[0], tuple(columns), table=True)


def laid_out(rows: WordRows | NumberRows, row: type[Row], *others: WordRows | NumberRows) -> str:
    columns = Columns(kind(row))
    for part in (rows, *others):
        part.measure(columns)
    return rows.lines([column.shape() for column in columns.columns])


_fields = st.one_of(numbers, numbers, st.just(""), st.just("1" * 40), st.sampled_from(["0", "1.5", "-2E+3", "+.5d0"]))
_pads = st.sampled_from(["", " ", "\t", "  "])
_row = st.lists(st.tuples(_pads, _fields, _pads).map("".join), min_size=1, max_size=5).map(",".join)
_ends = st.sampled_from(["\n", "\n", "\r\n", ",\n", " , ,\n"])
_lines = st.lists(
    st.tuples(_row.filter(lambda row: bool(row.strip(" \t"))), _ends).map("".join), min_size=1, max_size=8
)


@given(_lines.map("".join), st.booleans())
def test_both_ways_give_the_same(text: str, cut: bool) -> None:
    text = text.rstrip("\r\n") if cut else text
    plain = NumberRows.read(text, 4)
    words = word_rows(text, 4)
    if plain is not None:
        assert laid_out(plain, NodeRow) == laid_out(words, NodeRow)
        other = word_rows("1234567.5, {label}, =[a, b]\n", 4)
        assert laid_out(plain, ElementRow, other) == laid_out(words, ElementRow, other)
