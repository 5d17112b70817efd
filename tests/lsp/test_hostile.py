"""Messages that no editor should send never stop the server, and neither do decks of any size."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest

from tests.builders.decks import CLEAN
from tests.lsp.raw import RawClient, raw_client

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
    "textDocument/codeLens": AT,
    "textDocument/semanticTokens/full": AT,
    "textDocument/formatting": {**AT, "options": OPTIONS},
    "textDocument/codeAction": {**RANGE, "context": {"diagnostics": []}},
    "textDocument/rangeFormatting": {**RANGE, "options": OPTIONS},
    "textDocument/semanticTokens/range": RANGE,
    "textDocument/inlayHint": RANGE,
}
INTERNAL = -32603
LIMITS = (
    "deck has 1 million characters: it is checked when typing pauses, and rows of long tables get no colours and no "
    "hints"
)


@pytest.fixture(scope="module")
def started() -> Iterator[RawClient]:
    with raw_client() as client:
        client.begin()
        yield client


@pytest.fixture
def client(started: RawClient) -> Iterator[RawClient]:
    yield started
    assert started.lives()


def test_requests_in_the_wrong_order_are_answered() -> None:
    with raw_client() as client:
        assert client.ask("textDocument/hover", AT)["code"] == -32002
        client.open("untitled:deck", CLEAN)
        assert client.ask("shutdown")["code"] == -32002
        assert "capabilities" in client.begin()
        assert client.ask("initialize", {"capabilities": {}, "processId": None})["code"] == -32600
        assert client.ask("textDocument/hover", AT) is None
        assert client.ask("shutdown") is None
        assert client.ask("textDocument/hover", AT)["code"] == -32600
        client.notify("exit")
        assert client.process.wait(30) == 0


def test_an_exit_without_a_shutdown_is_a_failure() -> None:
    with raw_client() as client:
        client.begin()
        client.notify("exit")
        assert client.process.wait(30) == 1


def test_a_closed_input_ends_the_server() -> None:
    with raw_client() as client:
        client.begin()
        client.stdin.close()
        assert client.process.wait(30) == 1
        assert client.process.stderr is not None
        assert client.process.stderr.read() == b""


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"{",
        b"[]",
        b"3",
        b"null",
        b"\xff\xfe",
        b"[" * 100_000,
        b'{"a":' * 10_000,
        b'{"jsonrpc": "2.0"}',
        b'{"jsonrpc": "1.0", "method": "exit"}',
        b'{"jsonrpc": "2.0", "method": 3}',
        b'{"jsonrpc": "2.0", "id": {"jsonrpc": "2.0"}, "method": "textDocument/hover"}',
        b'{"jsonrpc": "2.0", "id": 1e400, "method": "textDocument/hover", "params": {}}',
        b'{"jsonrpc": "2.0", "id": 999, "result": 3}',
        b'{"jsonrpc": "2.0", "id": 999, "error": 3}',
        b'{"jsonrpc": "2.0", "method": "$/cancelRequest", "params": {"id": 12345}}',
        b'{"jsonrpc": "2.0", "method": "$/cancelRequest"}',
        b'{"jsonrpc": "2.0", "method": "$/unknown", "params": [1, 2]}',
        b'{"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": {}}',
        b'{"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": null}',
        b'{"jsonrpc": "2.0", "method": "initialized"}',
    ],
)
def test_bodies_that_are_no_messages_are_passed_over(client: RawClient, body: bytes) -> None:
    client.body(body)


@pytest.mark.parametrize(
    "header",
    [
        b"Content-Length: x\r\n\r\n",
        b"Content-Length: -1\r\n\r\n",
        b"\r\n\r\n",
        b"Content-Type: " + b"x" * 20_000 + b"\r\n",
        b"Content-Length: 0\r\n\r\n",
    ],
)
def test_headers_that_are_none_are_passed_over(client: RawClient, header: bytes) -> None:
    client.write(header)


def test_a_body_of_any_length_is_not_held() -> None:
    with raw_client() as client:
        client.begin()
        client.write(b"Content-Length: 99999999999999999999\r\n\r\n" + b" " * 100_000)
        client.stdin.close()
        assert client.process.wait(30) == 1


@pytest.mark.parametrize("method", REQUESTS)
@pytest.mark.parametrize("change", ["missing", "negative", "text", "unknown", "null"])
def test_requests_with_wrong_parameters_are_answered(client: RawClient, method: str, change: str) -> None:
    params = json.dumps(REQUESTS[method])
    if change == "missing":
        answer = client.ask(method, {})
        assert answer["code"] == -32602
    elif change == "unknown":
        answer = client.ask(method, json.loads(params.replace("untitled:deck", "file:///nowhere.keyxm")))
        assert not answer or answer.get("code", answer.get("items", answer.get("data"))) in ([], None)
    else:
        other = {"negative": "-5", "text": '"three"', "null": "null"}[change]
        answer = client.ask(method, json.loads(params.replace(": 3", f": {other}")))
        assert answer is None or isinstance(answer, list | dict)


@pytest.mark.parametrize("method", REQUESTS)
@pytest.mark.parametrize(
    "text", ["", "\n", "$", "*", "$MODEL\r*NODE\r\n\t1,\t2 😋\r", "\ufeff" + CLEAN, CLEAN * 3, "=[" * 50]
)
def test_every_request_is_answered_for_every_text(client: RawClient, method: str, text: str) -> None:
    client.open("untitled:deck", text)
    for place in ((0, 0), (1, 5), (3, 1), (3, 6), (HUGE, HUGE)):
        at = {"line": place[0], "character": place[1]}
        answer = client.ask(method, {**REQUESTS[method], "position": at})
        assert not isinstance(answer, dict) or answer.get("code") != INTERNAL, answer


def test_a_command_with_wrong_arguments_is_answered(client: RawClient) -> None:
    for arguments in ([], [3], ["untitled:nowhere", 0], ["untitled:deck", -1], [None, None], ["a", "b"], [1, 2, 3]):
        answer = client.ask("workspace/executeCommand", {"command": "mudline.showCurve", "arguments": arguments})
        assert "code" in answer, answer
    assert "code" in client.ask("workspace/executeCommand", {"command": "rm", "arguments": ["-rf"]})


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


def test_cancelled_requests_are_over(client: RawClient) -> None:
    client.open("untitled:deck", CLEAN)
    for number in range(10_000, 10_020):
        client.send(id=number, method="textDocument/hover", params=AT)
        client.notify("$/cancelRequest", {"id": number})
    answers = [client.answer(number) for number in range(10_000, 10_020)]
    assert all(answer is None or "contents" in answer or answer["code"] == -32800 for answer in answers)


def test_a_long_table_stays_usable_and_its_limits_are_said_once() -> None:
    rows = "".join(f" {number}, 0.0, {number}.25\n" for number in range(1, 60_001))
    text = f"$MODEL\n*NODE\n{rows}*ELEMENT\n 1, 1, 2\n*ELEMENT SETS\n SET=Riser\n 1\n"
    with raw_client() as client:
        client.begin()
        client.open("untitled:deck", text)
        client.findings("untitled:deck")
        said = [each for each in client.notifications if each["method"] == "window/showMessage"]
        assert [each["params"]["message"] for each in said] == [LIMITS]
        for version in range(2, 12):
            place = {"line": 60_005, "character": 1}
            change = {"range": {"start": place, "end": place}, "text": "2, "}
            identifier = {"uri": "untitled:deck", "version": version}
            client.notify("textDocument/didChange", {"textDocument": identifier, "contentChanges": [change]})
        client.send(
            id="waits", method="textDocument/hover", params={**AT, "position": {"line": 30_000, "character": 2}}
        )
        assert "node **29999**" in client.answer("waits")["contents"]["value"]
        shown = [each for each in client.notifications if each["method"] == "textDocument/publishDiagnostics"]
        assert [each["params"]["version"] for each in shown] == [11]
        client.notifications.clear()
        tokens = client.ask("textDocument/semanticTokens/full", AT)
        assert len(tokens["data"]) < 1000
        assert client.end() == 0


def test_a_text_of_100_million_characters_is_not_checked() -> None:
    with raw_client() as client:
        client.begin()
        client.open("untitled:deck", "$MODEL\n" + " 1, 2\n" * 16_700_000)
        assert client.findings("untitled:deck") == []
        said = [each["params"]["message"] for each in client.notifications]
        assert said == [
            "deck has 100 million characters, and more than 64 million are not checked here: use mudline lint"
        ]
        assert client.ask("textDocument/hover", AT) is None
        assert client.lives()
