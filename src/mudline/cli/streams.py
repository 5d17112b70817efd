"""Standard output and error: people's text in the terminal's encoding, machine formats in UTF-8, a closed pipe."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from mudline.linting.output.visible import visible_lines
from mudline.syntax.source import Source


def prepare() -> None:
    """Escape what the terminal's encoding lacks; a stream that was closed before the start takes everything."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            nowhere = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115 - open as long as the process
            setattr(sys, name, nowhere)
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def emit(pieces: Iterable[str]) -> None:
    """Write a machine format to standard output: UTF-8 with LF line ends, whatever the terminal is set to.

    On a terminal, what could act on it is replaced; a pipe or a file gets the text as it is.
    """
    sys.stdout.flush()
    for piece in pieces:
        text = visible_lines(piece) if sys.stdout.isatty() else piece
        rest = memoryview(encoded(text))
        while rest:  # an unbuffered stream may take less than it is given
            rest = rest[sys.stdout.buffer.write(rest) :]


def emit_deck(data: bytes) -> None:
    """Write a deck to standard output, byte for byte unless that is a terminal."""
    if sys.stdout.isatty():
        emit([Source.from_bytes(data, "").text])
        return
    sys.stdout.flush()
    rest = memoryview(data)
    while rest:  # an unbuffered stream may take less than it is given
        rest = rest[sys.stdout.buffer.write(rest) :]


def encoded(text: str) -> bytes:
    """UTF-8; half a surrogate pair, as a file name may hold, is escaped."""
    return text.encode("utf-8", "backslashreplace")


def drop() -> None:
    """Nobody reads any more: what is still in the buffers must not raise again when the interpreter ends."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        with suppress(io.UnsupportedOperation):  # a stream of a program that runs the command in itself
            os.dup2(nowhere, stream.fileno())
    os.close(nowhere)
