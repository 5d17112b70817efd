"""Decks of two folders, compared in pairs of the same relative path."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from mudline.editing.comparison.superseded import ComparedDeck, DeckStatus, compare_decks
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.searching import Search, is_in_any_form, may_be_deck
from mudline.language.diagnostics import DeckError


def compare_folders(
    before: str, after: str, tolerance: float, *, strict: bool, units: str | None = None, gitignore: bool = True
) -> Iterator[ComparedDeck]:
    """Yield each relative path of a deck below one of two folders, in sorted order, with the result of its comparison.

    Files that cannot be read and decks with errors are included with the status "failed".
    """
    searches = [Search(folder, gitignore) for folder in (before, after)]
    old, new = (
        {name: Path(path) for name, path in search.files(lambda path: is_in_any_form(path) and may_be_deck(path))}
        for search in searches
    )
    for error in (error for search in searches for error in search.unreadable):
        name = str(error.filename).replace(os.sep, "/")
        yield ComparedDeck(name, DeckStatus.FAILED, unread=error)
    for name in sorted({*old, *new}):
        if name not in old or name not in new:
            yield ComparedDeck(name, DeckStatus.REMOVED if name in old else DeckStatus.ADDED)
            continue
        names = old[name].as_posix(), new[name].as_posix()
        try:
            first, second = (
                load_bytes(path.read_bytes(), path.as_posix(), units=units, folder=path.parent)
                for path in (old[name], new[name])
            )
            compared = compare_decks(first, second, tolerance, strict=strict)
        except DeckError as error:
            yield ComparedDeck(name, DeckStatus.FAILED, *names, errors=error.diagnostics)
        except OSError as error:
            yield ComparedDeck(name, DeckStatus.FAILED, *names, unread=error)
        else:
            yield ComparedDeck(name, DeckStatus.CHANGED if compared.differences else DeckStatus.EQUAL, *names, compared)
