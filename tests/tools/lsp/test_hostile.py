"""Messages out of order, twice, and huge; and that nothing outside of the workspace is read aloud."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from mudline.language.keywords import catalogue
from mudline.language.keywords.values import Names
from tests.helpers.builders.decks import CLEAN
from tests.tools.lsp.raw import RawClient, raw_client

URI = "untitled:deck"
AT: dict[str, Any] = {"textDocument": {"uri": URI}, "position": {"line": 3, "character": 1}}
HOVER = b'{"jsonrpc": "2.0", "id": "x", "method": "textDocument/hover", "params": '


@pytest.fixture(scope="module")
def started() -> Iterator[RawClient]:
    with raw_client() as client:
        client.begin()
        yield client


@pytest.fixture
def client(started: RawClient) -> Iterator[RawClient]:
    yield started
    assert started.lives()


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
    "body",
    [
        HOVER + b"[" * 100_000 + b"]" * 100_000 + b"}",
        b'{"a":' * 100_000 + b"1" + b"}" * 100_000,
        HOVER + b"9" * 100_000 + b"}",
        HOVER + b'{"textDocument": {"uri": "untitled:deck"}, "position": {"line": 1e400, "character": NaN}}}',
        json.dumps([{"jsonrpc": "2.0", "id": 1, "method": "shutdown"}] * 3).encode(),
    ],
    ids=["lists", "objects", "digits", "infinite", "batch"],
)
def test_bodies_that_no_editor_sends(client: RawClient, body: bytes) -> None:
    client.body(body)


@pytest.mark.parametrize(
    "header",
    [
        b"Content-Length: -5\r\n\r\n",
        b"Content-Length: abc\r\n\r\n",
        b"Content-Length: " + b"9" * 5000 + b"\r\n\r\n",
        b"content-length:" + b"9" * 20 + b"\r\n\r\n",
        b"Foo: bar\r\n\r\n",
        b"x" * 1_000_000 + b"\r\n\r\n",
    ],
    ids=["negative", "word", "digits", "large", "none", "noise"],
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
