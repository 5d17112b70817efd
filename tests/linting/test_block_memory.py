"""A block that was read before, somewhere else: the deck, its problems and the places of its values are the same."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.deck.loading import load_bytes
from mudline.deck.reading import TextOrigin
from mudline.linting.engine import LONGEST_BLOCK, MOST_BLOCKS, BlockCache
from tests.builders.keyword_texts import mutated
from tests.deck.test_bytes import texts

COMMENT = "C a line more\n"


def same(data: bytes, memory: BlockCache) -> None:
    """Both ways of reading give one deck."""
    plain, again = load_bytes(data, "a.keyxm"), load_bytes(data, "a.keyxm", read=memory.read)
    assert again == plain
    assert again.problems == plain.problems
    assert isinstance(plain.origin, TextOrigin)
    assert isinstance(again.origin, TextOrigin)
    assert again.origin.read.keys() == plain.origin.read.keys()
    for place, block in plain.origin.read.items():
        other = again.origin.read[place]
        assert other.places == block.places
        assert (other.problems, other.trailing, other.lost) == (block.problems, block.trailing, block.lost)


@given(mutated(texts.map(str.encode)), st.integers(0, 3))
@settings(max_examples=60)
def test_a_block_that_stands_elsewhere(data: bytes, lines: int) -> None:
    memory = BlockCache()
    for _ in range(3):
        same(data, memory)
    same(COMMENT.encode() * lines + data, memory)


def test_places_are_those_of_the_text_that_was_asked() -> None:
    memory = BlockCache()
    deck = "$MODEL\n*OCEAN\n 500.0, ten, 9.81\n"
    for start in ("", COMMENT, COMMENT * 5):
        data = (start + deck).encode()
        (problem,) = load_bytes(data, "a.keyxm", read=memory.read).problems
        assert problem.span is not None
        assert (start + deck)[slice(*problem.span)] == "ten"


def test_long_blocks_are_read_each_time() -> None:
    memory = BlockCache()
    rows = "".join(f" {number}, 0.0, 0.0\n" for number in range(1, LONGEST_BLOCK // 10))
    first, second = (load_bytes(f"$MODEL\n*NODE\n{rows}".encode(), "a", read=memory.read) for _ in range(2))
    assert first == second
    assert first.sections[0].blocks[0] is not second.sections[0].blocks[0]


def test_what_was_not_read_for_long_is_forgotten() -> None:
    memory = BlockCache()
    ocean = [f"$MODEL\n*OCEAN\n {depth}.0, 1025.0, 9.81\n".encode() for depth in range(1, MOST_BLOCKS + 2)]
    once, first, again = (load_bytes(ocean[0], "a", read=memory.read).sections[0].blocks[0] for _ in range(3))
    assert again is first
    assert first is not once  # what comes once is not remembered
    for data in ocean[1:]:
        load_bytes(data, "a", read=memory.read)
    assert load_bytes(ocean[0], "a", read=memory.read).sections[0].blocks[0] is not first
