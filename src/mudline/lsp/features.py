"""What the server can be asked: each request of the protocol and the module that answers it."""

from __future__ import annotations

from lsprotocol import types

from mudline.lsp import findings
from mudline.lsp.server import DeckServer


def register(server: DeckServer) -> None:
    """Register every request that is answered."""
    _watch(server)
    _fixes(server)


def _watch(server: DeckServer) -> None:
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
        found = await server.analysis(params.text_document.uri)
        if found is None:
            return []
        return findings.actions(found, params.range, params.context.only, resolved=server.resolves_edits)

    @server.feature(types.CODE_ACTION_RESOLVE)
    async def resolve(action: types.CodeAction) -> types.CodeAction:
        uri = action.data.get("uri") if isinstance(action.data, dict) else None
        found = await server.analysis(uri) if isinstance(uri, str) else None
        if found is not None and action.kind == findings.FIX_ALL:
            with server.decks.reading():
                action.edit = findings.fix_all(found)
        return action
