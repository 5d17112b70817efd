"""Serving an editor: each request of the protocol and the module that answers it, on standard input and output."""

from __future__ import annotations

import io
import logging
import re
import sys
from copy import copy
from typing import BinaryIO, Protocol

from lsprotocol import types

from mudline.tools.lsp import colours, completion, findings, structure
from mudline.tools.lsp.help import hints, hover
from mudline.tools.lsp.navigation import Navigator
from mudline.tools.lsp.server import DeckServer


class AtPosition(Protocol):
    """The parameters of a request about a place."""

    text_document: types.TextDocumentIdentifier
    position: types.Position


def register(server: DeckServer) -> None:
    """Register every request that is answered."""
    _watch(server)
    _fixes(server)
    _help(server)
    _navigation(server)
    _rename(server)
    _layout(server)


def _watch(server: DeckServer) -> None:
    @server.feature(types.INITIALIZED)
    def ready(_: types.InitializedParams) -> None:
        server.watch_files()

    @server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def watched(params: types.DidChangeWatchedFilesParams) -> None:
        server.files_changed(list(params.changes))

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def saved(params: types.DidSaveTextDocumentParams) -> None:
        server.files_changed([types.FileEvent(params.text_document.uri, types.FileChangeType.Changed)])


def _fixes(server: DeckServer) -> None:
    options = types.CodeActionOptions(code_action_kinds=findings.KINDS, resolve_provider=True)

    @server.feature(types.TEXT_DOCUMENT_CODE_ACTION, options)
    async def actions(params: types.CodeActionParams) -> list[types.CodeAction]:
        found = await server.analysis(params.text_document.uri, checked=True)
        if found is None:
            return []
        context, resolved = params.context, server.resolves_edits
        return await server.aside(lambda: findings.actions(found, params.range, context.only, resolved=resolved))

    @server.feature(types.CODE_ACTION_RESOLVE)
    async def resolve(action: types.CodeAction) -> types.CodeAction:
        uri = action.data.get("uri") if isinstance(action.data, dict) else None
        found = await server.analysis(uri) if isinstance(uri, str) else None
        if found is not None and action.kind == findings.FIX_ALL:
            action.edit = await server.aside(lambda: findings.fix_all(found))
        return action


def _help(server: DeckServer) -> None:
    @server.feature(types.TEXT_DOCUMENT_HOVER)
    async def hovered(params: types.HoverParams) -> types.Hover | None:
        found = await server.analysis(params.text_document.uri)
        return hover(found, found.document.offset(params.position)) if found else None

    options = types.CompletionOptions(trigger_characters=completion.TRIGGERS, resolve_provider=True)

    @server.feature(types.TEXT_DOCUMENT_COMPLETION, options)
    async def completed(params: types.CompletionParams) -> types.CompletionList:
        found = await server.analysis(params.text_document.uri)
        items: list[types.CompletionItem] = []
        if found is not None:
            offset = found.document.offset(params.position)
            items = completion.completions(found, offset, snippets=server.takes_snippets)
        return types.CompletionList(is_incomplete=False, items=items)

    @server.feature(types.COMPLETION_ITEM_RESOLVE)
    def resolved(item: types.CompletionItem) -> types.CompletionItem:
        return completion.resolved(item)


async def _navigator(server: DeckServer, params: AtPosition) -> tuple[Navigator, int] | None:
    """What answers about a place, and the offset of that."""
    found = await server.analysis(params.text_document.uri)
    if found is None or found.origin is None:
        return None
    return Navigator(server.decks, found), found.document.offset(params.position)


def _navigation(server: DeckServer) -> None:
    @server.feature(types.TEXT_DOCUMENT_DEFINITION)
    async def definition(params: types.DefinitionParams) -> list[types.Location]:
        asked = await _navigator(server, params)
        return asked[0].definition(asked[1]) if asked else []

    @server.feature(types.TEXT_DOCUMENT_REFERENCES)
    async def references(params: types.ReferenceParams) -> list[types.Location]:
        asked = await _navigator(server, params)
        return asked[0].references(asked[1], declaration=params.context.include_declaration) if asked else []

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT)
    async def highlights(params: types.DocumentHighlightParams) -> list[types.DocumentHighlight]:
        asked = await _navigator(server, params)
        return asked[0].highlights(asked[1]) if asked else []


def _rename(server: DeckServer) -> None:
    @server.feature(types.TEXT_DOCUMENT_PREPARE_RENAME)
    async def prepare(params: types.PrepareRenameParams) -> types.PrepareRenamePlaceholder | None:
        asked = await _navigator(server, params)
        if asked is None:
            return None
        named = asked[0].renamed(asked[1])
        return types.PrepareRenamePlaceholder(asked[0].analysis.document.range(named.span), named.name)

    @server.feature(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))
    async def rename(params: types.RenameParams) -> types.WorkspaceEdit | None:
        asked = await _navigator(server, params)
        return asked[0].rename(asked[1], params.new_name) if asked else None


def _layout(server: DeckServer) -> None:
    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    async def symbols(
        params: types.DocumentSymbolParams,
    ) -> list[types.DocumentSymbol]:
        found = await server.analysis(params.text_document.uri)
        return structure.outline(found) if found else []

    @server.feature(types.TEXT_DOCUMENT_FOLDING_RANGE)
    async def folding(params: types.FoldingRangeParams) -> list[types.FoldingRange]:
        found = await server.analysis(params.text_document.uri)
        return structure.folding(found) if found else []

    @server.feature(types.TEXT_DOCUMENT_FORMATTING)
    async def formatting(params: types.DocumentFormattingParams) -> list[types.TextEdit]:
        found = await server.analysis(params.text_document.uri)
        return structure.formatting(found) if found else []

    @server.feature(types.TEXT_DOCUMENT_INLAY_HINT)
    async def inlay_hints(params: types.InlayHintParams) -> list[types.InlayHint]:
        found = await server.analysis(params.text_document.uri)
        return hints(found, params.range) if found else []

    @server.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, colours.LEGEND)
    async def semantic_tokens(params: types.SemanticTokensParams) -> types.SemanticTokens:
        document = copy(server.decks.documents.get(params.text_document.uri))  # as it is now
        return await server.aside(lambda: colours.tokens(document)) if document else types.SemanticTokens([])


# ---------------------------------------------------------------------------------------------------------- the process


_SWITCH = 0.001
"""Seconds after which a check lets the thread go on that answers requests; each answer needs several such turns."""


def quiet_logs() -> None:
    """Keep what pygls reports of messages that cannot be used, which may be of any length, off standard error."""
    logging.getLogger("pygls").setLevel(logging.CRITICAL)
    logging.getLogger("asyncio").setLevel(logging.CRITICAL)


_NO_LENGTH = re.compile(rb"content-length:\s*[0-9]{12}", re.IGNORECASE)


class _Input(io.BufferedReader):
    """Standard input, in which a length that no memory holds is none: it would end the server."""

    def readline(self, size: int | None = -1, /) -> bytes:
        """Read a line of a header."""
        line = super().readline(size)
        return b"Length: too large\r\n" if _NO_LENGTH.match(line) else line


def take_streams() -> tuple[BinaryIO, BinaryIO]:
    """Standard input and output of the protocol; what else is printed goes to standard error from now on."""
    streams = _Input(io.FileIO(sys.stdin.fileno(), closefd=False)), sys.stdout.buffer
    sys.stdout = sys.stderr
    return streams


def serve() -> int:
    """Serve until the editor ends it; returns 0 where that was announced before, as the protocol asks, else 1."""
    quiet_logs()
    stdin, stdout = take_streams()
    sys.setswitchinterval(_SWITCH)
    server = DeckServer()
    register(server)
    server.start_io(stdin, stdout)
    return 0 if server.protocol._shutdown else 1  # noqa: SLF001 - pygls has no other way to ask
