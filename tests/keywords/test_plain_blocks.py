"""Long blocks of plain records against the reader of blocks: the same values, places and findings."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.deck.reading import TextOrigin, read_source
from mudline.diagnostics import Span
from mudline.keywords import catalogue, grammar, plain
from mudline.keywords.grammar import Content
from mudline.keywords.reader import ReadBlock
from mudline.syntax.source import Source

PLAIN_SETS = [" SET=S1\n SUBSET=S 2\n", " set = a\n 1, 2 ,3\n 4\n", " SET=B\n GEN=1, 20, 3\n GEN=-4,5\n", " SET=é.1\n"]
PLAIN_SETS += [" SET=A\r\n\tSUBSET=S1\r\n", " SET=A\n\n 1\n", " SET=1\n SUBSET=A\n 007, +3\n"]
ODD_SETS = [" SET=A, B\n", ' SET="A"\n', " SET=A\nC a comment\n 1\n", " SET=A\n {label}\n", " SET=A\n 1.5\n", " SET=\n"]
ODD_SETS += [" SET=A SUBSET=B\n", " SET=A\n GEN=1\n", " SET=A\n 1 2 3\n", " SET=A\n 1,\n", " SET=A/B\n"]
ODD_SETS += [" SET=A\n GEN=1, =[n]\n", " SET=A\n SUB=B\n", " SET=A\n 1, label\n", " SET=A\n 9007199254740993\n"]
ODD_SETS += [" SET=A\nCSET=B\n", " SET=A\n SUBSET=B=C\n", " SET=A\n" + " 1\n" * 70, " SET=A\xa0\n", " SET=A\n 1.0, 2\n"]
PLAIN_PARAMETERS = [" p1, =[p0 + 1]\n", " vessel x, 1.5\n", " a, -2.5D3\n", " b,word\n", "\tc , =[max(1, 2) / 3]\r\n"]
PLAIN_PARAMETERS += [" 12, 5\n", " d, two words\n", " e, =[f = 2]\n", " f, 1E5\n"]
ODD_PARAMETERS = [" a\n", " a, 1, 2\n", ' a, "text"\n', " a, /x:1 2/\n", " a, =[b[1]]\n", " a, =[b\n", " a, nan\n"]
ODD_PARAMETERS += [
    " a, 1 000.0\n",
    " a,\n",
    " , 1\n",
    " a, =[b] + 1\n",
    "C note\n",
    " a, 1e999\n",
    " a, =b\n",
    ' a, =["t"]\n',
]
BLOCKS = {
    "MODEL\n*ELEMENT SETS": (PLAIN_SETS, ODD_SETS),
    "PREPROCESSOR\n*PARAMETERS": (PLAIN_PARAMETERS, ODD_PARAMETERS),
}


def read(text: str) -> tuple[object, object, ReadBlock]:
    """The sections and problems of a text, and its only block."""
    deck = read_source(Source.from_bytes(text.encode(), "deck.keyxm"))
    assert isinstance(deck.origin, TextOrigin)
    [block] = deck.origin.read.values()
    return deck.sections, deck.problems, block


@pytest.fixture
def attempts(monkeypatch: pytest.MonkeyPatch) -> Callable[[int], None]:
    """Sets from how many lines on a block is tried as a plain one."""
    return lambda fewest: monkeypatch.setattr(plain, "FEWEST", fewest)


def compare(text: str, attempts: Callable[[int], None]) -> bool:
    """Read a text both ways; returns whether it was read as a plain block."""
    attempts(10**9)
    sections, problems, block = read(text)
    attempts(1)
    found_sections, found_problems, found = read(text)
    late = callable(found.found)
    assert (found_sections, found_problems) == (sections, problems)
    assert repr(found_sections) == repr(sections)
    assert found.model.model_dump() == block.model.model_dump()
    assert (found.lost, found.trailing) == (block.lost, block.trailing)
    assert not late or not found.damaged(())
    assert (found.places.spans, found.places.runs, found.places.damaged) == (
        block.places.spans,
        block.places.runs,
        block.places.damaged,
    )
    return late


def test_a_block_that_begins_inside_a_record_is_left_to_the_reader(attempts: Callable[[int], None]) -> None:
    assert not compare(f"$MODEL\n*ELEMENT SETS\n SUBSET=A\n{PLAIN_SETS[0]}", attempts)


@pytest.mark.parametrize(("head", "entry"), [(head, entry) for head, (plain, _) in BLOCKS.items() for entry in plain])
def test_plain_records_are_read_as_such(head: str, entry: str, attempts: Callable[[int], None]) -> None:
    assert compare(f"${head}\n{entry}{entry.replace('A', 'Z')}", attempts)


@pytest.mark.parametrize(("head", "entry"), [(head, entry) for head, (_, odd) in BLOCKS.items() for entry in odd])
def test_a_block_with_an_odd_record_is_left_to_the_reader(
    head: str, entry: str, attempts: Callable[[int], None]
) -> None:
    plain = BLOCKS[head][0][0]
    for text in (f"{plain}{entry}", f"{entry}{plain}", f"{plain}{entry}{plain}"):
        assert not compare(f"${head}\n{text}", attempts)


@pytest.mark.parametrize("head", BLOCKS)
def test_the_end_of_the_file_is_left_to_the_reader(head: str, attempts: Callable[[int], None]) -> None:
    text = f"${head}\n{BLOCKS[head][0][0]}"
    assert not compare(text[:-1], attempts)
    assert compare(f"{text}$MODEL\n", attempts)


@settings(max_examples=60)
@given(st.data())
def test_blocks_of_any_records(data: st.DataObject) -> None:
    head = data.draw(st.sampled_from(list(BLOCKS)))
    good, odd = BLOCKS[head]
    entries = data.draw(st.lists(st.sampled_from(good * 4 + odd), max_size=6))
    text = f"${head}\n{''.join(entries)}"
    cut = data.draw(st.integers(len(head) + 2, len(text)))
    with pytest.MonkeyPatch.context() as patch:
        compare(text[:cut] if data.draw(st.booleans()) else text, lambda n: patch.setattr(plain, "FEWEST", n))


RULES = [block.rule for block in map(catalogue.load, catalogue.modules()) if grammar.records_of(block.rule)]


@settings(max_examples=200)
@given(st.data())
def test_cutting_into_records_gives_the_tree_of_the_whole(data: st.DataObject) -> None:
    rule = data.draw(st.sampled_from(RULES))
    terminals = data.draw(st.lists(st.sampled_from(sorted(grammar.terminals_below(rule))), min_size=1, max_size=10))
    contents = [Content(terminal, Span(at, at + 1), at) for at, terminal in enumerate(terminals)]
    tree, mismatches = grammar.by_lines(rule, contents)
    assert grammar.by_records(rule, contents) == (None if mismatches else (tree, []))
