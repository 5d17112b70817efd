"""Decks that go on from others with seabed keywords of their own: what they mean hangs on both."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from mudline.deck.loading import load_path
from mudline.diagnostics import DeckError
from mudline.keywords.catalogue import is_superseded
from mudline.scene.restart import decks_before

_SUFFIXES = frozenset({".keyx", ".keyxm", ".keyxi", ".das"})
_LARGEST = 50_000_000
_NEWER = {"SEABED PROPERTIES", "SEABED STIFFNESS"}
"""What gives the laws that a migrated deck would meet."""


class Continuations:
    """For every deck the decks that continue it, among those that are migrated and those beside them."""

    def __init__(self, files: Iterable[Path]) -> None:
        self.seen: set[Path] = set()
        self.by_base: dict[Path, list[str]] = {}
        for file in files:
            self._look(file)

    def of(self, file: Path) -> list[str]:
        """Names of the decks that continue a deck and have seabed keywords of their own."""
        self._beside(file.parent)
        return sorted(set(self.by_base.get(file.resolve(), ())))

    def _beside(self, folder: Path) -> None:
        if folder not in self.seen:
            self.seen.add(folder)
            for file in sorted(folder.iterdir()):
                if file.suffix.lower() in _SUFFIXES:
                    self._look(file)

    def _look(self, file: Path) -> None:
        if file in self.seen:
            return
        self.seen.add(file)
        try:
            if file.stat().st_size > _LARGEST or b"RESTART" not in file.read_bytes().upper():
                return
            deck = load_path(file)
        except (OSError, DeckError):
            return  # what cannot be read continues nothing; where it is to be migrated that is told
        if deck.keywords() & _NEWER or any(map(is_superseded, deck.keywords())):
            for base in decks_before(deck):
                self.by_base.setdefault(base.resolve(), []).append(file.as_posix())
