"""Decks that know the classes of their blocks: `typed.pyi`, made of the catalogue, says which a name means."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mudline.language.deck.editable import EditableDeck
from mudline.language.diagnostics import Where
from mudline.language.keywords.model import Block


class TypedDeck(EditableDeck):
    """A deck whose blocks are found by keyword or class."""

    def block(self, keyword: str | type[Block], section: str | None = None) -> Any:
        """Return the only block of a keyword, which is given by its name or its class.

        Raises UnknownNameError, a KeyError, where there is none, and ValueError where there are several.
        """
        return self.one_of(keyword, section)

    def blocks(self, keyword: str | type[Block], section: str | None = None) -> Iterator[tuple[Where, Any]]:
        """The blocks of a keyword, given by its name or class, in the order of the file, each with its place.

        Without `section` those in the sections where the keyword belongs; one that belongs in `MODEL` is looked for
        there. A block whose lines are not read is none of them.
        """
        return self.all_of(keyword, section)
