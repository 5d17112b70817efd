"""The files that a command reads: paths, directories, standard input."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePath

import click

from mudline.cli.exits import WRONG_USAGE
from mudline.cli.searching import Search
from mudline.cli.terminal import reason, tell
from mudline.deck.loading import load_bytes
from mudline.deck.model import Deck

SUFFIXES = frozenset({".keyx", ".keyxm", ".keyxi", ".das"})
STDIN = "-"


@dataclass(frozen=True, slots=True)
class Input:
    """A file by the name that it is reported under; `path` None is standard input."""

    name: str
    path: str | None

    @property
    def folder(self) -> Path | None:
        """Where files that the deck names stand; None for standard input, which names no place."""
        return None if self.path is None else Path(self.path).parent

    def read(self) -> bytes:
        """The content; raises OSError."""
        if self.path is not None:
            return Path(self.path).read_bytes()
        if sys.stdin is None:
            raise OSError(errno.EBADF, "standard input is closed")
        return sys.stdin.buffer.read()


@dataclass(slots=True)
class Inputs:
    """The files found, each once, and whether something could not be found or read."""

    files: list[Input] = field(default_factory=list)
    code: int = 0

    def contents(self) -> Iterator[tuple[Input, bytes]]:
        """Each file that can be read; the others are told and set the exit code."""
        for file in self.files:
            try:
                data = file.read()
            except OSError as error:
                self.fail(f"{file.name}: {reason(error)}")
                continue
            yield file, data

    def fail(self, message: str) -> None:
        """Tell of a path that cannot be read."""
        tell(message)
        self.code = WRONG_USAGE


Wanted = Callable[[PurePath], bool]
"""Whether a file of a directory is taken as a deck."""


def is_deck(path: PurePath) -> bool:
    """Whether the suffix is one of a deck."""
    return path.suffix.lower() in SUFFIXES


def collect(
    paths: Sequence[str], stdin_name: str = "<stdin>", wanted: Wanted = is_deck, *, gitignore: bool = True
) -> Inputs:
    """Files as given; directories searched for wanted files, in sorted order; `-` for standard input.

    `gitignore` leaves out of a search what `.gitignore` files hide.
    """

    def taken(path: PurePath) -> bool:
        return wanted(path) and os.path.isfile(path)  # noqa: PTH113 - Path raises for a name that is too long

    return collect_taken(paths, stdin_name, taken, gitignore=gitignore)


def collect_taken(paths: Sequence[str], stdin_name: str, taken: Wanted, *, gitignore: bool) -> Inputs:
    """As `collect`, where `taken` also says whether a path is a file."""
    found = Inputs()
    for given in paths:
        if os.path.isdir(given):  # noqa: PTH112 - Path raises for a name that is too long or may not be looked at
            _directory(Search(given, gitignore), found, taken)
        else:
            found.files.append(_single(given, stdin_name))
    found.files = list(dict.fromkeys(found.files))
    return found


def _single(given: str, stdin_name: str) -> Input:
    return Input(stdin_name, None) if given == STDIN else Input(_slashed(given), given)


def _slashed(path: str) -> str:
    return path.replace(os.sep, "/")


def _directory(search: Search, found: Inputs, taken: Wanted) -> None:
    given = search.given
    decks = sorted(path for path in search.paths() if taken(path))
    for error in search.unreadable:
        found.fail(f"{_slashed(str(error.filename))}: {reason(error)}")
    if not decks and not search.unreadable:
        hidden = "; --no-gitignore takes what a .gitignore hides" if search.hidden else ""
        found.fail(f"{given}: no deck in this directory (looked for {', '.join(sorted(SUFFIXES))}{hidden})")
    start = "" if given == "." else _slashed(given).rstrip("/") + "/"
    found.files += [Input(start + path.relative_to(given).as_posix(), str(path)) for path in decks]


def load(given: str, *, form: str | None = None, units: str | None = None, stdin_name: str = "<stdin>") -> Deck:
    """The one deck of a command; ends the command when the path cannot be read. Raises DeckError."""
    if os.path.isdir(given):  # noqa: PTH112 - as above
        raise click.ClickException(f"{given} is a directory: this command takes one deck")
    file = _single(given, stdin_name)
    try:
        data = file.read()
    except OSError as error:
        raise click.ClickException(f"{given}: {reason(error)}") from error
    return load_bytes(data, file.name, form=form, units=units, folder=file.folder)
