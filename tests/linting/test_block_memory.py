"""A block that was read before, somewhere else: the deck, its problems and the places of its values are the same."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.deck.loading import load_bytes
from mudline.deck.reading import TextOrigin
from mudline.linting.engine import read_deck
from tests.builders.keyword_texts import mutated
from tests.deck.test_bytes import texts


@given(mutated(texts.map(str.encode)), st.integers(0, 3))
@settings(max_examples=30)
def test_a_block_that_stands_elsewhere(data: bytes, lines: int) -> None:
    read_deck(data, "a.keyxm")
    moved = b"C a line more\n" * lines + data
    plain, again = load_bytes(moved, "a.keyxm"), read_deck(moved, "a.keyxm")
    assert again == plain
    assert again.problems == plain.problems
    assert isinstance(plain.origin, TextOrigin)
    assert isinstance(again.origin, TextOrigin)
    assert again.origin.read.keys() == plain.origin.read.keys()
    for place, block in plain.origin.read.items():
        other = again.origin.read[place]
        assert other.places == block.places
        assert (other.problems, other.trailing, other.lost) == (block.problems, block.trailing, block.lost)


def test_a_short_block_is_read_once() -> None:
    deck = b"$MODEL\n*OCEAN\n 512.25, 1025.0, 9.81\n"
    first, second = (read_deck(deck, "a.keyxm").sections[0].blocks[0] for _ in range(2))
    assert first is second
