"""Decks with typed blocks: `typed.pyi`, generated from the catalogue, maps each keyword to its class."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mudline.language.deck.editable import EditableDeck
from mudline.language.diagnostics import Where
from mudline.language.keywords.model import Block


class TypedDeck(EditableDeck):
    """Deck whose blocks are found by keyword or class."""

    def block(self, keyword: str | type[Block], section: str | None = None) -> Any:
        """Return the only block of a keyword, given by its name or its class.

        Raises UnknownNameError, a KeyError, if there is none, and ValueError if there are several.
        """
        return self.one_of(keyword, section)

    def blocks(self, keyword: str | type[Block], section: str | None = None) -> Iterator[tuple[Where, Any]]:
        """Return the blocks of a keyword, given by name or class, each with its place, in the order of the file.

        Without `section`, the sections where the keyword belongs are searched; a keyword that belongs in `MODEL` is
        searched only there. Blocks whose lines are not read are left out.
        """
        return self.all_of(keyword, section)
