"""Generated decks through JSON, YAML and keyword text and back: equal models, every number to the last bit."""

from __future__ import annotations

import json

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.model import Deck
from tests.helpers.builders.documents import KEYWORDS, Keyword, Values, alone, block, declared, document
from tests.helpers.builders.keyword_texts import canonical_texts
from tests.helpers.schema import validator
from tests.language.syntax.test_lossless import BOM


def read(text: str, form: str) -> Deck:
    return load_bytes(text.encode(), "a", form=form)


def of(made: Values) -> Deck:
    """The deck of a document."""
    return read(json.dumps(made), "json")


def plain(value: object) -> object:
    """Values without comments, and without what is empty: the spelling of a number tells its last bit."""
    if isinstance(value, dict):
        inner = {key: plain(item) for key, item in value.items() if key != "comments"}
        return {key: item for key, item in inner.items() if item not in (None, [], {})}
    if isinstance(value, list):
        cells = [plain(item) for item in value]
        while cells and cells[-1] is None:
            cells.pop()
        return cells
    return None if value is None else repr(value)


def values(deck: Deck) -> object:
    """All values of a deck."""
    return plain(json.loads(dump(deck, "json"))["sections"])


def held_in_documents(deck: Deck) -> None:
    """JSON and YAML give the deck and each other's text back, and hold to the schema."""
    as_json, as_yaml = dump(deck, "json"), dump(deck, "yaml")
    from_json, from_yaml = read(as_json, "json"), read(as_yaml, "yaml")
    validator().validate(json.loads(as_json))
    assert from_json == from_yaml == deck
    assert dump(from_json, "json") == dump(from_yaml, "json") == as_json
    assert dump(from_json, "yaml") == dump(from_yaml, "yaml") == as_yaml


def held_in_text(deck: Deck) -> None:
    """Keyword text gives the same values back, and what is read from it stays the same in every form."""
    text = dump(deck, "keyword")
    again = read(text, "keyword")
    again.source, again.units = deck.source, deck.units
    assert values(again) == values(deck)
    assert again.preamble == deck.preamble
    assert dump(again, "keyword") == text
    held_in_documents(again)


@pytest.mark.untraced
@pytest.mark.parametrize("keyword", KEYWORDS, ids=lambda keyword: f"{keyword[0]}-{keyword[1]}".replace(" ", "-"))
@given(data=st.data())
@settings(max_examples=3)
def test_every_keyword(keyword: Keyword, data: st.DataObject) -> None:
    deck = of(alone(keyword, data.draw(block(keyword))))
    (found,) = deck.sections[0].blocks
    assert type(found) is declared(keyword)
    held_in_documents(deck)
    held_in_text(deck)
    lines = dump(deck, "keyword").split("\n")[:-1]
    remarked = "".join(f"C before {index}\n{line}\n" for index, line in enumerate(lines)) + "C end\n"
    assert dump(read(remarked, "keyword"), "keyword") == remarked


@given(document())
def test_whole_decks(made: Values) -> None:
    deck = of(made)
    held_in_documents(deck)
    held_in_text(deck)


texts = canonical_texts
ends = st.sampled_from([["\n"], ["\r\n"], ["\r"], ["\n", "\r\n"], ["\r", "\r\n"]])


def with_ends(text: str, chosen: list[str]) -> str:
    """A text with other line ends, in turn."""
    lines = text.split("\n")
    return "".join(line + chosen[index % len(chosen)] for index, line in enumerate(lines[:-1])) + lines[-1]


@given(texts, ends, st.booleans())
def test_line_ends_and_marks_change_no_model(text: str, chosen: list[str], marked: bool) -> None:
    deck = load_bytes(text.encode(), "a.keyxm")
    assume(not text.startswith("\ufeff"))
    again = load_bytes((BOM if marked else b"") + with_ends(text, chosen).encode(), "a.keyxm")
    assert again.sections == deck.sections
    assert (again.preamble, again.comments) == (deck.preamble, deck.comments)
    assert dump(again, "json") == dump(deck, "json")
