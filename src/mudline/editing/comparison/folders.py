"""The decks of two folders, compared in pairs of the same path in each."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

from mudline.editing.comparison.superseded import ComparedDeck, Status, compare_decks
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.searching import Search, is_in_any_form, may_be_deck
from mudline.language.diagnostics import DeckError

Unread = Callable[[str, OSError], None]
"""Is given what cannot be read, and why."""


def compare_folders(  # noqa: PLR0913 - as many as there are options
    before: str,
    after: str,
    tolerance: float,
    unread: Unread,
    *,
    strict: bool,
    units: str | None = None,
    gitignore: bool = True,
) -> Iterator[ComparedDeck]:
    """Yield each path of a deck below one of two folders, in sorted order, and what became of it.

    A deck that cannot be read is given to `unread` and left out; one with errors has failed.
    """
    old, new = (_decks(folder, unread, gitignore=gitignore) for folder in (before, after))
    for name in sorted({*old, *new}):
        if name not in old or name not in new:
            yield ComparedDeck(name, Status.REMOVED if name in old else Status.ADDED)
            continue
        names = old[name].as_posix(), new[name].as_posix()
        try:
            first, second = (
                load_bytes(path.read_bytes(), path.as_posix(), units=units, folder=path.parent)
                for path in (old[name], new[name])
            )
            found = compare_decks(first, second, tolerance, strict=strict)
        except DeckError as error:
            yield ComparedDeck(name, Status.FAILED, *names, errors=error.diagnostics)
        except OSError as error:
            unread(str(error.filename).replace(os.sep, "/"), error)
        else:
            yield ComparedDeck(name, Status.CHANGED if found.differences else Status.EQUAL, *names, found)


def _decks(folder: str, unread: Unread, *, gitignore: bool) -> dict[str, Path]:
    """The decks below a folder by their path in it."""
    search = Search(folder, gitignore)
    found = {name: Path(path) for name, path in search.files(lambda path: is_in_any_form(path) and may_be_deck(path))}
    for error in search.unreadable:
        unread(str(error.filename).replace(os.sep, "/"), error)
    return found
