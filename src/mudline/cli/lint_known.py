"""Decks that were linted before: what is known of them without reading one."""

from __future__ import annotations

from dataclasses import dataclass, field

from mudline.cli.configured import Configured, Given
from mudline.cli.inputs import Input, Inputs
from mudline.linting.cache import Cache, opened


@dataclass
class KnownDecks:
    """The cache, and the decks of a run of which it knows that nothing is found in them."""

    cache: Cache
    configured: Configured
    inputs: Inputs
    clean: set[Input] = field(default_factory=set)

    @property
    def all_clean(self) -> bool:
        """Whether nothing is found in any deck of the run."""
        return bool(self.inputs.files) and len(self.clean) == len(self.inputs.files)

    def key(self, file: Input, data: bytes) -> str:
        """What the findings of a file are kept under."""
        return self.cache.key(file.name, data, self.configured.of(file.path))

    def look(self) -> None:
        """Find the decks in which nothing is found."""
        for file in self.inputs.files:
            if file.path is None:
                continue
            try:
                data = file.read()
            except OSError:  # reported when the others are read
                continue
            if self.cache.get(self.key(file, data), file.name) == ():
                self.clean.add(file)


def known_decks(inputs: Inputs, given: Given, configured: Configured) -> KnownDecks | None:
    """What is known of the decks of a run; None where there is no place for a cache."""
    cache = opened(repr(given))
    if cache is None:
        return None
    found = KnownDecks(cache, configured, inputs)
    if cache.known:
        found.look()
    return found
