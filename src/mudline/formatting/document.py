"""A whole file in canonical form; nothing is given back that would mean something else."""

from __future__ import annotations

from typing import cast

from mudline.deck.loading import dump, form_of, load_bytes
from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin, read_source
from mudline.formatting.layout import layout_edits
from mudline.formatting.meaning import same_meaning
from mudline.syntax.edits import apply_edits
from mudline.syntax.source import Source


class AlteredError(Exception):
    """The canonical text would mean something else: a fault of the formatter."""

    def __init__(self) -> None:
        super().__init__("formatting would change its meaning: this is a fault of mudline, please report it")


def formatted(data: bytes, name: str) -> bytes:
    """The content of a deck file in canonical layout, in its own encoding and line ends; `name` tells its form.

    A deck in JSON or YAML becomes what `dump` writes. Raises DeckError for a deck that has an error, and AlteredError
    rather than to give back a deck that is not the same.
    """
    form = form_of(name)
    if form != "keyword":
        deck = load_bytes(data, name).require()
        after = dump(deck, form).encode()
        return _checked(deck, after, load_bytes(after, name))
    source = Source.from_bytes(data, name)
    deck = read_source(source)
    edits = layout_edits(cast("TextOrigin", deck.require().origin))
    if not edits:
        return data
    after = source.to_bytes(apply_edits(source.text, edits))
    return _checked(deck, after, read_source(Source.from_bytes(after, name)))


def _checked(deck: Deck, after: bytes, again: Deck) -> bytes:
    faults = [problem.code for problem in deck.problems]
    if not same_meaning(deck, again) or faults != [problem.code for problem in again.problems]:
        raise AlteredError
    return after
