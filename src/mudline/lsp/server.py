"""The server: its messages, open decks, and their checks when they or the decks that they depend on change."""

from __future__ import annotations

import asyncio
from collections.abc import Generator
from pathlib import Path
from typing import Any, cast

from lsprotocol import types
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol, lsp_method

from mudline import __version__
from mudline.deck.forms import SUFFIXES
from mudline.limits import LARGEST_OPEN
from mudline.lsp import findings
from mudline.lsp.decks import Analysis, Decks
from mudline.lsp.documents import Document, file_of


class DeckProtocol(LanguageServerProtocol):
    """The protocol of pygls with our own documents."""

    @property
    def documents(self) -> DeckServer:
        """The server, which has the open documents."""
        return cast("DeckServer", self._server)

    @lsp_method(types.INITIALIZE)
    def lsp_initialize(self, params: types.InitializeParams) -> Generator[Any, Any, types.InitializeResult]:
        """Begin: the position encoding is agreed."""
        result = yield from super().lsp_initialize(params)
        self.documents.begin(result.capabilities.position_encoding or types.PositionEncodingKind.Utf16)
        return result

    @lsp_method(types.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: types.DidOpenTextDocumentParams) -> None:
        """Take up a document."""
        self.documents.opened(params.text_document)

    @lsp_method(types.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(self, params: types.DidChangeTextDocumentParams) -> None:
        """Change a document."""
        self.documents.changed(params)

    @lsp_method(types.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(self, params: types.DidCloseTextDocumentParams) -> None:
        """Forget a document."""
        self.documents.closed(params.text_document.uri)


# ----------------------------------------------------------------------------------------------------------- open decks

DELAY = 0.1
"""Seconds without a change after which a deck is checked."""
_DELAY_AT_MOST = 3.0
_PAUSE = 2.0
"""How many times as long as its last check a pause in typing has to be."""

CONFIGURATION = ".toml"
"""The suffix of configurations, and of what they extend."""
_WATCHED = tuple(f"*{suffix}" for suffix in (*SUFFIXES, ".fcsbd", ".txt", CONFIGURATION))


class DeckServer(LanguageServer):
    """Open decks and the checks that are due."""

    def __init__(self) -> None:
        super().__init__("mudline", __version__, protocol_cls=DeckProtocol)
        self.decks = Decks()
        self._due: dict[str, asyncio.TimerHandle] = {}
        self._waiting: dict[str, list[asyncio.Future[None]]] = {}

    # ------------------------------------------------------------------------------------------------ documents

    def begin(self, encoding: types.PositionEncodingKind | str) -> None:
        """Take note of what was agreed."""
        self.decks = Decks(encoding.value if isinstance(encoding, types.PositionEncodingKind) else encoding)
        asyncio.get_running_loop().set_exception_handler(self._unexpected)

    def opened(self, item: types.TextDocumentItem) -> None:
        """Take up a document and check it at once."""
        document = self.decks.open(item.uri, item.text, item.version, str(item.language_id))
        self._show_limits(document)
        self._schedule(item.uri, 0.0)
        self._touch(document)

    def changed(self, params: types.DidChangeTextDocumentParams) -> None:
        """Change a document, unless the change is older than its text."""
        document = self.decks.documents.get(params.text_document.uri)
        if document is None or params.text_document.version < document.version:
            return
        was_large = document.is_too_large
        for change in params.content_changes:
            if isinstance(change, types.TextDocumentContentChangePartial):
                document.change(change.range, change.text)
            else:
                document.replace(change.text)
        document.version = params.text_document.version
        if document.is_too_large != was_large:
            self._show_limits(document)
        self._schedule(document.uri, self._delay(document))
        self._touch(document)

    def closed(self, uri: str) -> None:
        """Forget a document; its findings go with it, and other decks read its file again."""
        document = self.decks.close(uri)
        if document is None:
            return
        if (timer := self._due.pop(uri, None)) is not None:
            timer.cancel()
        self._wake(uri)
        self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, []))
        self._touch(document)

    def files_changed(self, changes: list[types.FileEvent]) -> None:
        """Check again what depends on files that were changed by others."""
        paths = [path for change in changes if (path := file_of(change.uri)) is not None]
        if any(path.suffix == CONFIGURATION for path in paths):
            self.decks.forget_configurations()
            for uri in self.decks.documents:
                self._schedule(uri, DELAY)
            return
        for path in paths:
            self._recheck(path)

    def _touch(self, document: Document) -> None:
        if document.path is not None:
            self._recheck(document.path, document.uri)

    def _recheck(self, path: Path, but: str = "") -> None:
        """Check the decks that depend on a file."""
        for uri in [uri for uri in self.decks.dependents(path) if uri != but]:
            self.decks.forget(uri)
            self._schedule(uri, DELAY)

    def _show_limits(self, document: Document) -> None:
        """Say once, when a long deck is opened, what is not done for it."""
        size = f"{document.name.rpartition('/')[2]} has {len(document.text) / 1e6:.0f} million characters"
        if document.is_too_large:
            self._show(f"{size}, and more than {LARGEST_OPEN // 10**6} million are not checked here: use mudline lint")
        elif document.is_long:
            self._show(f"{size}: it is checked when typing pauses, and rows of long tables get no colours and no hints")

    def _show(self, message: str, kind: types.MessageType = types.MessageType.Info) -> None:
        self.window_show_message(types.ShowMessageParams(kind, message))

    @property
    def resolves_edits(self) -> bool:
        """Whether the editor asks for the edits of an action when it needs them."""
        document = self.client_capabilities.text_document
        support = document.code_action.resolve_support if document and document.code_action else None
        return support is not None and "edit" in support.properties

    @property
    def takes_snippets(self) -> bool:
        """Whether the editor takes texts with places to fill in."""
        item = self._completion_items
        return bool(item and item.snippet_support)

    @property
    def _completion_items(self) -> types.ClientCompletionItemOptions | None:
        """What the editor can do with items of a completion."""
        document = self.client_capabilities.text_document
        return document.completion.completion_item if document and document.completion else None

    def watch_files(self) -> None:
        """Ask the editor to report changes of decks, of files that they name, and of configurations."""
        workspace = self.client_capabilities.workspace
        watching = workspace.did_change_watched_files if workspace else None
        if watching and watching.dynamic_registration:
            watchers = [types.FileSystemWatcher(f"**/{pattern}") for pattern in _WATCHED]
            options = types.DidChangeWatchedFilesRegistrationOptions(watchers)
            method = types.WORKSPACE_DID_CHANGE_WATCHED_FILES
            registration = types.Registration("mudline.watch", method, options)
            self.client_register_capability(types.RegistrationParams([registration]))

    # --------------------------------------------------------------------------------------------------- checks

    def _delay(self, document: Document) -> float:
        last = self.decks.last(document.uri)
        return min(max(DELAY, _PAUSE * last.seconds), _DELAY_AT_MOST) if last else DELAY

    def _schedule(self, uri: str, delay: float) -> None:
        """Check a document when nothing has changed for some time; an older plan is dropped."""
        if (timer := self._due.get(uri)) is not None:
            timer.cancel()
        self._due[uri] = asyncio.get_running_loop().call_later(delay, self._check, uri)

    def _check(self, uri: str) -> None:
        """Show the findings of a document as it is now."""
        self._due.pop(uri, None)
        try:
            found = self.decks.analysis(uri)
            if found is not None:
                document = found.document
                self.text_document_publish_diagnostics(
                    types.PublishDiagnosticsParams(uri, findings.shown(found), document.version)
                )
        finally:
            for message in self.decks.faults:
                self._show(message, types.MessageType.Warning)
            self.decks.faults.clear()
            self._wake(uri)

    def _wake(self, uri: str) -> None:
        """Let the requests go on that wait for a document to be checked."""
        for waiting in self._waiting.pop(uri, ()):
            if not waiting.done():
                waiting.set_result(None)

    async def analysis(self, uri: str) -> Analysis | None:
        """The analysis of a document as it is now; that of a long one when it has been checked."""
        document = self.decks.documents.get(uri)
        while document is not None and document.is_long and uri in self._due:
            waiting = asyncio.get_running_loop().create_future()
            self._waiting.setdefault(uri, []).append(waiting)
            await waiting
        return self.decks.analysis(uri)

    def _unexpected(self, _: object, context: dict[str, Any]) -> None:
        """Report a fault of the server itself, which goes on."""
        error = context.get("exception")
        detail = f"{type(error).__name__}: {error}" if error else context.get("message", "")
        message = f"{str(detail)[:500]}: please report this fault of mudline"
        self.window_log_message(types.LogMessageParams(types.MessageType.Error, message))

    def report_server_error(self, error: Exception, source: type[Exception]) -> None:
        """Note what could not be handled in the editor's log; requests were answered with it already."""
        message = str(error)[:500] or type(error).__name__
        self.window_log_message(types.LogMessageParams(types.MessageType.Log, f"{source.__name__}: {message}"))
