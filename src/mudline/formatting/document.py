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

_ALTERED = "formatting would change its meaning: this is a fault of mudline, please report it"
_REMARKS = "it has YAML comments (#), which belong to no part of a deck and would be lost: it is left as it is"


class FormatError(Exception):
    """A file without an error that is left as it is nevertheless; the message says why."""


def formatted(data: bytes, name: str) -> bytes:
    """The content of a deck file in canonical form; `name` tells whether it is keyword text, JSON or YAML.

    A keyword text keeps its encoding and its prevailing line end; a deck in JSON or YAML becomes what `dump` writes.
    Raises DeckError for a deck that has an error, and FormatError where something would be lost or changed.
    """
    form = form_of(name)
    if form != "keyword":
        return _document(data, name, form)
    source = Source.from_bytes(data, name)
    deck = read_source(source).require()
    edits = layout_edits(cast("TextOrigin", deck.origin))
    if not edits:
        return data
    after = source.to_bytes(apply_edits(source.text, edits))
    return _checked(deck, after, read_source(Source.from_bytes(after, name)))


def _document(data: bytes, name: str, form: str) -> bytes:
    deck = load_bytes(data, name).require()
    after = dump(deck, form).encode()
    if data.count(b"#") != after.count(b"#") and form == "yaml":  # those of the deck's texts are written again
        raise FormatError(_REMARKS)
    return _checked(deck, after, load_bytes(after, name))


def _checked(deck: Deck, after: bytes, again: Deck) -> bytes:
    """The new content, if it gives the same deck with the same findings."""
    findings = [[problem.code for problem in read.problems] for read in (deck, again)]
    if findings[0] != findings[1] or not same_meaning(deck, again):
        raise FormatError(_ALTERED)
    return after
