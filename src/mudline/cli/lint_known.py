"""Decks that were linted before: what is known of them without reading one."""

from __future__ import annotations

from dataclasses import dataclass

from mudline.cli.configured import Configured
from mudline.cli.inputs import Input, Inputs
from mudline.linting.cache import Cache, opened
from mudline.linting.configuration import Given


@dataclass
class KnownDecks:
    """The cache, and for each deck of a run whether it knows that nothing is found in it: 1 or 0 in `clean`."""

    cache: Cache
    configured: Configured
    inputs: Inputs
    clean: bytearray

    @property
    def all_clean(self) -> bool:
        """Whether nothing is found in any deck of the run."""
        return bool(self.clean) and all(self.clean)

    def key(self, file: Input, data: bytes) -> str:
        """What the findings of a file are kept under."""
        return self.cache.key(file.name, data, self.configured.of(file.path))

    def look(self) -> None:
        """Find the decks in which nothing is found."""
        for number, file in enumerate(self.inputs.files):
            if file.path is None:
                continue
            try:
                data = file.read()
            except OSError:  # reported when the others are read
                continue
            if self.cache.get(self.key(file, data), file.name) == ():
                self.clean[number] = 1


def known_decks(inputs: Inputs, given: Given, configured: Configured) -> KnownDecks | None:
    """What is known of the decks of a run; None where there is no place for a cache."""
    cache = opened(repr(given))
    if cache is None:
        return None
    found = KnownDecks(cache, configured, inputs, bytearray(len(inputs.files)))
    if cache.known:
        found.look()
    return found
