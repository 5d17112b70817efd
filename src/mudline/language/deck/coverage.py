"""How much of a deck was read: its keywords, each as often as it occurs."""

from __future__ import annotations

from mudline.language.deck.model import Deck, Opaque
from mudline.language.diagnostics import Coverage
from mudline.language.keywords.keeping import is_read
from mudline.language.keywords.model import Block


def coverage_of(deck: Deck) -> Coverage:
    """Count the keywords of a deck itself by how much of them was read."""
    found = Coverage()
    for section in deck.own_sections:
        for block in section.blocks:
            found.total += 1
            if extent(block) == "read":
                found.read += 1
            else:
                names = found.unread if type(block) is Opaque else found.partly
                names[block.keyword] = names.get(block.keyword, 0) + 1
    return found


def extent(block: Block | Opaque) -> str:
    """How much of a block was read: "read", "partly" or "unread"."""
    if type(block) is Opaque:
        return "unread"
    return "read" if is_read(block) else "partly"
