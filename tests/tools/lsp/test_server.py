"""The server as a process: what is agreed with it, decks of any size, and messages that no editor should send."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from mudline.tools.lsp.decks import Decks
from tests.helpers.builders.decks import CLEAN
from tests.tools.lsp.raw import RawClient, raw_client

AT: dict[str, Any] = {"textDocument": {"uri": "untitled:deck"}, "position": {"line": 3, "character": 1}}
HUGE = 2**31 - 1
RANGE = {**AT, "range": {"start": AT["position"], "end": {"line": HUGE, "character": HUGE}}}
OPTIONS = {"tabSize": 1, "insertSpaces": True}
REQUESTS: dict[str, dict[str, Any]] = {
    "textDocument/hover": AT,
    "textDocument/completion": AT,
    "textDocument/definition": AT,
    "textDocument/references": {**AT, "context": {"includeDeclaration": True}},
    "textDocument/documentHighlight": AT,
    "textDocument/prepareRename": AT,
    "textDocument/rename": {**AT, "newName": "x"},
    "textDocument/documentSymbol": AT,
    "textDocument/foldingRange": AT,
    "textDocument/formatting": {**AT, "options": OPTIONS},
    "textDocument/codeAction": {**RANGE, "context": {"diagnostics": []}},
    "textDocument/inlayHint": RANGE,
}
INTERNAL = -32603
LIMITS = "long has 1 million characters: help waits for its check, and its outline has no names"


@pytest.fixture(scope="module")
def started() -> Iterator[RawClient]:
    with raw_client() as client:
        client.begin()
        yield client


@pytest.fixture
def client(started: RawClient) -> Iterator[RawClient]:
    yield started
    assert started.lives()


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"{",
        b"[]",
        b"null",
        b"\xff\xfe",
        b'{"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": {}}',
        b'{"jsonrpc": "2.0", "method": "$/unknown", "params": [1, 2]}',
    ],
)
def test_bodies_that_are_no_messages_are_passed_over(client: RawClient, body: bytes) -> None:
    client.body(body)


@pytest.mark.parametrize("method", REQUESTS)
@pytest.mark.parametrize(
    "text", ["", "$", "*", "$MODEL\r*NODE\r\n\t1,\t2 😋\r", "\ufeff" + CLEAN, CLEAN * 3, "=[" * 50]
)
def test_every_request_is_answered_for_every_text(client: RawClient, method: str, text: str) -> None:
    client.open("untitled:deck", text)
    for place in ((0, 0), (1, 5), (3, 1), (3, 6), (HUGE, HUGE)):
        at = {"line": place[0], "character": place[1]}
        answer = client.ask(method, {**REQUESTS[method], "position": at})
        assert not isinstance(answer, dict) or answer.get("code") != INTERNAL, answer


def test_changes_of_nothing_and_beyond_everything_are_made(client: RawClient) -> None:
    def change(version: int, *changes: object) -> None:
        identifier = {"uri": "untitled:deck", "version": version}
        client.notify("textDocument/didChange", {"textDocument": identifier, "contentChanges": changes})

    def at(line: int, character: int) -> dict[str, int]:
        return {"line": line, "character": character}

    client.notify("textDocument/didClose", {"textDocument": {"uri": "untitled:deck"}})
    change(1, {"text": "x"})
    client.open("untitled:deck", "$MODEL 😋\n")
    change(2)
    change(3, {"range": {"start": at(9, 9), "end": at(0, 0)}, "text": "$MODLE\n"})
    change(4, {"range": {"start": at(0, 8), "end": at(0, 8)}, "text": "\ud83d"})
    change(5, {"range": {"start": at(HUGE, HUGE), "end": at(HUGE, HUGE)}, "text": "\ude0b"})
    change(6, {"range": {"start": at(-1, 0), "end": at(0, 0)}, "text": "y"})
    change(-(2**31), {"text": ""})
    assert client.ask("textDocument/documentSymbol", AT)


def test_a_long_table_stays_usable_and_its_limits_are_said_once(client: RawClient) -> None:
    uri = "untitled:long"
    at = {"textDocument": {"uri": uri}}
    rows = "".join(f" {number}, 0.0, {number}.25\n" for number in range(1, 60_001))
    text = f"$MODEL\n*NODE\n{rows}*ELEMENT\n 1, 1, 2\n*ELEMENT SETS\n SET=Riser\n 1\n"
    client.notifications.clear()
    client.open(uri, text)
    client.findings(uri)
    said = [each for each in client.notifications if each["method"] == "window/showMessage"]
    assert [each["params"]["message"] for each in said] == [LIMITS]
    for version in range(2, 12):
        place = {"line": 60_005, "character": 1}
        change = {"range": {"start": place, "end": place}, "text": "2, "}
        identifier = {"uri": uri, "version": version}
        client.notify("textDocument/didChange", {"textDocument": identifier, "contentChanges": [change]})
    client.send(id="waits", method="textDocument/hover", params={**at, "position": {"line": 30_000, "character": 2}})
    assert "node **29999**" in client.answer("waits")["contents"]["value"]
    shown = [each for each in client.notifications if each["method"] == "textDocument/publishDiagnostics"]
    versions = [each["params"]["version"] for each in shown]
    assert versions == sorted(set(versions))
    assert versions[-1] == 11
    client.notify("textDocument/didClose", at)


def test_a_text_beyond_the_limit_is_not_checked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.tools.lsp.documents.LARGEST_OPEN", 10)
    decks = Decks()
    decks.open("untitled:deck", "$MODLE\n*OCAEN\n", 1, "mudline")
    found = decks.analysis("untitled:deck")
    assert found is not None
    assert found.document.is_too_large
    assert (found.deck, found.found) == (None, ())


# ------------------------------------------------------------------------------------- position encodings, and the end

LINES = (
    "$MODEL\r\n*ELEMENT SETS\r\n\tSET=\u00d6l \U0001f60b 1\r\n\t1\r\n*SEABED FRICTION\r\n\tSET=\u00d6l \U0001f60b 1\r\n"
)


@pytest.mark.parametrize(("encoding", "width"), [("utf-8", 10), ("utf-32", 6)])
def test_places_are_in_the_units_that_were_agreed(encoding: str, width: int) -> None:
    with raw_client() as client:
        watching = {"didChangeWatchedFiles": {"dynamicRegistration": True}}
        begun = client.begin(general={"positionEncodings": ["utf-7", encoding]}, workspace=watching)
        client.notify("initialized", {})
        assert begun["capabilities"]["positionEncoding"] == encoding
        client.open("untitled:lines", LINES)
        asked = {"textDocument": {"uri": "untitled:lines"}, "position": {"line": 5, "character": 5 + width}}
        (found,) = client.ask("textDocument/definition", asked)
        start, end = {"line": 2, "character": 5}, {"line": 2, "character": 5 + width}
        assert found["range"] == {"start": start, "end": end}
        assert "client/registerCapability" in [each["method"] for each in client.notifications]
        renamed = client.ask("textDocument/rename", {**asked, "newName": "Gas"})
        ends = [edit["range"]["end"]["character"] for edit in renamed["changes"]["untitled:lines"]]
        assert ends == [5 + width, 5 + width]
        change = {"range": found["range"], "text": "Gas"}
        identifier = {"uri": "untitled:lines", "version": 2}
        client.notify("textDocument/didChange", {"textDocument": identifier, "contentChanges": [change]})
        again = client.ask("textDocument/definition", {**asked, "position": {"line": 2, "character": 6}})
        assert again[0]["range"] == {"start": start, "end": {"line": 2, "character": 8}}
        if encoding == "utf-8":
            assert client.end() == 0
        else:  # without a word before
            client.stdin.close()
            assert client.process.wait(30) == 1
            assert client.process.stderr is not None
            assert client.process.stderr.read() == b""
