"""Reading a keyword text never fails, whatever it holds, and long or hostile input is read in time."""

from __future__ import annotations

from collections import Counter
from itertools import cycle

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.basics.limits import MOST_REPORTED
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from tests.helpers.builders.documents import KEYWORDS, Keyword
from tests.helpers.builders.keyword_texts import deck_texts, mutated
from tests.helpers.samples import SAMPLES

BROKEN = (SAMPLES / "broken.keyxm").read_bytes()


def read(data: bytes) -> Deck:
    """The deck of any bytes, having asked for the place of each of its problems and for its other forms."""
    deck = load_bytes(data, "deck.keyxm")
    found = deck.diagnose(deck.problems)
    assert len(found) == len(deck.problems)
    lines = data.count(b"\n") + data.count(b"\r") + 1
    for one in found:
        assert 1 <= one.line <= one.end_line <= lines
        assert one.column >= 1
        assert (one.line, one.column) <= (one.end_line, one.end_column)
        assert one.message
        assert not set(one.message) & {"\n", "\r"}
    return deck


_words = st.sampled_from(
    [
        *(f"*{keyword}\n" for _, keyword in KEYWORDS),
        *("$MODEL\n", "$PREPROCESSOR\n", "$ANALYSIS\n", "$\n", "*\n", "\n", "\r", "\r\n", " ", ",", "=", "==["),
        *("=[x]", "]"),
        *("C", "C x\n", "CURVE=a", "SET=ALL", "SET=", "OPTION=RIGID\n", "TYPE=ELASTIC", "GEN=1,2\n", "GEN="),
        "SUBSET=a\n",
        *("STIFFNESS=", "FRICTION=", "SUCTION=,", "BUOYANCY=x", "COMPRESSION CHECK=", "UNITS=", "METRIC", "1"),
        *("0.5", "-", "1e9"),
        *("1,2,3\n", " 1 2\n", "0,0\n", "{", "{l}", "}", '"', "/", "/a:1/", "nan", "1e400", "a", "\u00e9"),
        *("\x00", "\u2028", "[", ":"),
    ]
)


@given(st.sampled_from(KEYWORDS), st.lists(_words.filter(lambda word: word[0] not in "$*"), max_size=25).map("".join))
def test_fragments_in_every_keyword(named: Keyword, text: str) -> None:
    section, keyword = named
    deck = read(f"${section}\n*{keyword}\n{text}\n*{keyword}\n".encode())
    assert len(deck.sections) == 1
    assert [block.keyword for block in deck.sections[0].blocks] == [keyword, keyword]


@given(st.binary(max_size=200))
def test_random_bytes(data: bytes) -> None:
    read(data)


@given(mutated(st.just(BROKEN) | deck_texts().map(str.encode)))
def test_mutated_decks(data: bytes) -> None:
    read(data)


LINES = [
    *("1", "1,", ", ", "a", "a,", "=", "a=", "SET=a,", "C", "$", "*", "{x},", "=[1],", " ", "\t", "-", "1 ", "1e"),
    *("9", "a b ", "[", "=[a]", "/", "/,", "//,", '"",', "\u00e9", "1,\u00e9,", "\r", "\n", " \n", "\r\n", "1\n"),
    *("C\n", "x\n", "SET=a\n", "$a\n", "*a\n", "*NODE\n", "$MODEL\n*OCEAN\n", "Ca\n", " 1,2,x\n", "SET=a\n1,2\n"),
    *(" 0,0\n,\n", "=[\n", "{a\n", "1,=[x],2\n"),
]


@pytest.mark.untraced
@pytest.mark.parametrize(("piece", "keyword"), list(zip(LINES, cycle(["NODE", "ELEMENT SETS", "NODE"]), strict=False)))
def test_long_input(piece: str, keyword: str) -> None:
    size = 4_000 if piece.endswith(("\n", "\r")) else 24_000  # longer than a short text
    text = f"$MODEL\n*{keyword}\n SET=a\n " + piece * (size // len(piece)) + "\n$MODEL\n*OCEAN\n 1O\n"
    deck = load_bytes(text.encode(), "deck.keyxm")
    assert any(one.code == "SYN002" and "1O" in one.message for one in deck.diagnose(deck.problems))


@pytest.mark.untraced
@pytest.mark.parametrize(
    ("code", "text"),
    [
        ("SYN007", "*OCEAN\n"),
        ("SYN008", "*TIME\n"),
        ("SYN009", "*NOBODY KNOWS\n"),
        ("SYN010", "$NOBODY KNOWS\n"),
        ("SYN011", "$MODEL\nstray\n"),
    ],
)
def test_the_first_are_told_and_then_that_there_are_more(code: str, text: str) -> None:
    head = "$MODEL\n" if code in ("SYN008", "SYN009") else ""
    deck = load_bytes((head + text * (MOST_REPORTED + 500)).encode(), "deck.keyxm")
    told = [problem for problem in deck.problems if problem.code.code == code]
    assert len(told) == MOST_REPORTED + 1
    assert told[-1].message.startswith("and more")
    assert Counter(problem.code.code for problem in deck.problems)[code] == len(told)
