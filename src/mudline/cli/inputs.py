"""Decks that a command reads: given files, files of directories that no .gitignore hides, standard input.

Many decks are read and processed in the order given, with a progress bar. Files that cannot be read, or for which the
program fails, are reported, and the others are still processed. So are decks that a command refuses to rewrite.
"""

from __future__ import annotations

import errno
import os
import sys
from collections import deque
from collections.abc import Callable, Generator, Iterator
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeVar, TypeVarTuple

import click

from mudline.basics.files import alone_at, reason, write_atomically
from mudline.basics.overwriting import outputs, reading
from mudline.checks.configuration import Configured
from mudline.cli import WRONG_USAGE, options
from mudline.cli.streams import naming, notify, notify_diagnostics
from mudline.cli.view import Progress, View
from mudline.language.deck import MARK
from mudline.language.deck.forms import SUFFIXES, form_of
from mudline.language.deck.searching import Search, is_deck, is_key_file
from mudline.language.diagnostics import DeckError
from mudline.tools.running.executors import Crash, many

if TYPE_CHECKING:
    from mudline.api import Deck
    from mudline.language.deck import model

_Deck = TypeVar("_Deck", bound="model.Deck")
_Item = TypeVar("_Item")
_Given = TypeVarTuple("_Given")
_Made = TypeVar("_Made")

STDIN = "-"

CHANGED = "it has changed during the run: left unchanged, run it again"
"""Message for a file that somebody else has written."""


def require_text(deck: _Deck) -> _Deck:
    """Return a deck whose file is a text; raises DeckError for a merge conflict or binary data."""
    from mudline.language.deck.reading import TextOrigin  # noqa: PLC0415 - completion does without it

    if isinstance(deck.origin, TextOrigin) and not deck.origin.source.readable:
        raise DeckError(deck.diagnose(deck.origin.source.problems))
    return deck


class Input(NamedTuple):
    """A file with the name under which it is reported; `path` None is standard input.

    A keyword text in an `encoding` is read as if it were UTF-8, and written back in its encoding.
    """

    name: str
    path: str | None
    encoding: str = ""

    @property
    def place(self) -> str:
        """Path of the file; for standard input the name under which it is reported."""
        return self.path or self.name

    @property
    def folder(self) -> Path | None:
        """Folder of files that the deck names; None for standard input, which may name none."""
        if self.path is None:
            return None
        return Path(os.path.dirname(self.path))  # noqa: PTH120 - of a text, which may be any

    def read(self) -> bytes:
        """Return the content; raises OSError."""
        if self.path is not None:
            reading(self.path)
            with open(self.path, "rb", buffering=0) as stream:  # noqa: PTH123 - as above
                return self._recoded(stream.readall(), self.encoding, "utf-8")
        if sys.stdin is None:
            raise OSError(errno.EBADF, "standard input is closed")
        reading(None)
        return self._recoded(sys.stdin.buffer.read(), self.encoding, "utf-8")

    def own_bytes(self, content: bytes) -> bytes:
        """Return a content in the encoding of the file; raises OSError for a letter that the encoding lacks."""
        return self._recoded(content, "utf-8", self.encoding)

    def _recoded(self, data: bytes, before: str, after: str) -> bytes:
        if not self.encoding or form_of(self.name) != "keyword":
            return data
        try:
            return data.decode(before).encode(after)
        except UnicodeError as error:
            fault = f"it is not in {before}" if after == "utf-8" else f"{after} lacks a letter of it"
            raise OSError(errno.EILSEQ, f"{fault}: {error}") from error


@dataclass(slots=True, eq=False)
class Inputs:
    """Files to process, each once, and the exit code for paths that could not be found or read.

    `undone` has the files that could not be read, or for which the program failed, with the reasons.
    """

    files: list[Input] = field(default_factory=list)
    code: int = 0
    undone: dict[Input, str] = field(default_factory=dict)

    def content(self, file: Input) -> bytes | None:
        """Return the content of a file, or None for an unreadable file, which is reported and sets the exit code."""
        try:
            return file.read()
        except OSError as error:
            self.unreadable(file, error)
            return None

    def unreadable(self, file: Input, error: OSError) -> None:
        """Report a file that cannot be read."""
        self.undone[file] = reason(error)
        self.fail(f"{file.name}: {reason(error)}")

    def replaced(self, file: Input, read: bytes, content: bytes) -> bool:
        """Return True if a file has its new content; otherwise the reason is reported.

        A file whose content is no longer `read` stays unchanged: somebody else has written it.
        """
        path = Path(file.place)
        try:
            with alone_at(path):
                current = file.read()
                if current == read:
                    write_atomically(path, file.own_bytes(content))
                elif current != content:
                    self.fail(f"{file.name}: {CHANGED}")
                    return False
        except OSError as error:
            self.fail(f"{file.name}: cannot be written: {reason(error)}")
            return False
        return True

    def fail(self, message: str) -> None:
        """Report a path that cannot be read or written."""
        notify(message)
        self.code = WRONG_USAGE


Wanted = Callable[[str], bool]
"""Predicate of the paths in a directory that are taken as decks."""


def _why_skipped(path: str) -> str:
    if is_key_file(path):
        return "it is a key file of a password manager"
    if form_of(path) != "keyword":
        return f"it does not begin as a deck in JSON or YAML does, with the format {MARK}..."
    if is_deck(path):
        return "the configuration excludes it, or it is not a file"
    return f"its name does not end as that of a deck ({', '.join(sorted(SUFFIXES))}), and no include names it"


def _slashed(path: str) -> str:
    return path.replace(os.sep, "/")


def _single(given: str, stdin_name: str) -> Input:
    return Input(stdin_name, None) if given == STDIN else Input(_slashed(given), given)


def _below(search: Search, inputs: Inputs, taken: Wanted) -> list[Input]:
    given = search.given
    start = "" if given == "." else _slashed(given).rstrip("/") + "/"
    files = [Input(start + inside, path) for inside, path in search.files(taken)]
    for error in search.unreadable:
        inputs.fail(f"{_slashed(str(error.filename))}: {reason(error)}")
    if not (files or search.unreadable):
        hidden = "; --no-gitignore takes what a .gitignore hides" if search.hidden else ""
        inputs.fail(f"{given}: no deck in this directory (looked for {', '.join(sorted(SUFFIXES))}{hidden})")
    return files


# ------------------------------------------------------------------------------------------------ the one deck


class GivenDeck(NamedTuple):
    """The deck of a command that takes one, with the name of standard input, units and encoding from its options."""

    path: str
    stdin_name: str
    units: str | None
    encoding: str = ""

    def content(self) -> tuple[bytes, Input]:
        """Return the content of the file, and the file; ends the command if the path cannot be read."""
        if os.path.isdir(self.path):  # noqa: PTH112 - as above
            raise click.ClickException(f"{self.path} is a directory: this command takes one deck")
        file = _single(self.path, self.stdin_name)
        file = file._replace(encoding=self.encoding or Configured().encoding(file.place))
        with naming(self.path):
            return file.read(), file

    def load(self, form: str | None = None) -> Deck:
        """Return the deck; ends the command if the path cannot be read. Raises DeckError."""
        data, file = self.content()
        from mudline.api import Deck  # noqa: PLC0415 - what only looks for files reads no deck
        from mudline.language.deck.loading import load_bytes  # noqa: PLC0415 - as above

        deck = load_bytes(data, file.name, form=form, units=self.units, folder=file.folder)
        reading_named_files(deck)
        return Deck(**vars(deck))


def reading_named_files(deck: model.Deck) -> None:
    """Record all files that a deck names as read, even if the command does not open them; raises OverwriteError."""
    if outputs():
        from mudline.model.scene.deck_values import missing_files  # noqa: PLC0415 - most commands write no file
        from mudline.model.scene.restart import decks_before  # noqa: PLC0415 - as above

        deque(missing_files(deck, deck.names()), 0)  # records each file that is searched
        decks_before(deck)


class GivenDecks(NamedTuple):
    """The decks of a command: paths, and the name of standard input, units and encoding from its options."""

    paths: tuple[str, ...]
    every_file: bool = False
    stdin_name: str = "<stdin>"
    units: str | None = None
    encoding: str = ""

    def collect(
        self,
        wanted: Wanted = is_deck,
        *,
        configured: Configured | None = None,
        skipped: list[str] | None = None,
        force_exclude: bool = False,
    ) -> Inputs:
        """Return the given files; directories are searched for wanted files, in sorted order; `-` is standard input.

        Paths that exist but cannot be inspected are included, and reported when read: no deck passes unseen. Files of a
        directory are left out if its `.gitignore` files hide them, unless `every_file` is set, or if the configuration
        excludes them. With `force_exclude` the configuration also excludes files given by name. `skipped` receives a
        line, with the reason, for each file of a searched directory that is not taken.
        """
        own, inputs, files = configured or Configured(), Inputs(), list[Input]()

        def taken(path: str) -> bool:
            is_taken = own.takes(path, wanted)
            if not is_taken and skipped is not None:
                skipped.append(f"{_slashed(path)}: skipped, {_why_skipped(path)}")
            return is_taken

        for given in self.paths:
            if os.path.isdir(given):  # noqa: PTH112 - Path raises for a name that is too long or may not be looked at
                files += _below(Search(given, not self.every_file), inputs, taken)
            elif given == STDIN or not (force_exclude and own.excludes(given)):
                files.append(_single(given, self.stdin_name))
        for file in dict.fromkeys(files):
            inputs.files.append(file._replace(encoding=self.encoding or own.encoding(file.place)))
            if file.path is not None:
                reading(file.path)
        return inputs


def takes_decks(metavar: str = "PATHS...", *, stdin: bool = True, units: bool = True) -> options.Adding:
    """Add the decks, the options about them and the common options; they reach the command as `decks`, a GivenDecks."""
    return options.gathered(
        "decks",
        GivenDecks,
        click.argument("paths", nargs=-1, required=True, metavar=metavar, shell_complete=options.complete_files),
        options.every_file,
        *[options.stdin_name] * stdin,
        *[options.units] * units,
        options.encoding,
        options.common,
    )


takes_deck = options.gathered(
    "deck",
    GivenDeck,
    click.argument("path", metavar="DECK", shell_complete=options.complete_files),
    options.stdin_name,
    options.units,
    options.encoding,
    options.common,
)
"""Decorator that adds DECK, the options about it and the common options; the deck reaches the command as `deck`."""


# --------------------------------------------------------------------------------------------- each of many files


def many_files(
    inputs: Inputs,
    prepared: Callable[[Input], tuple[_Item, tuple[*_Given] | None]],
    work: Callable[[*_Given], _Made],
    view: View,
    *,
    jobs: int,
    scheduler: str | None = None,
    bar: bool = True,
) -> Generator[tuple[_Item, _Made | None], None, None]:
    """Yield an item for each file with the result of `work`, run here, in other processes or by a scheduler's workers.

    `prepared` returns the item of a file and the arguments of `work`, or None if there is no work. It is called when
    the file is due, and raises OSError if the file cannot be read. Files that cannot be read, or for which the program
    itself fails, are reported and left out; `inputs` records them and the exit code. A `bar` shows a long run. Close
    the generator to end the processes as soon as the command ends. Raises RunError.
    """

    def items() -> Iterator[tuple[tuple[Input, _Item], tuple[*_Given] | None]]:
        for file in inputs.files:
            try:
                item, given = prepared(file)
            except OSError as error:
                inputs.unreadable(file, error)
                progress.advance()
            else:
                yield (file, item), given

    with (
        Progress(len(inputs.files), view, shown=bar) as progress,
        closing(many(work, items(), len(inputs.files), jobs, scheduler)) as results,
    ):
        for (file, item), result in results:
            if isinstance(result, Crash):
                inputs.undone[file] = f"internal error: {result.summary}"
                inputs.fail(f"{file.name}: internal error, please report it: {result.summary}")
                if view.verbose:
                    notify(result.traceback)
            else:
                yield item, result
            progress.advance()


def each_deck(
    inputs: Inputs, work: Callable[[Input, bytes], _Made], view: View, *refusals: type[Exception]
) -> Iterator[tuple[Input, bytes, _Made | None]]:
    """Yield each deck with its content and the result of `work`, made here, one after the other.

    The result is None for a deck that `work` refuses by a DeckError, or by another of `refusals`; it is reported.
    """

    def prepared(file: Input) -> tuple[tuple[Input, bytes], tuple[Input, bytes]]:
        given = file, file.read()
        return given, given

    refusing: tuple[type[Exception], ...] = (DeckError, *refusals)

    def tried(file: Input, data: bytes) -> _Made | Exception:
        try:
            return work(file, data)
        except refusing as error:
            return error

    with closing(many_files(inputs, prepared, tried, view, jobs=1)) as results:
        for (file, data), made in results:
            if not isinstance(made, Exception):
                yield file, data, made
                continue
            if not isinstance(made, DeckError):
                line = getattr(made, "line", None)
                notify(f"{file.name}{f':{line}' if line else ''}: {made}")
            notify_diagnostics(getattr(made, "diagnostics", ()))
            yield file, data, None
