"""Server: its messages, open decks with their checks, and each request with the module that answers it."""

from __future__ import annotations

import asyncio
import logging
import sys
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from pathlib import Path
from typing import Any, TypeVar, cast

from lsprotocol import types
from pygls.capabilities import get_capability
from pygls.exceptions import JsonRpcException, JsonRpcInvalidParams, JsonRpcInvalidRequest
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol, lsp_method

from mudline.basics.limits import LARGEST_OPEN
from mudline.basics.version import __version__
from mudline.language.deck.forms import SUFFIXES
from mudline.tools.lsp import completion, findings, structure
from mudline.tools.lsp.decks import Analysis, Decks, OpenDocument, file_of
from mudline.tools.lsp.help import hints, hover
from mudline.tools.lsp.navigation import Navigator

T = TypeVar("T")


class DeckProtocol(LanguageServerProtocol):
    """Protocol of pygls with the documents of this package."""

    @property
    def documents(self) -> DeckServer:
        """The server, which has the open documents."""
        return cast("DeckServer", self._server)

    def structure_message(self, data: dict[str, Any]) -> Any:  # noqa: ANN401 - as pygls
        """Return the message; a request with wrong parameters gets an answer, which pygls does not send."""
        try:
            return super().structure_message(data)
        except JsonRpcException:
            if "id" in data and "method" in data:
                self._send_response(data["id"], None, JsonRpcInvalidParams().to_response_error())
            raise

    def handle_message(self, message: Any) -> None:  # noqa: ANN401 - as pygls
        """Answer a message; a request after the shutdown is refused, which pygls leaves without an answer."""
        if self._shutdown and hasattr(message, "method") and hasattr(message, "id"):
            self._send_response(message.id, None, JsonRpcInvalidRequest().to_response_error())
            return
        super().handle_message(message)

    @lsp_method(types.INITIALIZE)
    def lsp_initialize(self, params: types.InitializeParams) -> Generator[Any, Any, types.InitializeResult]:
        """Begin; columns are counted in UTF-16, which every editor supports."""
        result = yield from super().lsp_initialize(params)
        result.capabilities.position_encoding = types.PositionEncodingKind.Utf16
        asyncio.get_running_loop().set_exception_handler(self.documents.unexpected)
        return result

    @lsp_method(types.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: types.DidOpenTextDocumentParams) -> None:
        """Add a document."""
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

DELAY = 0.02
"""Seconds without a change after which a deck is checked."""

CONFIGURATION = ".toml"
"""Suffix of configurations, and of the files that they extend."""
_WATCHED = tuple(f"*{suffix}" for suffix in (*SUFFIXES, ".fcsbd", ".txt", CONFIGURATION))


class DeckServer(LanguageServer):
    """Open decks and the latest check of each; checks are made one after the other in one thread."""

    def __init__(self) -> None:
        super().__init__("mudline", __version__, protocol_cls=DeckProtocol)
        self.decks = Decks()
        self._checks: dict[str, asyncio.Task[None]] = {}
        self._worker = ThreadPoolExecutor(1, "check")

    # ------------------------------------------------------------------------------------------------ documents

    def opened(self, item: types.TextDocumentItem) -> None:
        """Add a document and check it at once."""
        document = self.decks.open(item.uri, item.text, item.version, str(item.language_id))
        self._show_limits(document)
        self._schedule(document, 0.0)
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
        self._schedule(document)
        self._touch(document)

    def closed(self, uri: str) -> None:
        """Forget a document; its findings are removed, and other decks read its file again."""
        document = self.decks.close(uri)
        if document is None:
            return
        self._checks.pop(uri).cancel()
        self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, []))
        self._touch(document)

    def files_changed(self, changes: Sequence[types.FileEvent]) -> None:
        """Check the decks again that depend on files changed by other programs."""
        paths = [path for change in changes if (path := file_of(change.uri)) is not None]
        if any(path.suffix == CONFIGURATION for path in paths):
            self.decks.forget_configurations()
            for document in self.decks.documents.values():
                self._schedule(document)
            return
        for path in paths:
            self._recheck(path)

    def _touch(self, document: OpenDocument) -> None:
        if document.path is not None:
            self._recheck(document.path, document.uri)

    def _recheck(self, path: Path, but: str = "") -> None:
        """Check the decks that depend on a file, and decks whose dependencies are not known yet."""
        for uri, document in self.decks.documents.items():
            if uri != but and (not self._checks[uri].done() or self.decks.depends(uri, path)):
                self.decks.forget(uri)
                self._schedule(document)

    def _show_limits(self, document: OpenDocument) -> None:
        """Tell the user, when a long deck is opened, what is not done for it."""
        size = f"{document.name.rpartition('/')[2]} has {len(document.text) / 1e6:.0f} million characters"
        if document.is_too_large:
            self._show(f"{size}, and more than {LARGEST_OPEN // 10**6} million are not checked here: use mudline lint")
        elif document.is_long:
            self._show(f"{size}: help waits for its check, and its outline has no names")

    def _show(self, message: str, kind: types.MessageType = types.MessageType.Info) -> None:
        self.window_show_message(types.ShowMessageParams(kind, message))

    @property
    def resolves_edits(self) -> bool:
        """True if the editor requests the edits of an action only when it needs them."""
        return "edit" in get_capability(
            self.client_capabilities, "text_document.code_action.resolve_support.properties", []
        )

    @property
    def takes_snippets(self) -> bool:
        """True if the editor supports snippets."""
        field = "text_document.completion.completion_item.snippet_support"
        return bool(get_capability(self.client_capabilities, field))

    def watch_files(self) -> None:
        """Ask the editor to report changes of decks, of files that they name, and of configurations."""
        if get_capability(self.client_capabilities, "workspace.did_change_watched_files.dynamic_registration"):
            watchers = [types.FileSystemWatcher(f"**/{pattern}") for pattern in _WATCHED]
            options = types.DidChangeWatchedFilesRegistrationOptions(watchers)
            registration = types.Registration("mudline.watch", types.WORKSPACE_DID_CHANGE_WATCHED_FILES, options)
            self.client_register_capability(types.RegistrationParams([registration]))

    # --------------------------------------------------------------------------------------------------- checks

    def _schedule(self, document: OpenDocument, delay: float = DELAY) -> None:
        """Check a document after some time without changes; a check of an older text is dropped."""
        if (older := self._checks.get(document.uri)) is not None:
            older.cancel()
        self._checks[document.uri] = check = asyncio.create_task(self._check(document, delay))
        check.add_done_callback(_failed)

    async def _check(self, document: OpenDocument, delay: float) -> None:
        await asyncio.sleep(delay)
        begun = self.decks.begun(document)
        for message in self.decks.faults:
            self._show(message, types.MessageType.Warning)
        self.decks.faults.clear()
        analysis = await self.aside(begun.checked)
        self.decks.keep(analysis)
        self.text_document_publish_diagnostics(
            types.PublishDiagnosticsParams(document.uri, findings.shown(analysis), analysis.document.version)
        )

    async def aside(self, work: Callable[[], T]) -> T:
        """Return the result of long work, during which requests are answered."""
        return await asyncio.get_running_loop().run_in_executor(self._worker, work)

    async def analysis(self, uri: str, *, checked: bool = False) -> Analysis | None:
        """Return the analysis of a document in its present state; after its check if `checked` or if it is long."""
        document = self.decks.documents.get(uri)
        waits = document is not None and (checked or document.is_long)
        while waits and uri in self._checks and not self._checks[uri].done():
            await asyncio.wait([self._checks[uri]])
        return self.decks.analysis(uri)

    def shutdown(self) -> None:
        """End as soon as the present check has ended."""
        self._worker.shutdown(cancel_futures=True)
        super().shutdown()  # type: ignore[no-untyped-call]

    def unexpected(self, _: object, context: dict[str, Any]) -> None:
        """Report a fault of the server itself, which continues; an answer that could not be sent is not reported."""
        error = context.get("exception")
        if isinstance(error, JsonRpcException):
            return
        detail = f"{type(error).__name__}: {error}" if error else context.get("message", "")
        message = f"{str(detail)[:500]}: please report this fault of mudline"
        self.window_log_message(types.LogMessageParams(types.MessageType.Error, message))

    def report_server_error(self, error: Exception, source: type[Exception]) -> None:
        """Record an unhandled message in the editor's log; requests have already been answered."""
        message = str(error)[:500] or type(error).__name__
        self.window_log_message(types.LogMessageParams(types.MessageType.Log, f"{source.__name__}: {message}"))


def _failed(check: asyncio.Task[None]) -> None:
    """Pass the exception of a check to the loop, and so to `unexpected`."""
    if not check.cancelled():
        check.result()


# ------------------------------------------------------------------------------------------------------------- requests

Ask = Callable[[Navigator, Any], object]
"""Function that answers a request about a deck, from the parameters of the request."""

_ANSWERS: dict[str, tuple[Ask, object]] = {
    types.TEXT_DOCUMENT_HOVER: (lambda deck, asked: hover(deck.analysis, deck.at(asked.position)), None),
    types.TEXT_DOCUMENT_DOCUMENT_SYMBOL: (lambda deck, _: list(structure.outline(deck.analysis)), []),
    types.TEXT_DOCUMENT_FOLDING_RANGE: (lambda deck, _: list(structure.folding(deck.analysis)), []),
    types.TEXT_DOCUMENT_FORMATTING: (lambda deck, _: structure.formatting(deck.analysis), []),
    types.TEXT_DOCUMENT_INLAY_HINT: (lambda deck, asked: hints(deck.analysis, asked.range), []),
    types.TEXT_DOCUMENT_DEFINITION: (lambda deck, asked: deck.definition(deck.at(asked.position)), []),
    types.TEXT_DOCUMENT_REFERENCES: (
        lambda deck, asked: deck.references(deck.at(asked.position), declaration=asked.context.include_declaration),
        [],
    ),
    types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT: (lambda deck, asked: deck.highlights(deck.at(asked.position)), []),
    types.TEXT_DOCUMENT_PREPARE_RENAME: (lambda deck, asked: deck.prepared(deck.at(asked.position)), None),
    types.TEXT_DOCUMENT_RENAME: (lambda deck, asked: deck.rename(deck.at(asked.position), asked.new_name), None),
}
"""Answers, and the answer in a file that is not keyword text; JSON and YAML have a canonical layout only."""
_OPTIONS = {types.TEXT_DOCUMENT_RENAME: types.RenameOptions(prepare_provider=True)}


def register(server: DeckServer) -> None:
    """Register every request that is answered."""
    server.feature(types.INITIALIZED)(lambda _: server.watch_files())
    server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)(lambda given: server.files_changed(given.changes))
    _fixes(server)
    _completion(server)
    for method, (ask, nothing) in _ANSWERS.items():
        _answer(server, method, ask, nothing)

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def saved(params: types.DidSaveTextDocumentParams) -> None:
        server.files_changed([types.FileEvent(params.text_document.uri, types.FileChangeType.Changed)])

    @server.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, structure.LEGEND)
    async def semantic_tokens(params: types.SemanticTokensParams) -> types.SemanticTokens:
        document = copy(server.decks.documents.get(params.text_document.uri))  # in its present state
        return await server.aside(lambda: structure.tokens(document)) if document else types.SemanticTokens([])


def _answer(server: DeckServer, method: str, ask: Ask, nothing: object) -> None:
    @server.feature(method, _OPTIONS.get(method))
    async def answered(params: Any) -> object:  # noqa: ANN401 - of each request others
        analysis = await server.analysis(params.text_document.uri)
        if analysis is None or not (analysis.is_text or method == types.TEXT_DOCUMENT_FORMATTING):
            return nothing
        return ask(Navigator(server.decks, analysis), params)


def _fixes(server: DeckServer) -> None:
    options = types.CodeActionOptions(code_action_kinds=findings.KINDS, resolve_provider=True)

    @server.feature(types.TEXT_DOCUMENT_CODE_ACTION, options)
    async def actions(params: types.CodeActionParams) -> list[types.CodeAction]:
        analysis = await server.analysis(params.text_document.uri, checked=True)
        if analysis is None:
            return []
        context, resolved = params.context, server.resolves_edits
        asked = params.range, context.only
        return await server.aside(lambda: list(findings.actions(analysis, *asked, resolved=resolved)))

    @server.feature(types.CODE_ACTION_RESOLVE)
    async def resolve(action: types.CodeAction) -> types.CodeAction:
        uri = action.data.get("uri") if isinstance(action.data, dict) else None
        analysis = await server.analysis(uri) if isinstance(uri, str) else None
        if analysis is not None and action.kind == findings.FIX_ALL:
            action.edit = await server.aside(lambda: findings.fix_all(analysis))
        return action


def _completion(server: DeckServer) -> None:
    options = types.CompletionOptions(trigger_characters=completion.TRIGGERS, resolve_provider=True)

    @server.feature(types.TEXT_DOCUMENT_COMPLETION, options)
    async def completed(params: types.CompletionParams) -> types.CompletionList:
        analysis = await server.analysis(params.text_document.uri)
        if analysis is None or not analysis.is_text:
            return types.CompletionList(is_incomplete=False, items=[])
        offset = analysis.document.offset(params.position)
        items = completion.completions(analysis, offset, snippets=server.takes_snippets)
        return types.CompletionList(is_incomplete=False, items=items)

    server.feature(types.COMPLETION_ITEM_RESOLVE)(completion.resolved)


# ---------------------------------------------------------------------------------------------------------- the process


_SWITCH = 0.001
"""Seconds after which a check lets the answering thread run; each answer needs several such turns."""


def quiet_logs() -> None:
    """Keep pygls' reports of unusable messages, which may be of any length, off standard error."""
    logging.getLogger("pygls").setLevel(logging.CRITICAL)
    logging.getLogger("asyncio").setLevel(logging.CRITICAL)


def serve() -> int:
    """Serve until the editor ends it; return 0 if the editor announced the end, as the protocol requires, else 1."""
    quiet_logs()
    stdin, stdout = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr  # what is printed must not come between the messages
    sys.setswitchinterval(_SWITCH)
    server = DeckServer()
    register(server)
    server.start_io(stdin, stdout)
    return 0 if server.protocol._shutdown else 1  # noqa: SLF001 - pygls has no other way to ask
