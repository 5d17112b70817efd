"""The decks that share a model with an open one: those that it continues, and those that continue it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin
from mudline.linting.engine import read_deck
from mudline.lsp.decks import Analysis, Decks
from mudline.lsp.documents import Document, address_of
from mudline.scene.restart import decks_before

_SUFFIXES = (".keyx", ".keyxm", ".keyxi", ".das")
_MOST_FILES = 1000
_LARGEST = 5_000_000
"""Bytes of a file beside a deck that is looked through for a *RESTART."""
_RESTART = b"RESTART"


class Linked(NamedTuple):
    """A deck of a chain with its text as a document, open or not."""

    document: Document
    deck: Deck


def chain(decks: Decks, analysis: Analysis, folders: list[Path]) -> list[Linked]:
    """A deck, those that it continues, and those that continue it.

    Of the latter, open ones count, and files beside the deck if that is in one of the `folders` of the workspace.
    """
    if analysis.deck is None or analysis.scene is None:
        return []
    found = [Linked(analysis.document, analysis.deck)]
    for base in analysis.scene.deck.bases:
        if base.deck.folder is not None and isinstance(base.deck.origin, TextOrigin):
            path = base.deck.folder / Path(base.deck.file).name
            found.append(Linked(decks.at(path) or _unopened(path, base.deck.origin), base.deck))
    if analysis.document.path is not None:
        found += _dependents(decks, analysis.document.path)
        if any(analysis.document.path.is_relative_to(folder) for folder in folders):
            with decks.reading():
                found += _beside(decks, analysis.document.path)
    return found


def _unopened(path: Path, origin: TextOrigin) -> Document:
    return Document(address_of(path), origin.source.text, 0)


def _dependents(decks: Decks, path: Path) -> Iterator[Linked]:
    """The open decks that continue a deck."""
    for uri in list(decks.documents):
        other = decks.analysis(uri)
        if other is not None and other.deck is not None and other.document.path != path:
            with decks.reading():
                if _continues(other.deck, path):
                    yield Linked(other.document, other.deck)


def _continues(deck: Deck, path: Path) -> bool:
    """Whether a deck continues that of a file."""
    return any(os.path.abspath(before) == os.path.abspath(path) for before in decks_before(deck))  # noqa: PTH100 - links stay


def _beside(decks: Decks, path: Path) -> Iterator[Linked]:
    """The decks in the folder of a deck that continue it and are not open."""
    for number, other in enumerate(sorted(path.parent.iterdir())):
        if number == _MOST_FILES:
            return
        if other == path or other.suffix.lower() not in _SUFFIXES or decks.at(other) is not None:
            continue
        try:
            data = other.read_bytes() if other.stat().st_size <= _LARGEST else b""
        except OSError:
            continue
        if _RESTART in data.upper():
            deck = read_deck(data, other.as_posix(), folder=other.parent)
            if isinstance(deck.origin, TextOrigin) and _continues(deck, path):
                yield Linked(_unopened(other, deck.origin), deck)
