"""Files beside a deck that it names: they are not copied, and new decks may stand elsewhere."""

from __future__ import annotations

from typing import cast

from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin
from mudline.scene.deck_files import file_name, find_file
from mudline.syntax.fields import read_line
from mudline.syntax.tree import Kind
from mudline.variations.names import path_fault

_KEYS = ("FILE", "LAST")
_MOST = 1000


def companions(deck: Deck) -> list[str]:
    """The files that lines of a deck name with FILE= or LAST=, relative to the deck and there, each once.

    Those of `$PREPROCESSOR` are for making the new decks, which do not need them.
    """
    origin = cast("TextOrigin", deck.origin)
    text = origin.source.unified
    leaves = (
        leaf
        for section in origin.tree.sections
        if section.name != "PREPROCESSOR"
        for block in section.blocks
        for leaf in block.leaves
        if leaf.kind is Kind.SETTING
    )
    found: dict[str, None] = {}
    for leaf in leaves:
        for group in read_line(text, leaf.span).groups:
            name = file_name(group.fields[0].text) if group.key in _KEYS and group.fields else ""
            if name and not path_fault(name) and find_file(deck.folder, name):
                found[name] = None
        if len(found) == _MOST:
            break
    return list(found)
