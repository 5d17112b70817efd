"""Serving an editor: each request of the protocol and the module that answers it, on standard input and output."""

from __future__ import annotations

import logging
import sys
import tempfile
from pathlib import Path
from typing import Any, BinaryIO, Protocol, cast

from lsprotocol import types
from pygls.exceptions import JsonRpcException

from mudline.lsp import completion, findings, hover, structure, things
from mudline.lsp.decks import Analysis
from mudline.lsp.documents import address_of
from mudline.lsp.navigation import Navigator, RenameError
from mudline.lsp.server import DeckServer

_REQUEST_FAILED = -32803
"""The protocol's code for a request that was understood and cannot be fulfilled."""


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
    _between_the_lines(server)


def _failed(message: object) -> JsonRpcException:
    return JsonRpcException(str(message), _REQUEST_FAILED)


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

    @server.feature(types.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS)
    def folders(params: types.DidChangeWorkspaceFoldersParams) -> None:
        server.change_folders(params.event)


def _fixes(server: DeckServer) -> None:
    options = types.CodeActionOptions(code_action_kinds=findings.KINDS, resolve_provider=True)

    @server.feature(types.TEXT_DOCUMENT_CODE_ACTION, options)
    async def actions(params: types.CodeActionParams) -> list[types.CodeAction]:
        found = await server.analysis(params.text_document.uri)
        if found is None:
            return []
        with server.decks.reading():
            return findings.actions(found, params.range, params.context.only, resolved=server.resolves_edits)

    @server.feature(types.CODE_ACTION_RESOLVE)
    async def resolve(action: types.CodeAction) -> types.CodeAction:
        uri = action.data.get("uri") if isinstance(action.data, dict) else None
        found = await server.analysis(uri) if isinstance(uri, str) else None
        if found is not None and action.kind == findings.FIX_ALL:
            with server.decks.reading():
                action.edit = findings.fix_all(found)
        return action


def _help(server: DeckServer) -> None:
    @server.feature(types.TEXT_DOCUMENT_HOVER)
    async def hovered(params: types.HoverParams) -> types.Hover | None:
        found = await server.analysis(params.text_document.uri)
        help_ = hover.hover(found, found.document.offset(params.position)) if found else None
        if help_ is not None and isinstance(help_.contents, types.MarkupContent):
            help_.contents = hover.as_shown(help_.contents, server.help_formats)
        return help_

    options = types.CompletionOptions(trigger_characters=completion.TRIGGERS, resolve_provider=True)

    @server.feature(types.TEXT_DOCUMENT_COMPLETION, options)
    async def completed(params: types.CompletionParams) -> types.CompletionList:
        found = await server.analysis(params.text_document.uri)
        items: list[types.CompletionItem] = []
        if found is not None:
            offset = found.document.offset(params.position)
            listed = server.in_workspace(found.document.path)
            items = completion.completions(found, offset, snippets=server.takes_snippets, lists_files=listed)
        for item in items:
            _plain_help(server, item)
        return types.CompletionList(is_incomplete=False, items=items)

    @server.feature(types.COMPLETION_ITEM_RESOLVE)
    def resolved(item: types.CompletionItem) -> types.CompletionItem:
        return _plain_help(server, completion.resolved(item))


def _plain_help(server: DeckServer, item: types.CompletionItem) -> types.CompletionItem:
    """An item whose help has a format that the editor shows."""
    if isinstance(item.documentation, types.MarkupContent):
        item.documentation = hover.as_shown(item.documentation, server.item_help_formats)
    return item


async def _navigator(server: DeckServer, params: AtPosition) -> tuple[Navigator, int] | None:
    """What answers about a place, and the offset of that."""
    found = await server.analysis(params.text_document.uri)
    if found is None or found.origin is None:
        return None
    return Navigator(server.decks, found, server.folders), found.document.offset(params.position)


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
        try:
            named = asked[0].renamed(asked[1])
        except RenameError as error:
            raise _failed(error) from error
        return types.PrepareRenamePlaceholder(asked[0].analysis.document.range(named.span), named.name)

    @server.feature(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))
    async def rename(params: types.RenameParams) -> types.WorkspaceEdit | None:
        asked = await _navigator(server, params)
        try:
            return asked[0].rename(asked[1], params.new_name) if asked else None
        except RenameError as error:
            raise _failed(error) from error


def _layout(server: DeckServer) -> None:
    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    async def symbols(
        params: types.DocumentSymbolParams,
    ) -> list[types.DocumentSymbol] | list[types.SymbolInformation]:
        found = await server.analysis(params.text_document.uri)
        tree = structure.outline(found) if found else []
        return tree if server.shows_trees else list(structure.flat(params.text_document.uri, tree))

    @server.feature(types.TEXT_DOCUMENT_FOLDING_RANGE)
    async def folding(params: types.FoldingRangeParams) -> list[types.FoldingRange]:
        found = await server.analysis(params.text_document.uri)
        return structure.folding(found) if found else []

    @server.feature(types.TEXT_DOCUMENT_FORMATTING)
    async def formatting(params: types.DocumentFormattingParams) -> list[types.TextEdit]:
        return _formatted(await server.analysis(params.text_document.uri))

    @server.feature(types.TEXT_DOCUMENT_RANGE_FORMATTING)
    async def range_formatting(params: types.DocumentRangeFormattingParams) -> list[types.TextEdit]:
        return _formatted(await server.analysis(params.text_document.uri), params.range)


def _formatted(found: Analysis | None, range_: types.Range | None = None) -> list[types.TextEdit]:
    try:
        return structure.formatting(found, range_) if found else []
    except structure.LayoutError as error:
        raise _failed(error) from error


def _between_the_lines(server: DeckServer) -> None:
    @server.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, structure.LEGEND)
    async def all_tokens(params: types.SemanticTokensParams) -> types.SemanticTokens:
        found = await server.analysis(params.text_document.uri)
        return structure.tokens(found) if found else types.SemanticTokens([])

    @server.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE, structure.LEGEND)
    async def tokens_of_range(params: types.SemanticTokensRangeParams) -> types.SemanticTokens:
        found = await server.analysis(params.text_document.uri)
        return structure.tokens(found, params.range) if found else types.SemanticTokens([])

    @server.feature(types.TEXT_DOCUMENT_INLAY_HINT)
    async def inlay_hints(params: types.InlayHintParams) -> list[types.InlayHint]:
        found = await server.analysis(params.text_document.uri)
        return things.hints(found, params.range) if found else []

    @server.feature(types.TEXT_DOCUMENT_CODE_LENS, types.CodeLensOptions(resolve_provider=False))
    async def lenses(params: types.CodeLensParams) -> list[types.CodeLens]:
        found = await server.analysis(params.text_document.uri)
        return things.lenses(found) if found else []

    pictures = tempfile.TemporaryDirectory(prefix="mudline-curves-")  # removed when the server ends

    @server.command(things.SHOW_CURVE)
    async def show_curve(uri: str, index: int) -> dict[str, Any]:
        found = await server.analysis(uri)
        scene = found.scene if found else None
        text = things.curve_text(scene, index) if scene else ""
        if scene is None or not text:
            raise _failed("there is no such curve any more")
        picture = things.draw_curve(scene, index, Path(pictures.name))
        server.show_picture(picture, text)
        return {"text": text, "picture": address_of(picture) if picture else None}


# ---------------------------------------------------------------------------------------------------------- the process

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
