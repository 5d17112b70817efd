"""The decks that a command reads: files, searched directories without what a .gitignore hides, standard input."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Callable, Container, Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, wraps
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, NamedTuple

import click

from mudline.cli import FOUND, WRONG_USAGE, options
from mudline.cli.streams import notify, notify_diagnostics, reason
from mudline.deck.forms import form_of
from mudline.diagnostics import DeckError
from mudline.files import write_atomically
from mudline.patterns import Pattern, read_pattern

if TYPE_CHECKING:
    from mudline.deck.model import Deck

GITIGNORE = ".gitignore"
SUFFIXES = frozenset({".keyx", ".keyxm", ".keyxi", ".das"})
STDIN = "-"

_MARK = b"mudline-deck/"
_HEAD = 4096
"""Bytes at the beginning of a JSON or YAML file that name its format."""


@dataclass(frozen=True, slots=True)
class Input:
    """A file by the name that it is reported under; `path` None is standard input."""

    name: str
    path: str | None

    @property
    def folder(self) -> Path | None:
        """The folder of files that the deck names; None for standard input."""
        return None if self.path is None else _folder(os.path.dirname(self.path))  # noqa: PTH120 - asked for many files

    def read(self) -> bytes:
        """The content; raises OSError."""
        if self.path is not None:
            return Path(self.path).read_bytes()
        if sys.stdin is None:
            raise OSError(errno.EBADF, "standard input is closed")
        return sys.stdin.buffer.read()


@lru_cache(maxsize=64)
def _folder(path: str) -> Path:
    return Path(path)


@dataclass(slots=True)
class Inputs:
    """The files found, each once, and whether something could not be found or read."""

    files: list[Input] = field(default_factory=list)
    code: int = 0

    def contents(self, unread: Container[Input] = ()) -> Iterator[tuple[Input, bytes]]:
        """Each file that can be read; the others are reported and set the exit code. Those in `unread` are not read."""
        for file in self.files:
            if file in unread:
                yield file, b""
                continue
            try:
                data = file.read()
            except OSError as error:
                self.fail(f"{file.name}: {reason(error)}")
                continue
            yield file, data

    def replaced(self, file: Input, content: bytes) -> bool:
        """Whether a file has its new content; if not, that is reported."""
        try:
            write_atomically(Path(file.path or file.name), content)
        except OSError as error:
            self.fail(f"{file.name}: cannot be written: {reason(error)}")
            return False
        return True

    def fail(self, message: str) -> None:
        """Report a path that cannot be read or written."""
        notify(message)
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

    return _collect(paths, stdin_name, taken, gitignore=gitignore)


def collect_any_form(paths: Sequence[str], stdin_name: str, *, gitignore: bool) -> Inputs:
    """As `collect`, for decks in any form: also JSON and YAML files whose beginning names the format of decks."""
    return _collect(paths, stdin_name, _is_deck_in_any_form, gitignore=gitignore)


def _is_deck_in_any_form(path: PurePath) -> bool:
    """Whether a file is a deck by its suffix or its content; one that cannot be opened is taken, and reported later."""
    if not is_deck(path) and form_of(path.name) == "keyword":
        return False
    file = Path(path)
    if file.exists() and not file.is_file():
        return False
    if is_deck(path):
        return True
    try:
        with file.open("rb") as stream:
            return _MARK in stream.read(_HEAD)
    except OSError:
        return True


def _collect(paths: Sequence[str], stdin_name: str, taken: Wanted, *, gitignore: bool) -> Inputs:
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


# ------------------------------------------------------------------------------------------------ the one deck


@dataclass(frozen=True, slots=True)
class GivenDeck:
    """The one deck of a command, with the name of standard input and the units that its options give."""

    path: str
    stdin_name: str
    units: str | None

    def content(self) -> tuple[bytes, str]:
        """The content of the file and its name in messages; ends the command when the path cannot be read."""
        file = self._file()
        return self._bytes(file), file.name

    def load(self, form: str | None = None) -> Deck:
        """Read the deck; ends the command when the path cannot be read. Raises DeckError."""
        file = self._file()
        data = self._bytes(file)
        from mudline.deck.loading import load_bytes  # noqa: PLC0415 - what only looks for files reads no deck

        return load_bytes(data, file.name, form=form, units=self.units, folder=file.folder)

    def _file(self) -> Input:
        if os.path.isdir(self.path):  # noqa: PTH112 - as above
            raise click.ClickException(f"{self.path} is a directory: this command takes one deck")
        return _single(self.path, self.stdin_name)

    def _bytes(self, file: Input) -> bytes:
        try:
            return file.read()
        except OSError as error:
            raise click.ClickException(f"{self.path}: {reason(error)}") from error


def takes_deck(command: options.Command) -> options.Command:
    """Add DECK, the options about it and those of all commands; the deck arrives as `deck`, a GivenDeck."""

    @wraps(command)
    def given(*, deck: str, stdin_name: str, units: str | None, **others: object) -> int:
        return command(deck=GivenDeck(deck, stdin_name, units), **others)

    return options.deck(options.stdin_name(options.units(options.common(refuses_bad_decks(given)))))


def refuses_bad_decks(command: options.Command) -> options.Command:
    """Turn the DeckError of a command into messages and exit code 1."""

    @wraps(command)
    def guarded(**given: object) -> int:
        try:
            return command(**given)
        except DeckError as error:
            notify_diagnostics(error.diagnostics)
            return FOUND

    return guarded


# ---------------------------------------------------------------------------------------------------- .gitignore


class _Rules(NamedTuple):
    """The patterns of a `.gitignore`, the last first.

    They are for paths from its own folder: `above` stands before a path from the searched directory, or the first
    `below` letters of it are left out.
    """

    above: str
    below: int
    patterns: Sequence[Pattern]

    def hides(self, path: str, *, folder: bool) -> bool | None:
        """Whether a path from the searched directory is hidden; None where no pattern says anything of it."""
        own = self.above + path[self.below :]
        return next((not one.negated for one in self.patterns if one.fits(own, folder=folder)), None)


@dataclass(slots=True)
class Search:
    """A search of a directory and all below it; links to directories are not followed.

    `unreadable` collects what cannot be looked at, `hidden` says whether a `.gitignore` hid anything. Like git, the
    search also honours the `.gitignore` files above the directory in the same repository; like ripgrep, it honours them
    for what lies in the directory, not for the directory itself, which was asked for.
    """

    given: str
    gitignore: bool = True
    unreadable: list[OSError] = field(default_factory=list)
    hidden: bool = False

    def paths(self) -> Iterator[PurePath]:
        """The files, in no order."""
        rules = {self.given: self._above() if self.gitignore else []}
        for folder, folders, files in os.walk(self.given, onerror=self.unreadable.append):
            found = rules.pop(folder)
            if self.gitignore:
                start = self._start(folder)
                if GITIGNORE in files:
                    found = [*self._read(Path(folder), "", len(start)), *found]
                folders[:] = [
                    name for name in folders if name != ".git" and not self._hides(found, start + name, folder=True)
                ]
                files[:] = [name for name in files if not self._hides(found, start + name, folder=False)]
            rules.update((os.path.join(folder, name), found) for name in folders)  # noqa: PTH118 - as os.walk does
            yield from (PurePath(folder, name) for name in files)

    def _start(self, folder: str) -> str:
        """What stands before the names in a folder, from the searched directory."""
        inside = folder[len(self.given) :].replace(os.sep, "/").strip("/")
        return f"{inside}/" if inside else ""

    def _hides(self, rules: Sequence[_Rules], path: str, *, folder: bool) -> bool:
        said = next((hides for one in rules if (hides := one.hides(path, folder=folder)) is not None), False)
        self.hidden |= said
        return said

    def _above(self) -> list[_Rules]:
        """The rules above the directory, the nearest first."""
        here = Path(os.path.abspath(self.given))  # noqa: PTH100 - links stay what they are called
        found: list[_Rules] = []
        for folder in (here, *here.parents):
            if folder != here:
                found += self._read(folder, f"{here.relative_to(folder).as_posix()}/", 0)
            if (folder / ".git").exists():
                return found
        return []

    def _read(self, folder: Path, above: str, below: int) -> list[_Rules]:
        """The rules of a folder, if it has any."""
        path = folder / GITIGNORE
        try:
            text = os.fsdecode(path.read_bytes()) if path.is_file() else ""
        except OSError as error:
            self.unreadable.append(error)
            return []
        patterns = [pattern for line in text.split("\n") if (pattern := read_pattern(line))]
        return [_Rules(above, below, patterns[::-1])] if patterns else []
