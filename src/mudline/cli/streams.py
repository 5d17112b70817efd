"""Standard output and error, messages for people, files that a command writes, settings of printing, progress."""

from __future__ import annotations

import io
import json
import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, BinaryIO, NamedTuple, TypeVar

import click

from mudline.basics.installed import install_hint
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.overwriting import claim
from mudline.basics.short_repr import counted as counted  # noqa: PLC0414 - commands that print findings take it here
from mudline.checks.output import visible, visible_lines
from mudline.language.diagnostics import Diagnostic
from mudline.language.syntax.source import Source

if TYPE_CHECKING:
    import rich.progress

    from mudline.cli.printing import Printer

T = TypeVar("T")


def prepare() -> None:
    """Make output escape characters that the terminal lacks; replace a closed stream by the null device."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            nowhere = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115 - open as long as the process
            setattr(sys, name, nowhere)
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def drop() -> None:
    """Redirect output to the null device, so that the remaining buffers raise no error when the interpreter ends."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        with suppress(io.UnsupportedOperation):  # the stream of a program that calls the command within its process
            os.dup2(nowhere, stream.fileno())
    os.close(nowhere)


# ------------------------------------------------------------------------------------------------- standard output


def say(text: str) -> None:
    """Print a line to standard output, in order with what is written there: click has an own buffer for ASCII."""
    sys.stdout.write(f"{text}\n")


def emit(pieces: Iterable[str]) -> None:
    """Write a machine format to standard output: UTF-8 with LF line ends, whatever the settings of the terminal.

    On a terminal control characters are replaced; a pipe or a file gets the text unchanged.
    """
    terminal = sys.stdout.isatty()
    _write(encoded(visible_lines(piece) if terminal else piece) for piece in pieces)


def emit_json(value: object, output: str | None = None) -> None:
    """Write a value as JSON to standard output, or into a file."""
    pieces = [json.dumps(value, indent=1, ensure_ascii=False, allow_nan=False), "\n"]
    if not output:
        emit(pieces)
    else:
        write_text(Path(output), pieces)


def emit_deck(data: bytes) -> None:
    """Write a deck to standard output, byte for byte except on a terminal."""
    if sys.stdout.isatty():
        emit([Source.from_bytes(data, "").text])
    else:
        _write([data])


def _write(pieces: Iterable[bytes]) -> None:
    sys.stdout.flush()
    for piece in pieces:
        rest = memoryview(piece)
        while rest:  # an unbuffered stream may accept only a part
            rest = rest[sys.stdout.buffer.write(rest) :]


def encoded(text: str) -> bytes:
    """Return a text as UTF-8; half a surrogate pair, as a file name may hold, is escaped."""
    return text.encode("utf-8", "backslashreplace")


# -------------------------------------------------------------------------------------------------- standard error


def notify(message: str) -> None:
    """Print a note or an error to standard error."""
    click.echo(f"mudline: {visible_lines(message)}", err=True)


def notify_some(messages: Sequence[str], more: str) -> None:
    """Print the first of many notes, and a last one with the number of the others in place of {} in `more`."""
    for message in messages[:SHOWN_ROWS]:
        notify(message)
    if len(messages) > SHOWN_ROWS:
        notify(more.format(len(messages) - SHOWN_ROWS))


def notify_diagnostics(diagnostics: Sequence[Diagnostic], *, refused: bool = True) -> None:
    """Print the errors that make a deck unusable, or, unless `refused`, findings with their severity."""
    for finding in diagnostics[:SHOWN_ROWS]:
        place = visible(f"{finding.file}:{finding.line}:{finding.column}")
        severity = "error" if refused else finding.severity.value
        click.echo(f"{place}: {severity}: {finding.code} {visible(finding.message)}", err=True)
    if len(diagnostics) > SHOWN_ROWS:
        what = "errors" if refused else "new findings"
        notify(f"{len(diagnostics) - SHOWN_ROWS} more {what}: mudline lint shows all")


def require(what: str, extra: str, *libraries: str) -> None:
    """End the command with the name of an extra that installs libraries, if one of these is missing."""
    if missing := [library for library in libraries if find_spec(library) is None]:
        raise click.ClickException(f"{what} needs {' and '.join(missing)}: {install_hint(extra)}")


def reason(error: OSError) -> str:
    """Return the reason why a file could not be read or written."""
    return (error.strerror or str(error)).lower()


# ----------------------------------------------------------------------------------------------------------- files


class UnwrittenError(click.ClickException):
    """Failure to write a file; its previous content remains."""


@contextmanager
def naming(path: object, fault: str = "", kind: type[click.ClickException] = click.ClickException) -> Iterator[None]:
    """End the command with a path, the fault and its reason if the block cannot read or write something."""
    try:
        yield
    except OSError as error:
        raise kind(f"{path}: {fault}{reason(error)}") from error


@contextmanager
def refusing(
    *kinds: type[Exception], before: str = "", kind: type[click.ClickException] = click.UsageError
) -> Iterator[None]:
    """End the command with the message of an error of these kinds, behind a text; as wrong usage, or another `kind`."""
    try:
        yield
    except kinds as error:
        raise kind(f"{before}{error}") from error


@contextmanager
def writing(path: Path, *, synced: bool = True) -> Iterator[BinaryIO]:
    """Open a file that is written in one step when the block ends; a failure ends the command.

    `synced` is as in `replacement`. Raises OverwriteError for a file that the run reads.
    """
    from mudline.basics.files import replacement  # noqa: PLC0415 - help and faults of usage write no file

    claim(path)
    with naming(path, "cannot be written: ", UnwrittenError), replacement(path, synced=synced) as stream:
        yield stream


def make_folder(path: Path) -> None:
    """Create a folder and its parents; a failure ends the command."""
    with naming(path.as_posix(), "cannot be created: "):
        path.mkdir(parents=True, exist_ok=True)


def write_bytes(path: Path, data: bytes) -> None:
    """Write a file's content."""
    with writing(path) as stream:
        stream.write(data)


def write_text(path: Path, pieces: Iterable[str]) -> None:
    """Write a text in pieces, as UTF-8."""
    with writing(path) as stream:
        stream.writelines(encoded(piece) for piece in pieces)


# --------------------------------------------------------------------------------------------- settings of printing

Part = str | tuple[str, str]
"""Piece of a line: a text, or a text and its style."""
Line = Sequence[Part]
"""Pieces of a line; a single text is not a line."""


class View(NamedTuple):
    """Settings of printing: colours ("auto", "always", "never"), less, or more."""

    color: str = "auto"
    quiet: bool = False
    verbose: bool = False

    def printer(self) -> Printer:
        """Return the printer for people."""
        from mudline.cli.printing import Printer  # noqa: PLC0415 - output for programs needs no rich

        return Printer(self.color)

    def lines(self, lines: Iterable[Line]) -> None:
        """Print lines for people; without terminal and colour rich is not loaded, as that takes half of a short run."""
        if self.color == "always" or sys.stdout.isatty():
            printer = self.printer()
            for line in lines:
                printer.line(*line)
        else:
            texts = ((part if isinstance(part, str) else part[0] for part in line) for line in lines)
            sys.stdout.writelines(f"{''.join(pieces)}\n" for pieces in texts)

    @property
    def most(self) -> int:
        """Largest number of rows of a table; -v shows all."""
        return sys.maxsize if self.verbose else SHOWN_ROWS

    @property
    def width(self) -> int | None:
        """Columns of the terminal; None without a terminal."""
        return self.printer().width if sys.stdout.isatty() else None

    def note(self, message: str) -> None:
        """Print a note to standard error, unless only the result is wanted."""
        if not self.quiet:
            notify(message)


# ------------------------------------------------------------------------------------------- progress of a long run

DELAY = 0.5
"""Seconds before a bar is drawn."""
_PAUSE = 0.1
"""Minimum seconds between two drawings."""


class Progress(AbstractContextManager["Progress"]):
    """Steps done out of a total, as a bar on standard error, which is hidden while anything else is printed.

    No bar is drawn in CI, or if standard error is not a terminal that can erase.
    """

    def __init__(self, total: int, view: View, *, shown: bool = True) -> None:
        self.view = view
        self._total = total
        self._done = 0
        self._bar: rich.progress.Progress | None = None
        dumb = os.environ.get("TERM", "").lower() in {"dumb", "unknown"}
        may_draw = sys.stderr.isatty() and not (view.quiet or dumb or os.environ.get("CI"))
        self._due = monotonic() + DELAY if shown and total > 1 and may_draw else float("inf")

    def __exit__(self, *_: object) -> None:
        self.hide()

    def advance(self, steps: int = 1) -> None:
        """Count one more step, or several."""
        self._done += steps
        if monotonic() >= self._due:
            if self._bar is None:
                from mudline.cli.printing import bar  # noqa: PLC0415 - large, and a bar is rare

                self._bar = bar(self._total, self.view.color)
            self._bar.update(self._bar.task_ids[0], completed=self._done)
            self._bar.start()
            self._bar.refresh()
            self._due = monotonic() + _PAUSE

    def hide(self) -> None:
        """Erase the bar so that other lines can be printed; a later step draws it again."""
        if self._bar:
            self._bar.stop()


def tracked(items: Sequence[T], view: View) -> Iterator[T]:
    """Yield the items, with a bar of the number done."""
    with Progress(len(items), view) as progress:
        for item in items:
            yield item
            progress.advance()
