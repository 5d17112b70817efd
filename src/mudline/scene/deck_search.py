"""Where the deck of a LAST= is: the name as it is written, or with the suffix of a deck."""

from __future__ import annotations

import os
from functools import lru_cache
from itertools import islice
from pathlib import Path, PurePath

from mudline.deck.model import Deck
from mudline.scene.deck_files import file_name, find_file

_SUFFIXES = (".keyxm", ".keyxi", ".keyx", ".das")
_MOST_LISTED = 20_000
"""Files of a folder that are looked through for a name in another case."""


def tried(deck: Deck, written: str) -> list[str]:
    """The names that a LAST= may stand for: as written, then with the deck's own suffix, then with the others."""
    name = file_name(written)
    own = PurePath(deck.file).suffix
    return list(dict.fromkeys([name, *(name + suffix for suffix in (own, *_SUFFIXES))]))


def find_deck(deck: Deck, written: str) -> Path | None:
    """The file that a LAST= of a deck names; of names that differ in case only, the first in sorted order."""
    names = tried(deck, written)
    exact = (find_file(deck.folder, name) for name in names)
    return next((path for path in exact if path is not None), None) or _in_other_case(deck.folder, names)


def _in_other_case(folder: Path | None, names: list[str]) -> Path | None:
    if folder is None:
        return None
    inner = PurePath(names[0]).parent
    try:
        listed = _listed(str(folder / inner), (folder / inner).stat().st_mtime_ns)
    except (OSError, ValueError):
        return None
    known = (listed.get(PurePath(name).name.casefold()) for name in names)
    found = (find_file(folder, (inner / name).as_posix()) for name in known if name is not None)
    return next((path for path in found if path is not None), None)


@lru_cache(maxsize=4)
def _listed(folder: str, _changed: int) -> dict[str, str]:
    """The files of a folder by their names without case; listed once for all decks until the folder changes."""
    with os.scandir(folder) as entries:
        names = sorted(islice((each.name for each in entries), _MOST_LISTED), reverse=True)
    return {name.casefold(): name for name in names}
