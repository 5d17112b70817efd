"""Files beside a deck that it names: they are not copied, and new decks may stand elsewhere."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin
from mudline.keywords.kept import Names
from mudline.keywords.model import Block, names_given
from mudline.scene.deck_values import file_name, find_file
from mudline.syntax.fields import read_line
from mudline.syntax.tree import Kind, RawBlock
from mudline.variations.names import path_fault

_KEYS = ("FILE", "LAST")
"""Settings that name a file among lines that are kept as they are."""
_MOST = 1000


def companions(deck: Deck) -> list[str]:
    """The files that a deck names, relative to the deck and there, each once.

    Those of `$PREPROCESSOR` are for making the new decks, which do not need them.
    """
    found: dict[str, None] = {}
    for written in _written(deck):
        name = file_name(written)
        if name and not path_fault(name) and find_file(deck.folder, name):
            found[name] = None
        if len(found) == _MOST:
            break
    return list(found)


def _written(deck: Deck) -> Iterator[str]:
    origin = cast("TextOrigin", deck.origin)
    text = origin.source.unified
    for section, raw in zip(deck.sections, origin.tree.sections, strict=True):
        for block, lines in zip(section.blocks, raw.blocks, strict=True) if section.name != "PREPROCESSOR" else ():
            if isinstance(block, Block):
                yield from (name for what in (Names.FILE, Names.DECK) for _, name in names_given(block, what))
            else:
                yield from _in_lines(text, lines)


def _in_lines(text: str, block: RawBlock) -> Iterator[str]:
    for leaf in block.leaves:
        if leaf.kind is Kind.SETTING:
            groups = read_line(text, leaf.span).groups
            yield from (group.fields[0].text for group in groups if group.key in _KEYS and group.fields)
