"""Standard output and error, messages for people, and files that a command writes."""

from __future__ import annotations

import io
import json
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import BinaryIO

import click

from mudline.basics.files import reason, replacement
from mudline.basics.installed import install_hint
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.overwriting import claim
from mudline.checks.output import visible, visible_lines
from mudline.language.diagnostics import Diagnostic
from mudline.language.syntax.source import Source


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


def json_rows(head: Mapping[str, object], name: str, rows: Iterable[str]) -> Iterator[str]:
    """Yield a JSON object up to the end of its last value, a list called `name` of rows in JSON, each on a new line."""
    mark = json.dumps({**head, name: []}, indent=1, ensure_ascii=False).removesuffix("]\n}")
    for row in rows:
        yield f"{mark}\n  {row}"
        mark = ","
    yield "\n ]" if mark == "," else f"{mark}]"


def emit_deck(data: bytes) -> None:
    """Write a deck to standard output, byte for byte except on a terminal."""
    if sys.stdout.isatty():
        emit([Source.from_bytes(data, "").text])
    else:
        _write([data])


def _write(pieces: Iterable[bytes]) -> None:
    if sys.stdout.isatty():
        erase()
    sys.stdout.flush()
    for piece in pieces:
        rest = memoryview(piece)
        while rest:  # an unbuffered stream may accept only a part
            rest = rest[sys.stdout.buffer.write(rest) :]


def encoded(text: str) -> bytes:
    """Return a text as UTF-8; half a surrogate pair, as a file name may hold, is escaped."""
    return text.encode("utf-8", "backslashreplace")


# -------------------------------------------------------------------------------------------------- standard error


DRAWN: list[Callable[[], None]] = []
"""Erase what is drawn on the terminal for a moment, as the bar of a long run; called before anything is printed."""


def erase() -> None:
    """Erase what is drawn for a moment."""
    for each in DRAWN:
        each()


def notify(message: str) -> None:
    """Print a note or an error to standard error."""
    erase()
    click.echo(f"mudline: {visible_lines(message)}", err=True)


def notify_some(messages: Sequence[str], more: str) -> None:
    """Print the first of many notes, and a last one with the number of the others in place of {} in `more`."""
    for message in messages[:SHOWN_ROWS]:
        notify(message)
    if len(messages) > SHOWN_ROWS:
        notify(more.format(len(messages) - SHOWN_ROWS))


def notify_diagnostics(diagnostics: Sequence[Diagnostic], *, refused: bool = True) -> None:
    """Print the errors that make a deck unusable, or, unless `refused`, findings with their severity."""
    if diagnostics:
        erase()
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
