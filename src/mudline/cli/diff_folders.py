"""The decks of two folders in pairs of one name, compared one after the other."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

from mudline.cli import DONE, FOUND
from mudline.cli.inputs import GivenDeck, Input, Inputs, collect_any_form
from mudline.cli.streams import notify_diagnostics
from mudline.comparison.comparing import compare
from mudline.comparison.superseded import Comparison, without_spelling
from mudline.deck.loading import load_bytes
from mudline.deck.model import Deck
from mudline.diagnostics import DeckError
from mudline.scene.model import resolve

NOTHING = Comparison([], [])


@dataclass(frozen=True, slots=True)
class Comparing:
    """How decks are compared, as the options say."""

    tolerance: float
    strict: bool
    units: str | None

    def decks(self, first: Deck, second: Deck) -> Comparison:
        """The differences of two decks. Raises DeckError for one that cannot be compared."""
        before, after = resolve(first), resolve(second)
        found = compare(before, after, self.tolerance)
        return Comparison(found, []) if self.strict else without_spelling(before, after, found, self.tolerance)

    def files(self, before: str, after: str, stdin_name: str) -> tuple[Deck, Deck]:
        """The decks of two files; the null device, which git gives for a file that is not there, is an empty one."""
        if os.devnull in (before, after):
            return self._beside_nothing(before, after, stdin_name)
        return self._read(before, stdin_name), self._read(after, stdin_name)

    def _read(self, path: str, stdin_name: str) -> Deck:
        return GivenDeck(path, stdin_name, self.units).load()

    def _beside_nothing(self, before: str, after: str, stdin_name: str) -> tuple[Deck, Deck]:
        """An empty deck has the units of the other one."""
        there = self._read(after if before == os.devnull else before, stdin_name)
        empty = load_bytes(b"", os.devnull, form="keyword", units=there.units)
        return (empty, there) if before == os.devnull else (there, empty)


class Status(StrEnum):
    """What a comparison says of a name; the order is that of a summary."""

    CHANGED = "changed"
    ADDED = "added"
    REMOVED = "removed"
    EQUAL = "equal"
    FAILED = "failed"


class ComparedDeck(NamedTuple):
    """A name below both folders, what became of it, and why it could not be compared, where it could not."""

    name: str
    status: Status
    before: str
    after: str
    comparison: Comparison = NOTHING
    why: str = ""


@dataclass(slots=True)
class Folders:
    """Two folders; `counts` and `code`, the exit code, are whole when all of `compared` has been taken."""

    before: str
    after: str
    comparing: Comparing
    gitignore: bool
    counts: Counter[Status] = field(default_factory=Counter)
    code: int = DONE

    def compared(self) -> Iterator[ComparedDeck]:
        """Each name of a deck in one of the folders, in sorted order."""
        old, new = (_Folder(path, gitignore=self.gitignore) for path in (self.before, self.after))
        if not old.files and not new.files and not (old.inputs.code or new.inputs.code):
            old.inputs.fail(f"{self.before}, {self.after}: no deck in these folders")
        for name in sorted({*old.files, *new.files}):
            one = self._compared(name, old, new)
            if one is not None:
                self.counts[one.status] += 1
                yield one
        found = self.counts.total() - self.counts[Status.EQUAL]
        self.code = max(old.inputs.code, new.inputs.code, FOUND if found else DONE)

    def _compared(self, name: str, old: _Folder, new: _Folder) -> ComparedDeck | None:
        before, after = old.files.get(name), new.files.get(name)
        if before is None or after is None:
            status = Status.ADDED if before is None else Status.REMOVED
            return ComparedDeck(name, status, before.name if before else "", after.name if after else "")
        first, second = old.inputs.content(before), new.inputs.content(after)
        if first is None or second is None:  # which is reported, and sets the exit code
            return None
        files = before.name, after.name
        try:
            decks = (self._deck(*given) for given in ((before, first), (after, second)))
            comparison = self.comparing.decks(*decks)
        except DeckError as error:
            notify_diagnostics(error.diagnostics)
            found = error.diagnostics[0]
            why = f"{found.file}:{found.line}:{found.column}: {found.code} {found.message}"
            return ComparedDeck(name, Status.FAILED, *files, why=why)
        return ComparedDeck(name, Status.CHANGED if comparison.differences else Status.EQUAL, *files, comparison)

    def _deck(self, file: Input, data: bytes) -> Deck:
        return load_bytes(data, file.name, units=self.comparing.units, folder=file.folder)


class _Folder:
    """The decks of a folder by their path in it, with `/`; it may have none."""

    def __init__(self, path: str, *, gitignore: bool) -> None:
        self.inputs: Inputs = collect_any_form([path], "", gitignore=gitignore, may_be_empty=True)
        start = path.replace(os.sep, "/").rstrip("/") + "/"
        self.files = {file.name.removeprefix(start): file for file in self.inputs.files}
