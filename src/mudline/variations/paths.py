"""The paths of new decks, from the names that a combination gives."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import PurePath
from typing import NamedTuple

from mudline.deck.model import Deck
from mudline.keywords.text import shown
from mudline.variations.names import filled, path_fault, unquoted
from mudline.variations.targets import Targets, Values

SUFFIXES = (".keyx", ".keyxm", ".keyxi", ".das", ".json", ".yaml", ".yml")
"""What a file name of a deck ends with; another name gets the suffix of the source."""


class NewPath(NamedTuple):
    """A path with `/` in the output folder, and why it may not be used, "" when it may."""

    path: str
    fault: str


@dataclass(frozen=True, slots=True)
class Template:
    """What a combination says of its files; None where it says nothing."""

    directory: str | None
    subdirectory: str | None
    filename: str | None

    @property
    def given(self) -> list[str]:
        """The texts that may hold placeholders."""
        return [unquoted(text) for text in (self.directory, self.subdirectory, self.filename) if text is not None]


class Namer:
    """Names the decks that come from one source."""

    def __init__(self, deck: Deck, targets: Targets) -> None:
        own = PurePath(deck.file).name
        self.source = PurePath("deck" if path_fault(own) else own)
        self.suffix = self.source.suffix or ".keyx"
        self.targets = targets

    def path(self, template: Template, values: Values, counter: str) -> NewPath:
        """The path of a deck; `counter` parts decks whose combination gives no name at all."""
        missing: list[str] = []

        def value_of(name: str) -> str:
            value = self.targets.in_a_name(name, values)
            if value is None:
                missing.append(name)
            return "" if value is None else value

        folders = [
            filled(unquoted(text), value_of) for text in (template.directory, template.subdirectory) if text is not None
        ]
        name = self._own_name(template, counter)
        if template.filename is not None:
            name = filled(unquoted(template.filename), value_of)
        file = name if name.lower().endswith(SUFFIXES) else name + self.suffix
        path = "/".join([*(folder.removesuffix("/") or "/" for folder in folders), file])
        if missing:
            return NewPath(path, f"needs the value of {shown(missing[0])}, which has none")
        if "/" in name:
            return NewPath(path, "has a / in FILENAME=: folders belong in SUBDIRECTORY=")
        if "" in folders:
            return NewPath(path, "has a folder without a name")
        return NewPath(path, path_fault(name) or path_fault(path))

    def _own_name(self, template: Template, counter: str) -> str:
        """The name of a deck that is not given one: that of the source, in a folder of its own."""
        return self.source.name if template.subdirectory is not None else f"{self.source.stem} {counter}"
