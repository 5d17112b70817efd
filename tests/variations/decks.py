"""Decks that describe others, and their plans."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.deck.loading import load_bytes
from mudline.deck.model import Deck
from mudline.diagnostics import DeckError, Diagnostic
from mudline.variations.files import ExpansionPlan
from mudline.variations.planning import plan

MODEL = """\
$MODEL
*OCEAN
 =[Depth], 1025.0, 9.81
*NODE
 1, -0.1, 0.0
 2, -0.1, 10.0
*ELEMENT
 1, 1, 2
C behind the elements
$LOAD CASE
*OFFSET
 =[Offset]
C waves
*WAVE-REGULAR
 1.0, =[Period], 0.0
"""

PARAMETERS = """\
$PREPROCESSOR
*PARAMETERS
 Depth, 100.0
 Offset, -50
C in seconds
 Period , 08
 Folder, "Near side"
 Twice, =[2*Depth]
 Point, /X:11, Y:22/
"""


def text(variations: str, combinations: str) -> str:
    """A deck with the lines of `*VARIATION` and `*COMBINATIONS`."""
    return f"{PARAMETERS}*VARIATION\n{variations}*COMBINATIONS\n{combinations}C model\n{MODEL}"


def deck(content: str | bytes, name: str = "study.keyxm", folder: Path | None = None) -> Deck:
    data = content.encode() if isinstance(content, str) else content
    return load_bytes(data, name, folder=folder)


def planned(variations: str, combinations: str = " DESCRIPTION=all, FILENAME=%Period%\n") -> ExpansionPlan:
    return plan(deck(text(variations, combinations)))


def refused(content: str | bytes, name: str = "study.keyxm", folder: Path | None = None) -> list[Diagnostic]:
    """Why a deck cannot be expanded."""
    with pytest.raises(DeckError) as caught:
        plan(deck(content, name, folder))
    return list(caught.value.diagnostics)


def only(found: list[Diagnostic]) -> tuple[str, int, int, str]:
    """The one reason: code, line, column, message."""
    assert len(found) == 1, found
    return found[0].code, found[0].line, found[0].column, found[0].message
