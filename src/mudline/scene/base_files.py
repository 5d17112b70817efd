"""Decks that are continued, read once for all the decks that continue them."""

from __future__ import annotations

from pathlib import Path

from mudline.deck.evaluation import evaluated
from mudline.deck.loading import load_path
from mudline.diagnostics import DeckError
from mudline.scene.continued import Base

LARGEST_FILE = 200_000_000
_MOST_KEPT = 32
_LARGEST_KEPT = 100_000_000
"""Bytes of all the files that are kept."""

_Version = tuple[int, int]
"""When a file was changed last, and how long it is."""


class BaseError(ValueError):
    """A file that cannot be continued; the text says why."""


class _Kept:
    """The decks that were read last."""

    def __init__(self) -> None:
        self.decks: dict[str, tuple[_Version, Base]] = {}

    def find(self, key: str, version: _Version) -> Base | None:
        """The deck of a file, if it has not changed since it was read."""
        found = self.decks.get(key)
        return found[1] if found and found[0] == version else None

    def add(self, key: str, version: _Version, base: Base) -> None:
        """Keep a deck, and let those go that were read long before."""
        self.decks.pop(key, None)
        self.decks[key] = (version, base)
        while len(self.decks) > 1 and (len(self.decks) > _MOST_KEPT or self._bytes() > _LARGEST_KEPT):
            del self.decks[next(iter(self.decks))]

    def _bytes(self) -> int:
        return sum(version[1] for version, _ in self.decks.values())


_KEPT = _Kept()


def read_base(path: Path) -> Base:
    """The deck of a file in any form, its model evaluated. Raises BaseError."""
    try:
        stat = path.stat()
        version = (stat.st_mtime_ns, stat.st_size)
        key = str(path.absolute())
        if stat.st_size > LARGEST_FILE:
            raise BaseError(f"{path.as_posix()} has more than {LARGEST_FILE // 10**6} million bytes")
        found = _KEPT.find(key, version)
        if found is None:
            found = _read(path)
            _KEPT.add(key, version, found)
    except OSError as error:
        raise BaseError(f"{path.as_posix()}: {error.strerror or error}") from error
    return found


def _read(path: Path) -> Base:
    try:
        deck = load_path(path)
    except DeckError as error:
        raise BaseError(f"{error.diagnostics[0]}") from error
    if not deck.sections:
        raise BaseError(f"{path.as_posix()} has no section: it is no deck")
    ready, problems = evaluated(deck)
    model = {number: section for number, section in enumerate(ready.sections) if section.name == "MODEL"}
    return Base(deck, model, (*deck.problems, *problems))
