"""Generated decks as bytes: the tree gives back what was read, and line ends and marks do not change the models."""

from __future__ import annotations

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mudline.deck.loading import dump, load_bytes
from tests.builders.documents import document
from tests.builders.keyword_texts import mutated
from tests.deck.test_round_trips import of
from tests.syntax.test_lossless import BOM, read_back

texts = document().map(lambda made: dump(of(made), "keyword"))
ends = st.sampled_from([["\n"], ["\r\n"], ["\r"], ["\n", "\r\n"], ["\r", "\r\n"]])


def with_ends(text: str, chosen: list[str]) -> str:
    """A text with other line ends, in turn."""
    lines = text.split("\n")
    return "".join(line + chosen[index % len(chosen)] for index, line in enumerate(lines[:-1])) + lines[-1]


@given(texts, ends, st.sampled_from(["utf-8", "utf-8-sig", "cp1252", "latin-1"]), st.booleans())
@settings(max_examples=60)
def test_the_tree_is_the_bytes(text: str, chosen: list[str], encoding: str, cut: bool) -> None:
    data = with_ends(text, chosen).encode(encoding, errors="replace")
    source = read_back(data[:-1] if cut and text else data)
    assert source.bom == (encoding == "utf-8-sig")


@given(texts, ends, st.booleans())
@settings(max_examples=40)
def test_line_ends_and_marks_change_no_model(text: str, chosen: list[str], marked: bool) -> None:
    deck = load_bytes(text.encode(), "a.keyxm")
    assume(not text.startswith("\ufeff"))
    again = load_bytes((BOM if marked else b"") + with_ends(text, chosen).encode(), "a.keyxm")
    assert again.sections == deck.sections
    assert (again.preamble, again.comments) == (deck.preamble, deck.comments)
    assert dump(again, "json") == dump(deck, "json")


@given(mutated(texts.map(str.encode)))
@settings(max_examples=60)
def test_mutated_bytes(data: bytes) -> None:
    read_back(data)
