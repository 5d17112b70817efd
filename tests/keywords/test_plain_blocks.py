"""Long blocks of plain records against the reader of blocks: the same values, places and findings."""

from __future__ import annotations

import re
from itertools import islice, pairwise, product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin, read_source
from mudline.diagnostics import Span
from mudline.keywords import catalogue, grammar, reader
from mudline.keywords.grammar import Content, Node
from mudline.keywords.model import Block
from mudline.keywords.reader import ReadBlock
from mudline.keywords.recovery import by_lines
from mudline.keywords.unknown import is_partly_unknown
from mudline.syntax.source import Source
from tests.builders.keyword_texts import deck_texts, mutated

PLAIN_SETS = [" SET=S1\n SUBSET=S 2\n", " set = a\n 1, 2 ,3\n 4\n", " SET=B\n GEN=1, 20, 3\n GEN=-4,5\n", " SET=é.1\n"]
PLAIN_SETS += [" SET=A\r\n\tSUBSET=S1\r\n", " SET=A\n\n 1\n", " SET=1\n SUBSET=A\n 007, +3\n"]
ODD_SETS = [" SET=A, B\n", ' SET="A"\n', " SET=A\nC a comment\n 1\n", " SET=A\n {label}\n", " SET=A\n 1.5\n", " SET=\n"]
ODD_SETS += [" SET=A SUBSET=B\n", " SET=A\n GEN=1\n", " SET=A\n 1 2 3\n", " SET=A\n 1,\n", " SET=A/B\n"]
PLAIN_SETS += [" SET=A\n GEN=1, =[n]\n", " SET=A\n 9007199254740993\n", " SET=A\n 1.0, 2\n"]
ODD_SETS += [" SET=A\n SUB=B\n", " SET=A\n 1, label\n", " SET=A\n 1.5, 2\n", " SET=A\n GEN=1, 2, 3, 4\n"]
ODD_SETS += [" SET=A\nCSET=B\n", " SET=A\n SUBSET=B=C\n", " SET=A\n" + " 1\n" * 70, " SET=A\xa0\n"]
PLAIN_PARAMETERS = [" p1, =[p0 + 1]\n", " vessel x, 1.5\n", " a, -2.5D3\n", " b,word\n", "\tc , =[max(1, 2) / 3]\r\n"]
PLAIN_PARAMETERS += [" 12, 5\n", " d, two words\n", " e, =[f = 2]\n", " f, 1E5\n"]
ODD_PARAMETERS = [" a\n", " a, 1, 2\n", ' a, "text"\n', " a, /x:1 2/\n", " a, =[b[1]]\n", " a, =[b\n", " a, nan\n"]
ODD_PARAMETERS += [
    " a, 1 000.0\n",
    " a,\n",
    " , 1\n",
    " a, =[b] + 1\n",
    "C note\n b, 1\n",
    " a, 1e999\n",
    " a, =b\n",
    ' a, =["t"]\n',
]
PLAIN_PROPERTIES = [
    " SET=A\n STIFFNESS=1 2\n",
    " SET=A\n STIFFNESS=5.0E4\n",
    " SET=A\n\n STIFFNESS=Soft clay\n LATERAL=2.\n",
    " SET=1\n SUCTION=1, 2\n",
]
PLAIN_PROPERTIES += [
    " SET=A\n FRICTION=.3, 0.5 ,1D-2\n",
    " SET=A\n FRICTION=0.3,0.5,0.1,0.1,1,2\n",
    " SET=A\n LATERAL==[k]\n",
]
ODD_PROPERTIES = [" SET=A\n FRICTION=0,3, 0,5, 0.1\n", " SET=A\n FRICTION=0.3,,0.1\n"]
ODD_PROPERTIES += [" SET=A\n LATERAL=1, 2\n", " SET=A\n SET=B STIFFNESS=3\n", " SET=A\n LATERAL=1\n LATERAL=2\n"]
ODD_PROPERTIES += [
    " SET=A, STIFFNESS=1\n",
    " SET=A\n TYPE=RIGID\n",
    " SET=A\n STIFFNESS=12a,\n",
    " SET=A\n SUCTION=a\n",
]
PLAIN_CURVES = [" CURVE=A\n 0.0, 0.0\n 0.5, 1.0\n", " CURVE=A b\n 0 0\n\t1 1\n", " CURVE=A\n 0,0\n .5, 1\n"]
ODD_CURVES = [
    " CURVE=A\n",
    " CURVE=A\n 0, 0\n =[a], 1\n",
    " CURVE=A\n 0, 0, 0\n",
    " CURVE=A\n 1\n",
    " CURVE=A\n 0, b\n",
]
ODD_CURVES += [" CURVE=A\n 0, 0\nC between\n 1, 1\n", " CURVE=A\n" + " 1.0, 1.0\n" * 500]
PLAIN_SECTIONS = [" OPTION=RIGID\n SET=A\n 2E11, 8E10, 0.5, 0.4, 7850.0\n"]
PLAIN_SECTIONS += [" OPTION=RIGID\n SET=A\n 2E11, 8E10, 0.5, =[d], 7850.0\n SET=B\n 2E11, 8E10, 0.5, .1, 785\n"]
PLAIN_SECTIONS += [" Option = Rigid\n SET=A B\n 2E11,8E10,0.5,0.4,7850.0\n COMPRESSION CHECK=YES\n"]
ODD_SECTIONS = [
    " SET=A\n 2E11, , 0.5, 0.4, 7850.0\n",
    " SET=A\n 1, 2, 3\n",
    " OPTION=TUBE\n SET=A\n 1, 2, 3\n",
    " SET=A\n",
]
ODD_SECTIONS += [
    " OPTION=MOORING\n SET=A\n 2E11, 8E10, 0.5, 0.4, 7850.0, 1\n",
    " SET=A\n 2E11, 8E10, 0,5, 0,4, 7850.0\n",
]
PLAIN_NODES = [" GEN=1, 3\n 1, 0.0, 0.0\n 2, 0.0, 1D1\n", " GEN=1, 3\n", "\n GEN=2, 3\n =[n], 0, 1\n"]
PLAIN_NODES += [" GEN=2,3\n 4 0 0\n 5 0 0 0\n"]
ODD_NODES = [
    " 1, 0, 0\n =[n], 0, 1\n",
    " 1, 0.0\n",
    " 1.5, 0, 0\n",
    "C here\n 1, 0, 0\n",
    " a, 0, 0\n",
    " 1, 0, 0, 0, 0\n",
]
BLOCKS = {
    "MODEL\n*ELEMENT SETS": (PLAIN_SETS, ODD_SETS),
    "PREPROCESSOR\n*PARAMETERS": (PLAIN_PARAMETERS, ODD_PARAMETERS),
    "MODEL\n*SEABED PROPERTIES": (PLAIN_PROPERTIES, ODD_PROPERTIES),
    "MODEL\n*SEABED STIFFNESS": (PLAIN_CURVES, ODD_CURVES),
    "MODEL\n*GEOMETRIC SETS": (PLAIN_SECTIONS, ODD_SECTIONS),
    "MODEL\n*NODE": (PLAIN_NODES, ODD_NODES),
}


def read(data: bytes, *, plain: bool) -> tuple[Deck, list[ReadBlock]]:
    """A deck and its blocks as they were read."""
    with pytest.MonkeyPatch.context() as patch:
        if not plain:
            patch.setattr(reader, "read_plain", lambda *_: None)
        deck = read_source(Source.from_bytes(data, "deck.keyxm"))
    assert isinstance(deck.origin, TextOrigin)
    return deck, list(deck.origin.read.values())


def same(data: bytes) -> list[bool]:
    """Read a deck both ways; returns which of its blocks were read as plain ones."""
    deck, blocks = read(data, plain=False)
    found_deck, found_blocks = read(data, plain=True)
    assert found_deck == deck
    assert found_deck.problems == deck.problems
    assert repr(found_deck.sections) == repr(deck.sections)
    late = [callable(found.found) for found in found_blocks]
    for found, block in zip(found_blocks, blocks, strict=True):
        assert repr(_held(found.model)) == repr(_held(block.model))  # there may be NaN in it
        assert (found.lost, found.trailing) == (block.lost, block.trailing)
        assert not callable(found.found) or not is_partly_unknown(found.model)
        assert (found.places.spans, found.places.runs) == (
            block.places.spans,
            block.places.runs,
        )
    return late


def _held(model: Block) -> object:
    """What a block holds; what could not be read cannot be dumped."""
    return model if is_partly_unknown(model) else model.model_dump(warnings=False)


def compare(text: str) -> bool:
    """Read a text with one block both ways; returns whether it was read as a plain block."""
    [late] = same(text.encode())
    return late


@settings(max_examples=25)
@given(st.one_of(deck_texts().map(str.encode), mutated(deck_texts().map(str.encode))))
def test_blocks_of_any_deck(data: bytes) -> None:
    same(data)


@pytest.mark.parametrize("module", catalogue.modules())
def test_the_example_of_a_keyword(module: str) -> None:
    declared = catalogue.load(module)
    for more in ("", "C behind it\n", "C behind it\n\nC and more\n$MODEL\n"):
        same(f"${declared.sections[0]}\n{declared.example}{more}".encode())


def test_a_block_that_begins_inside_a_record_is_left_to_the_reader() -> None:
    assert not compare(f"$MODEL\n*ELEMENT SETS\n SUBSET=A\n{PLAIN_SETS[0]}")


@pytest.mark.parametrize(("head", "entry"), [(head, entry) for head, (plain, _) in BLOCKS.items() for entry in plain])
def test_plain_records_are_read_as_such(head: str, entry: str) -> None:
    assert compare(f"${head}\n{entry}{entry.replace('=A', '=Z')}")


def test_a_long_block_of_records() -> None:
    assert compare(f"$MODEL\n*ELEMENT SETS\n{''.join(PLAIN_SETS * 20)}")


@pytest.mark.parametrize(("head", "entry"), [(head, entry) for head, (_, odd) in BLOCKS.items() for entry in odd])
def test_a_block_with_an_odd_record_is_left_to_the_reader(head: str, entry: str) -> None:
    plain = BLOCKS[head][0][0]
    for text in (f"{plain}{entry}", f"{entry}{plain}", f"{plain}{entry}{plain}"):
        assert not compare(f"${head}\n{text}")


@pytest.mark.parametrize("head", BLOCKS)
def test_the_end_of_the_file_is_left_to_the_reader(head: str) -> None:
    text = f"${head}\n{BLOCKS[head][0][0]}"
    assert not compare(text[:-1])
    assert compare(f"{text}$MODEL\n")


@settings(max_examples=25)
@given(st.data())
def test_blocks_of_any_records(data: st.DataObject) -> None:
    head = data.draw(st.sampled_from(list(BLOCKS)))
    good, odd = BLOCKS[head]
    entries = data.draw(st.lists(st.sampled_from(good * 4 + odd), max_size=6))
    text = f"${head}\n{''.join(entries)}"
    cut = data.draw(st.integers(len(head) + 2, len(text)))
    compare(text[:cut] if data.draw(st.booleans()) else text)


RULES = sorted({block.rule for block in map(catalogue.load, catalogue.modules())})


def lines_of(data: st.DataObject, rule: str) -> list[Content]:
    """Lines of a block in any order."""
    terminals = data.draw(st.lists(st.sampled_from(sorted(grammar.terminals_below(rule))), max_size=10))
    return [Content(terminal, Span(at, at + 1), at) for at, terminal in enumerate(terminals)]


@settings(max_examples=100)
@given(st.data())
def test_lines_that_fit_have_the_tree_that_lark_makes_of_them(data: st.DataObject) -> None:
    rule = data.draw(st.sampled_from(RULES))
    contents = lines_of(data, rule)
    tree, mismatches = by_lines(rule, contents)
    assert grammar.tree_of(rule, contents) == (None if mismatches else tree)


@pytest.mark.parametrize("rule", RULES)
def test_a_few_lines_fit_where_they_do_for_lark(rule: str) -> None:
    terminals = sorted(set(grammar.terminals_below(rule)))
    few = [line for count in range(4) for line in islice(product(terminals, repeat=count), 300)]
    fits = 0
    for sequence in few:
        contents = [Content(terminal, Span(at, at + 1), at) for at, terminal in enumerate(sequence)]
        tree, mismatches = by_lines(rule, contents)
        assert grammar.tree_of(rule, contents) == (None if mismatches else tree)
        fits += not mismatches
    assert fits


@settings(max_examples=100)
@given(st.data())
def test_cutting_into_records_gives_the_tree_of_the_whole(data: st.DataObject) -> None:
    rule = data.draw(st.sampled_from([rule for rule in RULES if grammar.records_of(rule)]))
    contents = lines_of(data, rule)
    records = grammar.records_of(rule)
    assert records
    starts = [at for at, content in enumerate(contents) if content.terminal == records.opening]
    if starts[:1] != [0]:
        assert not contents or grammar.tree_of(rule, contents) is None
        return
    pieces = [contents[start:stop] for start, stop in pairwise([*starts, len(contents)])]
    trees = [grammar.tree_of(records.rule, piece) for piece in pieces]
    assert grammar.tree_of(rule, contents) == (None if None in trees else Node(rule, [tree for tree in trees if tree]))


def test_what_a_rule_may_not_have(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(grammar._rules(), "anchor", 'anchor: K_SET "," ROW\n')
    with pytest.raises(ValueError, match=re.escape("the rule anchor may have names, brackets, |, *, + and ? only")):
        grammar.fitting("anchor", ("K_SET",))
