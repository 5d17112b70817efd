"""Messages between editor and server: one that cannot be used is answered, or left out, and the next one is read."""

from __future__ import annotations

from collections.abc import Generator
from typing import Any, cast
from typing import Protocol as Typed

from lsprotocol import types
from pygls.exceptions import JsonRpcException, JsonRpcInvalidRequest, JsonRpcServerNotInitialized
from pygls.protocol import JsonRPCNotification, LanguageServerProtocol, lsp_method

_UNUSABLE = "$/unusable"
"""The method of a notification that stands for a message which cannot be used; no feature has it."""


class DocumentEvents(Typed):
    """What is to be done when documents of the editor change."""

    def begin(self, encoding: types.PositionEncodingKind | str, params: types.InitializeParams) -> None:
        """The position encoding is agreed."""

    def opened(self, item: types.TextDocumentItem) -> None:
        """A document was opened."""

    def changed(self, params: types.DidChangeTextDocumentParams) -> None:
        """A document was changed."""

    def closed(self, uri: str) -> None:
        """A document was closed."""


class DeckProtocol(LanguageServerProtocol):
    """The protocol of pygls with our own documents, which answers whatever is asked in whatever order."""

    ready = False

    @property
    def documents(self) -> DocumentEvents:
        """The server."""
        return cast("DocumentEvents", self._server)

    # ------------------------------------------------------------------------------------------- unusable messages

    def structure_message(self, data: dict[str, Any]) -> Any:  # noqa: ANN401 - as pygls declares it
        """A message as an object; a request that cannot be one is answered with an error."""
        try:
            return super().structure_message(data)
        except JsonRpcException as error:
            self._refuse(data.get("id"), data, f"{data.get('method')}: the parameters cannot be used", error)
        except (TypeError, ValueError, AttributeError, KeyError, RecursionError) as error:
            self._refuse(data.get("id"), data, f"the message cannot be used: {error}", JsonRpcInvalidRequest())
        return JsonRPCNotification(method=_UNUSABLE, jsonrpc=self.VERSION, params=None)

    def handle_message(self, message: Any) -> None:  # noqa: ANN401 - as pygls declares it
        """Handle a message; requests before the beginning and after the end are answered with an error."""
        number, method = getattr(message, "id", None), getattr(message, "method", None)
        if method is not None and not isinstance(method, str):
            return
        if number is None and not self.ready and method not in (types.EXIT, types.INITIALIZED):
            return
        if number is not None and method is not None:
            if self._shutdown:
                self._answer_error(number, JsonRpcInvalidRequest("the server has been shut down"))
                return
            if self.ready == (method == types.INITIALIZE):
                twice = JsonRpcInvalidRequest("the server is initialised already")
                early = JsonRpcServerNotInitialized("initialize is the first request")
                self._answer_error(number, twice if self.ready else early)
                return
        super().handle_message(message)

    def _refuse(self, number: object, data: dict[str, Any], message: str, error: JsonRpcException) -> None:
        if isinstance(number, int | str) and isinstance(data.get("method"), str):
            self._answer_error(number, type(error)(message))

    def _answer_error(self, number: int | str, error: JsonRpcException) -> None:
        self._send_response(number, error=error.to_response_error())

    # ----------------------------------------------------------------------------------------------------- documents

    @lsp_method(types.INITIALIZE)
    def lsp_initialize(self, params: types.InitializeParams) -> Generator[Any, Any, types.InitializeResult]:
        """Begin: the position encoding is agreed."""
        result = yield from super().lsp_initialize(params)
        self.ready = True
        self.documents.begin(result.capabilities.position_encoding or types.PositionEncodingKind.Utf16, params)
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
