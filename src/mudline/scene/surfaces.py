"""The legacy surfaces of a deck."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mudline.deck.model import Deck
from mudline.diagnostics import Where

if TYPE_CHECKING:
    from mudline.keywords.surface import Surface


def surfaces(deck: Deck) -> list[tuple[Where, Surface]]:
    """The rigid surfaces of a deck, then the elastic ones, each in the order of the file; the last one holds."""
    found = deck.blocks_that(lambda declared: declared.facts.seabed_type)
    return sorted(found, key=lambda placed: placed[1].facts.seabed_type == "ELASTIC")
