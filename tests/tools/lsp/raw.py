"""A server as a process, spoken to in bytes: also in ways in which no editor speaks."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import IO, Any, cast

import pytest

from tests.helpers.processes import TIMEOUT
from tests.tools.lsp.command import server_command

pytest.importorskip("pygls", reason="pygls is not installed")

Message = dict[str, Any]


_PATIENCE = 10.0
"""Seconds in which a server whose input is closed should end."""


class RawClient:
    """The two pipes of a server."""

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        self.process = process
        self.stdin = cast("IO[bytes]", process.stdin)
        self.stdout = cast("IO[bytes]", process.stdout)
        self.number = 0
        self.notifications: list[Message] = []

    def write(self, data: bytes) -> None:
        self.stdin.write(data)
        self.stdin.flush()

    def body(self, data: bytes) -> None:
        self.write(b"Content-Length: %d\r\n\r\n%s" % (len(data), data))

    def send(self, **message: object) -> None:
        self.body(json.dumps({"jsonrpc": "2.0", **message}).encode())

    def notify(self, method: str, params: object = None) -> None:
        self.send(method=method, params=params)

    def read(self) -> Message:
        length = 0
        while line := self.stdout.readline():
            name, _, value = line.partition(b":")
            if name == b"Content-Length":
                length = int(value)
            if not line.strip():
                return cast("Message", json.loads(self.stdout.read(length)))
        raise AssertionError("the server has ended")

    def ask(self, method: str, params: object = None) -> Any:  # noqa: ANN401 - an answer is what it is
        """The result of a request, or its error; notifications that come before it are kept."""
        self.number += 1
        self.send(id=self.number, method=method, params=params)
        return self.answer(self.number)

    def answer(self, number: object) -> Any:  # noqa: ANN401 - as above
        while True:
            message = self.read()
            if message.get("id") == number and "method" not in message:
                return message.get("result", message.get("error"))
            self.notifications.append(message)

    def findings(self, uri: str) -> list[Message]:
        """What is shown for a document next."""
        while True:
            message = self.read()
            if message.get("method") == "textDocument/publishDiagnostics" and message["params"]["uri"] == uri:
                return cast("list[Message]", message["params"]["diagnostics"])
            self.notifications.append(message)

    def begin(self, **capabilities: object) -> Message:
        params = {"processId": None, "rootUri": None, "capabilities": capabilities}
        return cast("Message", self.ask("initialize", params))

    def open(self, uri: str, text: str, version: int = 1) -> None:
        item = {"uri": uri, "languageId": "mudline", "version": version, "text": text}
        self.notify("textDocument/didOpen", {"textDocument": item})

    def lives(self) -> bool:
        """Whether the server still checks decks."""
        self.open("untitled:alive", "$MODLE\n")
        return [one["code"] for one in self.findings("untitled:alive")] == ["SYN010"]

    def end(self) -> int:
        self.ask("shutdown")
        self.notify("exit")
        return self.process.wait(TIMEOUT)


@contextmanager
def raw_client() -> Iterator[RawClient]:
    process = subprocess.Popen(server_command(), stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        yield RawClient(process)
    finally:
        cast("IO[bytes]", process.stdin).close()
        try:
            process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
        process.wait(TIMEOUT)
        for stream in (process.stdin, process.stdout, process.stderr):
            with suppress(BrokenPipeError):
                cast("IO[bytes]", stream).close()
