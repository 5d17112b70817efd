"""Standard output and error, notes and errors for people, and files that a command writes."""

from __future__ import annotations

import io
import json
import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

import click

from mudline.basics.installed import install_hint
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.overwriting import claim
from mudline.basics.short_repr import counted as counted  # noqa: PLC0414 - commands that print findings take it here
from mudline.checks.output import visible, visible_lines
from mudline.language.diagnostics import Diagnostic
from mudline.language.syntax.source import Source


def prepare() -> None:
    """Escape what the terminal's encoding lacks; a stream that was closed before the start takes everything."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            nowhere = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115 - open as long as the process
            setattr(sys, name, nowhere)
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def drop() -> None:
    """Nobody reads any more: what is still in the buffers must not raise again when the interpreter ends."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        with suppress(io.UnsupportedOperation):  # a stream of a program that runs the command in itself
            os.dup2(nowhere, stream.fileno())
    os.close(nowhere)


# ------------------------------------------------------------------------------------------------- standard output


def emit(pieces: Iterable[str]) -> None:
    """Write a machine format to standard output: UTF-8 with LF line ends, whatever the terminal is set to.

    On a terminal, what could act on it is replaced; a pipe or a file gets the text as it is.
    """
    terminal = sys.stdout.isatty()
    _write(encoded(visible_lines(piece) if terminal else piece) for piece in pieces)


def emit_json(value: object, output: str | None = None) -> None:
    """Write a value as JSON to standard output, or into a file."""
    pieces = [json.dumps(value, indent=1, ensure_ascii=False, allow_nan=False), "\n"]
    if output is None:
        emit(pieces)
    else:
        write_text(Path(output), pieces)


def emit_deck(data: bytes) -> None:
    """Write a deck to standard output, byte for byte unless that is a terminal."""
    if sys.stdout.isatty():
        emit([Source.from_bytes(data, "").text])
    else:
        _write([data])


def _write(pieces: Iterable[bytes]) -> None:
    sys.stdout.flush()
    for piece in pieces:
        rest = memoryview(piece)
        while rest:  # an unbuffered stream may take less than it is given
            rest = rest[sys.stdout.buffer.write(rest) :]


def encoded(text: str) -> bytes:
    """UTF-8; half a surrogate pair, as a file name may hold, is escaped."""
    return text.encode("utf-8", "backslashreplace")


# -------------------------------------------------------------------------------------------------- standard error


def notify(message: str) -> None:
    """Print a note or an error on standard error."""
    click.echo(f"mudline: {visible_lines(message)}", err=True)


def notify_diagnostics(diagnostics: Sequence[Diagnostic], *, refused: bool = True) -> None:
    """Print why a deck cannot be used, as errors whatever they are to lint; else findings with their severity."""
    for found in diagnostics[:SHOWN_ROWS]:
        place = visible(f"{found.file}:{found.line}:{found.column}")
        severity = "error" if refused else found.severity.value
        click.echo(f"{place}: {severity}: {found.code} {visible(found.message)}", err=True)
    if len(diagnostics) > SHOWN_ROWS:
        what = "errors" if refused else "new findings"
        notify(f"{len(diagnostics) - SHOWN_ROWS} more {what}: mudline lint shows all")


def notify_missing(what: str, library: str, extra: str) -> None:
    """Print which extra brings a library that is not installed."""
    notify(f"{what} needs {library}: {install_hint(extra)}")


def reason(error: OSError) -> str:
    """Why a file could not be read or written, in words."""
    return (error.strerror or str(error)).lower()


# ----------------------------------------------------------------------------------------------------------- files


class UnwrittenError(click.ClickException):
    """A file cannot be written; what was there before still is."""


@contextmanager
def writing(path: Path, *, synced: bool = True) -> Iterator[BinaryIO]:
    """A stream whose content becomes the file in one step; ends the command when that is not possible.

    What is not `synced` is not waited for until it is on the disk, as in `replacement`. Raises OverwriteError for a
    file that the run reads.
    """
    from mudline.basics.files import replacement  # noqa: PLC0415 - help and faults of usage write no file

    claim(path)
    try:
        with replacement(path, synced=synced) as stream:
            yield stream
    except OSError as error:
        raise UnwrittenError(f"{path}: cannot be written: {reason(error)}") from error


def make_folder(path: Path) -> None:
    """Make a folder and those above it; ends the command for one that cannot be made."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise click.ClickException(f"{path.as_posix()}: cannot be created: {reason(error)}") from error


def write_bytes(path: Path, data: bytes) -> None:
    """Write a file's content."""
    with writing(path) as stream:
        stream.write(data)


def write_text(path: Path, pieces: Iterable[str]) -> None:
    """Write a text in pieces, as UTF-8."""
    with writing(path) as stream:
        stream.writelines(encoded(piece) for piece in pieces)
