"""Decks with typed blocks: `typed.pyi`, generated from the catalogue, maps each keyword to its class."""

from __future__ import annotations

from mudline.language.deck.editable import EditableDeck


class TypedDeck(EditableDeck):
    """Deck whose blocks are found by keyword or class."""
