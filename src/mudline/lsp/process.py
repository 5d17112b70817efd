"""The process that an editor starts: it talks on standard input and output until it is ended."""

from __future__ import annotations

import logging
import sys
from typing import BinaryIO, cast

from mudline.lsp.features import register
from mudline.lsp.server import DeckServer

_LONGEST_HEADER = 8192
_LARGEST_MESSAGE = 1 << 30
"""Bytes of a message that is read; a longer one is passed over."""
_PIECE = 1 << 20


class Input:
    """Standard input, as the protocol reads it: it holds no more than a message of a sensible length."""

    def __init__(self, stream: BinaryIO) -> None:
        self.stream = stream

    def readline(self) -> bytes:
        """A line of a header."""
        return self.stream.readline(_LONGEST_HEADER)

    def read(self, length: int) -> bytes:
        """The body of a message; an empty object for one that is too long, nothing at the end."""
        if length <= _LARGEST_MESSAGE:
            return self.stream.read(length)
        while length > 0:
            piece = self.stream.read(min(length, _PIECE))
            if not piece:
                return b""
            length -= len(piece)
        return b"{}"


def quiet_logs() -> None:
    """Keep what pygls reports of messages that cannot be used, which may be of any length, off standard error."""
    logging.getLogger("pygls").setLevel(logging.CRITICAL)
    logging.getLogger("asyncio").setLevel(logging.CRITICAL)


def take_streams() -> tuple[BinaryIO, BinaryIO]:
    """Standard input and output of the protocol; what else is printed goes to standard error from now on."""
    streams = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr
    return streams


def serve() -> int:
    """Serve until the editor ends it; returns 0 where that was announced before, as the protocol asks, else 1."""
    quiet_logs()
    stdin, stdout = take_streams()
    server = DeckServer()
    register(server)
    server.start_io(cast("BinaryIO", Input(stdin)), stdout)
    return 0 if server.protocol._shutdown else 1  # noqa: SLF001 - pygls has no other way to ask
