"""A server that runs for all tests, and an editor with a folder of its own for each."""

from __future__ import annotations

from collections.abc import AsyncIterator
from pathlib import Path

import pytest
import pytest_asyncio
import pytest_lsp
from lsprotocol import types
from pytest_lsp import ClientServerConfig, LanguageClient

from tests.tools.lsp.command import server_command
from tests.tools.lsp.editor import Editor

CAPABILITIES = types.ClientCapabilities(
    general=types.GeneralClientCapabilities(position_encodings=[types.PositionEncodingKind.Utf16]),
    text_document=types.TextDocumentClientCapabilities(
        completion=types.CompletionClientCapabilities(
            completion_item=types.ClientCompletionItemOptions(
                snippet_support=True, documentation_format=[types.MarkupKind.Markdown]
            )
        ),
        code_action=types.CodeActionClientCapabilities(
            resolve_support=types.ClientCodeActionResolveOptions(properties=["edit"])
        ),
    ),
)


@pytest_lsp.fixture(config=ClientServerConfig(server_command=server_command()), scope="session")  # type: ignore[untyped-decorator]
async def client(lsp_client: LanguageClient, tmp_path_factory: pytest.TempPathFactory) -> AsyncIterator[None]:
    """One server for all tests: each has documents of its own."""
    folder = types.WorkspaceFolder(tmp_path_factory.getbasetemp().as_uri(), "tests")
    params = types.InitializeParams(capabilities=CAPABILITIES, workspace_folders=[folder])
    await lsp_client.initialize_session(params)
    yield
    await lsp_client.shutdown_session()


@pytest_asyncio.fixture(loop_scope="session")
async def editor(client: LanguageClient, tmp_path: Path) -> AsyncIterator[Editor]:
    made = Editor(client, tmp_path)
    yield made
    made.close_all()
