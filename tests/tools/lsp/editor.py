"""An editor: it opens and changes decks in a server, and waits for what is shown of them."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

from lsprotocol import types
from pytest_lsp import LanguageClient

T = TypeVar("T")
SECONDS = 30.0
"""That an answer may take on a busy machine."""


def position(text: str, mark: str, behind: str = "") -> types.Position:
    """The place of a piece of a text, or behind a part of it, in characters of the basic plane."""
    at = text.index(mark) + len(behind)
    return types.Position(text.count("\n", 0, at), at - text.rfind("\n", 0, at) - 1)


def document(uri: str) -> types.TextDocumentIdentifier:
    return types.TextDocumentIdentifier(uri)


def applied(text: str, edits: list[types.TextEdit]) -> str:
    """A text of LF lines in the basic plane with edits made."""
    starts = [0]
    for line in text.split("\n"):
        starts.append(starts[-1] + len(line) + 1)

    def offset(place: types.Position) -> int:
        return min(starts[place.line] + place.character, len(text))

    for edit in sorted(edits, key=lambda edit: (edit.range.start.line, edit.range.start.character), reverse=True):
        text = text[: offset(edit.range.start)] + edit.new_text + text[offset(edit.range.end) :]
    return text


@dataclass
class Editor:
    """An editor with a folder of its own."""

    client: LanguageClient
    folder: Path
    opened: set[str] = field(default_factory=set)

    def uri(self, name: str) -> str:
        return (self.folder / name).as_uri()

    async def shown(self, uri: str, act: Callable[[], object]) -> list[types.Diagnostic]:
        """The findings that are shown for a document after an action."""
        self.client.diagnostics.pop(uri, None)
        act()
        end = time.monotonic() + SECONDS
        while uri not in self.client.diagnostics:
            assert time.monotonic() < end, f"nothing is shown for {uri}"
            await asyncio.sleep(0.005)
        return list(self.client.diagnostics[uri])

    async def open(self, text: str, name: str = "deck.keyxm", version: int = 1) -> str:
        """Open a deck, which is in a file too, and wait until it is checked; returns its address."""
        uri = self.uri(name)
        (self.folder / name).write_text(text, encoding="utf-8", newline="")
        await self.shown(uri, lambda: self.send_open(uri, text, version))
        return uri

    def close_all(self) -> None:
        for uri in self.opened:
            self.client.text_document_did_close(types.DidCloseTextDocumentParams(document(uri)))

    def send_open(self, uri: str, text: str, version: int = 1, language: str = "mudline") -> None:
        self.opened.add(uri)
        item = types.TextDocumentItem(uri, language, version, text)
        self.client.text_document_did_open(types.DidOpenTextDocumentParams(item))

    def send_change(self, uri: str, version: int, *changes: tuple[types.Position, types.Position, str] | str) -> None:
        events: list[types.TextDocumentContentChangeEvent] = [
            types.TextDocumentContentChangeWholeDocument(change)
            if isinstance(change, str)
            else types.TextDocumentContentChangePartial(types.Range(change[0], change[1]), change[2])
            for change in changes
        ]
        params = types.DidChangeTextDocumentParams(types.VersionedTextDocumentIdentifier(version, uri), events)
        self.client.text_document_did_change(params)

    async def change(
        self, uri: str, version: int, *changes: tuple[types.Position, types.Position, str] | str
    ) -> list[types.Diagnostic]:
        """Change a deck and wait until that version is checked."""
        return await self.shown(uri, lambda: self.send_change(uri, version, *changes))


def codes(found: list[types.Diagnostic]) -> list[str]:
    return [str(one.code) for one in found]
