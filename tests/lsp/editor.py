"""An editor: it opens and changes decks in a server, and waits for what is shown of them."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
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

    def uri(self, name: str) -> str:
        return (self.folder / name).as_uri()

    async def shown(self, uri: str, act: Callable[[], object], version: int | None = None) -> list[types.Diagnostic]:
        """The findings that are shown for a document, or for a version of it, after an action."""
        waiting = asyncio.ensure_future(self._published(uri, version))
        await asyncio.sleep(0)
        act()
        return await asyncio.wait_for(waiting, SECONDS)

    async def _published(self, uri: str, version: int | None) -> list[types.Diagnostic]:
        while True:
            given = await self.client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
            assert isinstance(given, types.PublishDiagnosticsParams)
            if given.uri == uri and version in (None, given.version):
                return list(given.diagnostics)

    async def open(self, text: str, name: str = "deck.keyxm", version: int = 1, *, saved: bool = True) -> str:
        """Open a deck, which is in a file too, and wait until it is checked; returns its address."""
        uri = self.uri(name)
        if saved:
            (self.folder / name).write_text(text, encoding="utf-8", newline="")
        await self.shown(uri, lambda: self.send_open(uri, text, version))
        return uri

    def send_open(self, uri: str, text: str, version: int = 1, language: str = "mudline") -> None:
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
        return await self.shown(uri, lambda: self.send_change(uri, version, *changes), version)


def codes(found: list[types.Diagnostic]) -> list[str]:
    return [str(one.code) for one in found]
