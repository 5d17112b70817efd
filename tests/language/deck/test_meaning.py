"""Two decks mean the same only if all that is read, and all that is kept, is equal."""

from __future__ import annotations

import pytest

from mudline.language.deck.keyword_text import same_meaning
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck

DECK = """\
C title
$PREPROCESSOR
*PARAMETERS
 od, 0.25
$MODEL
 stray
*OCEAN
C sea
 100.0, 1025.0
*NODE
 1, 0.0, 0.0
 2, 0.0, =[od]
*ELEMENT SETS
 SET=Pipe
 1, 2
C of the section
*TITLE
 kept  as it is
C last
"""


def deck(text: str) -> Deck:
    return load_bytes(text.encode(), "deck.keyxm")


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("", ""),
        ("C title", "\n\nC title  \n\n"),
        (" 100.0, 1025.0", "\n100   1025\n"),
        ("C sea", "C sea \t"),
        ("C of the section", "C of the section\t"),
        ("$MODEL", " $ model"),
        ("SET=Pipe", "set = Pipe"),
        (" 2, 0.0, =[od]", " 2, 0.0, =[od],"),
        (" 1, 0.0, 0.0", " 1, 0.0, 0.0, , ,"),
        (" 100.0, 1025.0", " 100.0, 1025.0, ,"),
    ],
)
def test_layout_does_not_count(old: str, new: str) -> None:
    assert same_meaning(deck(DECK), deck(DECK.replace(old, new, 1) if old else DECK))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("C title", "C  title"),
        ("C title", "C title\nC another"),
        ("$MODEL", "$LOAD CASE"),
        (" stray", " stray "),
        (" 100.0, 1025.0", " 100.0, 1025.0, 9.81"),
        (" 100.0, 1025.0", " 100.0"),
        (" 100.0, 1025.0", " =[100.0], 1025.0"),
        ("C sea\n", ""),
        ("C sea", "C the sea"),
        ("C sea\n 100.0, 1025.0", " 100.0, 1025.0\nC sea"),
        (" 2, 0.0, =[od]", " 2, 0.0, =[OD]"),
        (" 2, 0.0", " 2, -0.0"),
        (" 1, 2\nC of", " 1, 3\nC of"),
        (" 1, 2\nC of", " GEN=1, 2\nC of"),
        ("SET=Pipe", "SET=pipe"),
        ("*OCEAN\nC sea\n 100.0, 1025.0\n", ""),
        (" kept  as it is", " kept as it is"),
        (" kept  as it is", " kept  as it is\n\n"),
    ],
)
def test_what_counts(old: str, new: str) -> None:
    assert DECK.count(old) == 1
    assert not same_meaning(deck(DECK), deck(DECK.replace(old, new)))
