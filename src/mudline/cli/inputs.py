"""The files that a command reads: paths, directories, standard input."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import click

from mudline.cli.exits import WRONG_USAGE
from mudline.deck.loading import load_bytes
from mudline.deck.model import Deck

SUFFIXES = frozenset({".keyx", ".keyxm", ".keyxi", ".das"})
STDIN = "-"


@dataclass(frozen=True, slots=True)
class Input:
    """A file by the name that it is reported under; `path` None is standard input."""

    name: str
    path: Path | None

    def read(self) -> bytes:
        """The content; raises OSError."""
        return sys.stdin.buffer.read() if self.path is None else self.path.read_bytes()


@dataclass(slots=True)
class Inputs:
    """The files found, and whether something could not be found or read."""

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
        click.echo(f"mudline: {message}", err=True)
        self.code = WRONG_USAGE


def collect(paths: Sequence[str], stdin_name: str = "<stdin>") -> Inputs:
    """Files as given; directories searched for decks, in sorted order; `-` for standard input."""
    found = Inputs()
    for given in paths:
        path = Path(given)
        if given == STDIN:
            found.files.append(Input(stdin_name, None))
        elif path.is_dir():
            _directory(given, path, found)
        elif path.exists():
            found.files.append(Input(given.replace(os.sep, "/"), path))
        else:
            found.fail(f"{given}: no such file or directory")
    return found


def _directory(given: str, path: Path, found: Inputs) -> None:
    decks = sorted(file for file in path.rglob("*") if file.suffix.lower() in SUFFIXES and file.is_file())
    if not decks:
        found.fail(f"{given}: no deck in this directory (looked for {', '.join(sorted(SUFFIXES))})")
    start = given.replace(os.sep, "/").rstrip("/") or "/"
    for file in decks:
        inner = file.relative_to(path).as_posix()
        found.files.append(Input(inner if given == "." else f"{start}/{inner}", file))


def reason(error: OSError) -> str:
    """Why a file could not be read or written, in words."""
    return (error.strerror or str(error)).lower()


def load(given: str, *, form: str | None = None, units: str | None = None, stdin_name: str = "<stdin>") -> Deck:
    """The one deck of a command; ends the command when the path cannot be read. Raises DeckError."""
    if Path(given).is_dir():
        raise click.UsageError(f"{given} is a directory: this command takes one deck")
    file = Input(stdin_name, None) if given == STDIN else Input(given.replace(os.sep, "/"), Path(given))
    try:
        data = file.read()
    except OSError as error:
        raise click.UsageError(f"{given}: {reason(error)}") from error
    return load_bytes(data, file.name, form=form, units=units)
