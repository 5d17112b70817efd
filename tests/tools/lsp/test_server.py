"""The server as a process: what is agreed with it, decks of any size, and messages that no editor should send.

Nothing outside of the workspace is read aloud.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from mudline.language.keywords import catalogue
from mudline.language.keywords.values import Names
from mudline.tools.lsp.decks import Decks
from tests.helpers.builders.decks import CLEAN
from tests.tools.lsp.raw import RawClient, raw_client

URI = "untitled:deck"
AT: dict[str, Any] = {"textDocument": {"uri": URI}, "position": {"line": 3, "character": 1}}
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
HOVER = b'{"jsonrpc": "2.0", "id": "x", "method": "textDocument/hover", "params": '
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
        HOVER + b"[" * 100_000 + b"]" * 100_000 + b"}",
        b'{"a":' * 100_000 + b"1" + b"}" * 100_000,
        HOVER + b"9" * 100_000 + b"}",
        HOVER + b'{"textDocument": {"uri": "untitled:deck"}, "position": {"line": 1e400, "character": NaN}}}',
        json.dumps([{"jsonrpc": "2.0", "id": 1, "method": "shutdown"}] * 3).encode(),
    ],
    ids=[*"eaonudk", "lists", "objects", "digits", "infinite", "batch"],
)
def test_bodies_that_no_editor_sends_are_passed_over(client: RawClient, body: bytes) -> None:
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
    monkeypatch.setattr("mudline.tools.lsp.decks.LARGEST_OPEN", 10)
    decks = Decks()
    decks.open("untitled:deck", "$MODLE\n*OCAEN\n", 1, "mudline")
    found = decks.analysis("untitled:deck")
    assert found is not None
    assert found.document.is_too_large
    assert (found.context, found.found) == (None, ())


# ------------------------------------------------------------------------------------------------ columns, and the end

LINES = (
    "$MODEL\r\n*ELEMENT SETS\r\n\tSET=\u00d6l \U0001f60b 1\r\n\t1\r\n*SEABED FRICTION\r\n\tSET=\u00d6l \U0001f60b 1\r\n"
)


@pytest.mark.parametrize("offered", [["utf-8", "utf-16"], ["utf-32"]])
def test_places_are_in_utf_16_whatever_else_an_editor_offers(offered: list[str]) -> None:
    width = 7
    with raw_client() as client:
        watching = {"didChangeWatchedFiles": {"dynamicRegistration": True}}
        begun = client.begin(general={"positionEncodings": offered}, workspace=watching)
        client.notify("initialized", {})
        assert begun["capabilities"]["positionEncoding"] == "utf-16"
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
        if "utf-8" in offered:
            assert client.end() == 0
        else:  # without a word before
            client.stdin.close()
            assert client.process.wait(30) == 1
            assert client.process.stderr is not None
            assert client.process.stderr.read() == b""


# ------------------------------------------------------------------------------- messages out of order, twice and huge


def test_a_request_before_the_beginning_is_survived() -> None:
    with raw_client() as client:
        client.open(URI, "$MODEL\n")
        client.send(id="early", method="textDocument/hover", params=AT)
        client.notify("exit-not")
        client.begin()
        assert client.lives()
        client.begin()
        assert client.lives()
        assert client.end() == 0


def test_nothing_is_done_behind_the_shutdown() -> None:
    with raw_client() as client:
        client.begin()
        client.ask("shutdown")
        client.open(URI, "$MODLE\n")
        client.send(id="late", method="textDocument/hover", params=AT)
        assert client.answer("late")["code"] == -32600
        client.notify("exit")
        assert client.process.wait(30) == 0


def test_a_document_is_opened_and_closed_twice(client: RawClient) -> None:
    client.open(URI, "$MODLE\n")
    client.open(URI, CLEAN, 0)
    assert client.ask("textDocument/documentSymbol", AT)[0]["name"] == "$MODEL"
    for _ in range(3):
        client.notify("textDocument/didClose", {"textDocument": {"uri": URI}})
    assert client.ask("textDocument/documentSymbol", AT) == []


def test_each_request_of_one_number_is_answered(client: RawClient) -> None:
    client.open(URI, CLEAN)
    for _ in range(3):
        client.send(id="same", method="textDocument/hover", params=AT)
    assert [bool(client.answer("same")) for _ in range(3)] == [True] * 3


@pytest.mark.parametrize(
    "message",
    [
        {"id": 99, "result": None},
        {"id": "x", "error": {"code": 1, "message": "m"}},
        {"id": None, "result": 1},
        {"method": "$/cancelRequest", "params": {"id": 12345}},
        {"method": "$/cancelRequest", "params": {"id": None}},
        {"id": {"a": 1}, "method": "textDocument/hover", "params": AT},
        {"id": [], "method": "shutdown not"},
    ],
    ids=str,
)
def test_answers_to_nothing_and_numbers_that_are_none(client: RawClient, message: dict[str, Any]) -> None:
    client.send(**message)


def test_a_refusal_that_has_no_address_is_no_fault_of_the_server(client: RawClient) -> None:
    client.open(URI, CLEAN)
    client.findings(URI)
    client.send(id={"a": 1}, method="textDocument/rename", params={**AT, "newName": "x"})
    assert client.lives()
    assert "please report" not in str(client.notifications)


@pytest.mark.parametrize(
    "header",
    [
        b"Content-Length: -5\r\n\r\n",
        b"Content-Length: abc\r\n\r\n",
        b"Foo: bar\r\n\r\n",
        b"x" * 1_000_000 + b"\r\n\r\n",
    ],
    ids=["negative", "word", "none", "noise"],
)
def test_headers_that_no_editor_sends(client: RawClient, header: bytes) -> None:
    client.write(header)


def test_a_huge_address(client: RawClient) -> None:
    uri = "file:///" + "x" * 1_000_000
    client.open(uri, "$MODLE\n")
    assert [one["code"] for one in client.findings(uri)] == ["SYN010"]
    client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
    assert client.findings(uri) == []


# --------------------------------------------------------------------------------------------- outside of the workspace

HELD = "text-of-a-neighbour"
NAMING = {
    "RESTART": "$LOAD CASE\n*RESTART\n LAST={}\n",
    "SEABED PROFILE": "$MODEL\n*SEABED PROFILE\n TYPE=2D\n FILE={}\n",
    "VESSEL,INTEGRATED": "$MODEL\n*VESSEL,INTEGRATED\n VESSEL=v\n RAO={}\n FILE={}\n",
    "BODY,INTEGRATED": "$MODEL\n*BODY,INTEGRATED\n BODY=b\n LOCATION=0, 0, 0\n FILE={}\n",
    "RAO": "$LOAD CASE\n*RAO\n VESSEL=v\n FILE={}\n",
    "DRIFT": "$LOAD CASE\n*DRIFT\n VESSEL=v, TYPE=FILE\n FILE={}\n",
    "VESSEL TIMETRACE": "$LOAD CASE\n*VESSEL TIMETRACE\n VESSEL=v\n FILE={}\n",
    "WAVE-TIME-HISTORY": "$LOAD CASE\n*WAVE-TIME-HISTORY\n FILE={}\n",
    "CURRENT": "$LOAD CASE\n*CURRENT\n TYPE=SUBROUTINE, USER={}\n",
    "WINCH": "$LOAD CASE\n*WINCH\n SET=ALL\n FILE={}\n",
    "VARIATION": "$PREPROCESSOR\n*VARIATION\n NAME=n\n ACTION=ADD, KEYWORD=WIND, FILE={}, SECTION=LOAD CASE\n",
    **{each: f"$MODEL\n*{each}\n FILE={{}}\n" for each in ("P-Y", "T-Z", "ADDED MASS", "RADIATION DAMPING")},
    **{each: f"$MODEL\n*{each}\n VESSEL=v\n FILE={{}}\n" for each in ("CURRENT COEFF", "WIND COEFF")},
    "EXCEL VARIATIONS": "$PREPROCESSOR\n*EXCEL VARIATIONS\n EXCEL={}\n",
}
"""Each keyword that names a file, after a whole deck."""


def naming(keyword: str, name: str) -> str:
    return CLEAN + NAMING[keyword].replace("{}", f'"{name}"')


def test_each_keyword_that_names_a_file_is_tried() -> None:
    assert {*catalogue.users(Names.FILE), *catalogue.users(Names.DECK)} == set(NAMING)


@pytest.mark.parametrize("refused", [False, True])
@pytest.mark.parametrize("linked", [False, True])
@pytest.mark.parametrize("kind", NAMING)
def test_no_text_of_a_file_outside_is_shown(
    client: RawClient, tmp_path: Path, kind: str, *, linked: bool, refused: bool
) -> None:
    (tmp_path / "project").mkdir()
    configuration = f"no-outside = {'true' if refused else 'false'}\n"
    (tmp_path / "project" / "mudline.toml").write_text(configuration, encoding="utf-8")
    outside = tmp_path / "neighbour.keyxm"
    outside.write_text(f"{HELD}, {HELD}\n" * 2, encoding="utf-8")
    name = "../neighbour.keyxm"
    if linked:
        name = "near.keyxm"
        (tmp_path / "project" / name).symlink_to(outside)
    text = naming(kind, name)
    uri = (tmp_path / "project" / "deck.keyxm").as_uri()
    client.open(uri, text)
    shown = [client.findings(uri)]
    for line in range(CLEAN.count("\n"), text.count("\n")):
        place = {"textDocument": {"uri": uri}, "position": {"line": line, "character": 8}}
        shown += [client.ask(f"textDocument/{what}", place) for what in ("hover", "completion", "definition")]
    client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
    assert HELD not in json.dumps(shown)


@pytest.mark.parametrize("name", ["/dev/zero", "/proc/self/environ", "/dev/stdin"])
@pytest.mark.parametrize("kind", NAMING)
def test_no_file_of_the_system_is_read(client: RawClient, tmp_path: Path, kind: str, name: str) -> None:
    uri = (tmp_path / "deck.keyxm").as_uri()
    client.open(uri, naming(kind, name))
    assert client.findings(uri) is not None
    client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
