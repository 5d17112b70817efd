"""Serving an editor: each request of the protocol with the module that answers it, on standard input and output."""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable
from copy import copy
from typing import Any

from lsprotocol import types

from mudline.tools.lsp import colours, completion, findings, structure
from mudline.tools.lsp.decks import Analysis
from mudline.tools.lsp.help import hints, hover
from mudline.tools.lsp.navigation import Navigator
from mudline.tools.lsp.server import DeckServer

Ask = Callable[[Analysis, Any], object]
"""Function that answers a request about a deck, from its analysis and the parameters of the request."""
AskAt = Callable[[Navigator, int, Any], object]
"""Function that answers a request about a place in a deck, from its offset and the parameters."""

_ABOUT_DECKS: dict[str, tuple[Ask, object]] = {
    types.TEXT_DOCUMENT_HOVER: (lambda deck, asked: hover(deck, deck.document.offset(asked.position)), None),
    types.TEXT_DOCUMENT_DOCUMENT_SYMBOL: (lambda analysis, _: structure.outline(analysis), []),
    types.TEXT_DOCUMENT_FOLDING_RANGE: (lambda analysis, _: structure.folding(analysis), []),
    types.TEXT_DOCUMENT_FORMATTING: (lambda analysis, _: structure.formatting(analysis), []),
    types.TEXT_DOCUMENT_INLAY_HINT: (lambda analysis, asked: hints(analysis, asked.range), []),
}
"""Answers about decks, and the answer if no deck is open."""
_ABOUT_PLACES: dict[str, tuple[AskAt, object]] = {
    types.TEXT_DOCUMENT_DEFINITION: (lambda deck, at, _: deck.definition(at), []),
    types.TEXT_DOCUMENT_REFERENCES: (
        lambda deck, at, asked: deck.references(at, declaration=asked.context.include_declaration),
        [],
    ),
    types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT: (lambda deck, at, _: deck.highlights(at), []),
    types.TEXT_DOCUMENT_PREPARE_RENAME: (lambda deck, at, _: deck.prepared(at), None),
    types.TEXT_DOCUMENT_RENAME: (lambda deck, at, asked: deck.rename(at, asked.new_name), None),
}
"""Answers about places, and the answer in a file that is not keyword text."""
_OPTIONS = {types.TEXT_DOCUMENT_RENAME: types.RenameOptions(prepare_provider=True)}


def register(server: DeckServer) -> None:
    """Register every request that is answered."""
    _watch(server)
    _fixes(server)
    _completion(server)
    for method, (ask, nothing) in _ABOUT_DECKS.items():
        _answer(server, method, ask, nothing)
    for method, (ask_at, nothing) in _ABOUT_PLACES.items():
        _answer(server, method, _at_place(server, ask_at, nothing), nothing)

    @server.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, colours.LEGEND)
    async def semantic_tokens(params: types.SemanticTokensParams) -> types.SemanticTokens:
        document = copy(server.decks.documents.get(params.text_document.uri))  # in its present state
        return await server.aside(lambda: colours.tokens(document)) if document else types.SemanticTokens([])


def _answer(server: DeckServer, method: str, ask: Ask, nothing: object) -> None:
    @server.feature(method, _OPTIONS.get(method))
    async def answered(params: Any) -> object:  # noqa: ANN401 - of each request others
        analysis = await server.analysis(params.text_document.uri)
        return nothing if analysis is None else ask(analysis, params)


def _at_place(server: DeckServer, ask: AskAt, nothing: object) -> Ask:
    def answered(analysis: Analysis, params: Any) -> object:  # noqa: ANN401 - as above
        at = analysis.document.offset(params.position)
        return nothing if analysis.origin is None else ask(Navigator(server.decks, analysis), at, params)

    return answered


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
        analysis = await server.analysis(params.text_document.uri, checked=True)
        if analysis is None:
            return []
        context, resolved = params.context, server.resolves_edits
        return await server.aside(lambda: findings.actions(analysis, params.range, context.only, resolved=resolved))

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
        items: list[types.CompletionItem] = []
        if analysis is not None:
            offset = analysis.document.offset(params.position)
            items = completion.completions(analysis, offset, snippets=server.takes_snippets)
        return types.CompletionList(is_incomplete=False, items=items)

    @server.feature(types.COMPLETION_ITEM_RESOLVE)
    def resolved(item: types.CompletionItem) -> types.CompletionItem:
        return completion.resolved(item)


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
