"""Sessions of an editor with the server, in this process: what is typed and asked follows from the bytes of an input.

A model of the text, kept as editors keep it, says what the server should have at the end. Among the messages are some
twice, some too old, and some that no editor sends.
"""

from __future__ import annotations

import asyncio
import json
import random
import re
import threading
from collections import Counter
from copy import deepcopy
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any

from pygls.io_ import run_async

import mudline
from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from mudline.tools.lsp.decks import OpenDocument
from mudline.tools.lsp.server import DeckServer, quiet_logs, register

_PATIENCE = 60.0
"""Seconds of a session: an answer that never comes would be waited for without end."""
_DECK = "untitled:deck.keyxm"
_OTHERS = ("untitled:x", "file:///nowhere/deck.keyxm", "file:///nowhere/deck.yaml", "file:///%00", "http://x", "")
_LINE_END = re.compile("\r\n?|\n")
_INTERNAL = -32603
_OWN = Path(mudline.__file__).parent.as_posix()
"""In a traceback that passed through this program: its checkout may be called mudline, too."""
_AT = ("hover", "completion", "definition", "references", "documentHighlight", "prepareRename", "rename")
_OF_DECK = ("documentSymbol", "foldingRange", "formatting", "inlayHint", "codeAction")
_CONTEXT: dict[str, dict[str, object]] = {"references": {"includeDeclaration": True}, "codeAction": {"diagnostics": []}}
_EDGES: tuple[object, ...] = (None, -1, 2**31, 1e308, "", "x" * 1000, [], {}, True, [[[]]], {"uri": 1}, *_OTHERS)
_TYPED = (
    *("", "\n", "\r", "\r\n", "$", " ", "1", ",", "=[p]", "\U0001f600", "\ud800", "\udc00", "é"),
    "C mudline: ignore\n",
)


class _Input:
    """What an editor writes."""

    def __init__(self, data: bytes) -> None:
        self._data = BytesIO(data)

    async def readline(self) -> bytes:
        return self._data.readline()

    async def readexactly(self, size: int) -> bytes:
        return self._data.read(size)


class _Server(DeckServer):
    """A server that checks at once."""

    def _schedule(self, document: OpenDocument, delay: float = 0.0) -> None:
        super()._schedule(document, 0.0 * delay)


@cache
def _server() -> _Server:
    """One for all sessions: each begins anew."""
    quiet_logs()
    server = _Server()
    register(server)
    return server


class Session:
    """Messages of an editor in some bursts, and what comes back."""

    def __init__(self, data: bytes) -> None:
        self.random = random.Random(data)  # noqa: S311 - repeatable, no secret
        self.text = _as_sent(data.decode(errors="surrogateescape").lstrip("\ufeff"))
        self.version = 1
        self.sent: dict[int, list[str]] = {}
        self.burst = b""
        self.received: list[dict[str, Any]] = []
        self.server = _server()

    # --------------------------------------------------------------------------------------------------------- messages

    def write(self, data: bytes) -> None:
        """The server writes a message."""
        self.received.append(json.loads(data))

    def close(self) -> None:
        """The server ends."""

    def send(self, method: str, params: object, number: int = 0) -> None:
        body = {"jsonrpc": "2.0", "method": method, "params": params} | ({"id": number} if number else {})
        self.raw(json.dumps(body).encode())

    def raw(self, body: bytes) -> None:
        self.burst += b"Content-Length: %d\r\n\r\n%s" % (len(body), body)

    def open(self, uri: str, text: str) -> None:
        item = {"uri": uri, "languageId": "mudline", "version": self.version, "text": text}
        self.send("textDocument/didOpen", {"textDocument": item})

    def position(self) -> dict[str, int]:
        lines = len(_LINE_END.findall(self.text)) + 1
        line = self.random.choice((self.random.randrange(lines + 1), self.random.randrange(lines), 2**31 - 1))
        return {"line": line, "character": self.random.choice((0, self.random.randrange(12), 2**31 - 1))}

    def changed(self) -> None:
        """One change or several of the deck; the version may be an old one, whose changes are left out."""
        version = self.version + self.random.choice((1, 1, 1, 0, -1, 5))
        changes: list[dict[str, object]] = []
        text = self.text
        for _ in range(self.random.choice((1, 1, 2, 3))):
            typed = self.random.choice((*_TYPED, self.text[: self.random.randrange(40)]))
            if self.random.random() < 0.05:
                changes.append({"text": typed})
                text = _as_sent(typed)
                continue
            places = [self.position(), self.position()] if self.random.random() < 0.5 else [self.position()] * 2
            changes.append({"range": {"start": places[0], "end": places[1]}, "text": typed})
            start, end = sorted(_offset(text, place) for place in places)
            text = text[:start] + _as_sent(typed) + text[end:]
        self.send(
            "textDocument/didChange", {"textDocument": {"uri": _DECK, "version": version}, "contentChanges": changes}
        )
        if version >= self.version:
            self.version, self.text = version, text

    def asked(self) -> None:
        """A request about the deck; some have the number of another one."""
        number = self.random.choice((len(self.sent) + 1, len(self.sent) + 1, 1))
        method, params = self.question(_DECK)
        self.sent.setdefault(number, []).append(method)
        self.send(method, params, number)

    def question(self, uri: str) -> tuple[str, dict[str, Any]]:
        """What is asked of a document."""
        what = self.random.choice((*_AT, *_OF_DECK))
        params: dict[str, object] = {"textDocument": {"uri": uri}}
        params["position"] = self.position()
        params["range"] = {"start": self.position(), "end": self.position()}
        params |= {
            "newName": self.random.choice(("n", "", "a b", "x" * 300)),
            "options": {"tabSize": 1, "insertSpaces": True},
        }
        if what in _CONTEXT:
            params["context"] = dict(_CONTEXT[what])
        return f"textDocument/{what}", params

    def odd(self) -> None:
        """A message about another document that no editor sends, or that is broken."""
        uri = self.random.choice(_OTHERS)
        edits: dict[str, Any] = {"textDocument": {"uri": uri, "version": 1}, "contentChanges": [{"text": "x"}]}
        method, params = self.random.choice((self.question(uri), ("textDocument/didChange", edits)))
        number: object = self.random.choice((-1, None, [], "x"))
        message = {"jsonrpc": "2.0", "method": method, "params": params, "id": number}
        for _ in range(self.random.choice((1, 1, 2))):
            _replace(message, self.random)
        body = json.dumps(message).encode()
        if self.random.random() < 0.3:
            at = self.random.randrange(len(body))
            body = body[:at] + bytes([self.random.randrange(256)]) * self.random.randrange(3) + body[at + 1 :]
        self.raw(body)

    def step(self) -> None:
        """A message or two."""
        kind = self.random.randrange(10)
        number = self.random.randrange(1, len(self.sent) + 2)
        if kind < 3:
            self.changed()
        elif kind < 6:
            self.asked()
        elif kind < 8:
            self.odd()
        elif kind == 8:
            self.send("$/cancelRequest", {"id": number})
            self.send("textDocument/didSave", {"textDocument": {"uri": _DECK}})
            changes = [{"uri": self.random.choice(_OTHERS), "type": 2}]
            self.send("workspace/didChangeWatchedFiles", {"changes": changes})
        else:
            self.open(self.random.choice(_OTHERS), self.text[:500])
            self.send("textDocument/didClose", {"textDocument": {"uri": self.random.choice((_DECK, *_OTHERS))}})
            self.open(_DECK, self.text)

    # ---------------------------------------------------------------------------------------------------------- session

    async def held(self) -> None:
        """The session; raises AssertionError where the server has another text, other findings or no answer."""
        self.server.protocol.set_writer(self, include_headers=False)
        support = {"resolveSupport": {"properties": ["edit"]}}
        capabilities = {"textDocument": {"codeAction": support}, "general": {"positionEncodings": ["utf-16"]}}
        self.send("initialize", {"processId": None, "rootUri": None, "capabilities": capabilities}, 10**6)
        self.open(_DECK, self.text)
        async with asyncio.timeout(_PATIENCE):
            for _ in range(self.random.choice((1, 2))):
                for _ in range(self.random.randrange(1, 6)):
                    self.step()
                await self._delivered()
            self.changed()
            await self._delivered()
        self._judge()

    async def _delivered(self) -> None:
        """The server reads what was written, and does what follows."""
        burst, self.burst = self.burst, b""
        stop = threading.Event()
        await run_async(stop, _Input(burst), self.server.protocol, error_handler=self.server.report_server_error)
        while others := asyncio.all_tasks() - {asyncio.current_task()}:
            await asyncio.wait(others)

    def _judge(self) -> None:
        document = self.server.decks.documents[_DECK]
        assert document.text == self.text, "the server has another text"
        shown = [one["params"] for one in self.received if one.get("method") == "textDocument/publishDiagnostics"]
        last = next(one for one in reversed(shown) if one["uri"] == _DECK)
        found = lint_bytes(self.text.encode(), document.name, select())
        codes = Counter(one["code"] for one in last["diagnostics"])
        assert codes == Counter(one.code for one in found), "the server shows other findings"
        answers = Counter(str(one["id"]) for one in self.received if "id" in one and "method" not in one)
        assert all(answers[str(number)] >= len(sent) for number, sent in self.sent.items()), "no answer"
        for one in self.received:
            error = one.get("error", {})
            assert error.get("code") != _INTERNAL or _OWN not in str(error), error
            assert "please report" not in str(one.get("params", "")), one["params"]


def edit(data: bytes) -> None:
    """A session that the bytes of an input describe."""
    session = Session(data)
    session.server._checks.clear()
    asyncio.run(session.held())


def _as_sent(text: str) -> str:
    """A text as a server takes it: halves of a pair are no characters."""
    return re.sub("[\ud800-\udfff]", "\ufffd", text)


def _offset(text: str, place: dict[str, int]) -> int:
    """The offset of a position, counted character by character."""
    starts = [0, *(found.end() for found in _LINE_END.finditer(text))]
    if place["line"] >= len(starts):
        return len(text)
    at = starts[place["line"]]
    units = place["character"]
    while at < len(text) and text[at] not in "\r\n" and (units := units - 1 - (text[at] > "\uffff")) >= 0:
        at += 1
    return at


def _replace(value: Any, by: random.Random) -> None:  # noqa: ANN401 - JSON
    """Put an edge value somewhere in a message."""
    while isinstance(value, dict | list) and value:
        key: Any = by.choice(list(value)) if isinstance(value, dict) else by.randrange(len(value))
        if key != "jsonrpc" and (by.random() < 0.3 or not isinstance(value[key], dict | list)):
            value[key] = deepcopy(by.choice(_EDGES))
            return
        value = value[key]
