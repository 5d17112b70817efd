"""Position encodings, line ends and tabs, over the protocol; and what is read for a deck outside the workspace."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.builders.decks import CLEAN
from tests.lsp.raw import RawClient, raw_client

LINES = (
    "$MODEL\r\n*ELEMENT SETS\r\n\tSET=\u00d6l \U0001f60b 1\r\n\t1\r\n*SEABED FRICTION\r\n\tSET=\u00d6l \U0001f60b 1\r\n"
)
WIDTHS = {"utf-8": 10, "utf-16": 7, "utf-32": 6}
"""Units of the name of the set."""


@pytest.fixture(scope="module", params=WIDTHS)
def agreed(request: pytest.FixtureRequest) -> Iterator[tuple[str, RawClient]]:
    with raw_client() as client:
        begun = client.begin(general={"positionEncodings": ["utf-7", request.param]})
        assert begun["capabilities"]["positionEncoding"] == request.param
        yield request.param, client


def test_places_are_in_the_units_that_were_agreed(agreed: tuple[str, RawClient]) -> None:
    encoding, client = agreed
    client.open("untitled:lines", LINES)
    asked = {"textDocument": {"uri": "untitled:lines"}, "position": {"line": 5, "character": 5 + WIDTHS[encoding]}}
    (found,) = client.ask("textDocument/definition", asked)
    assert found["range"] == {
        "start": {"line": 2, "character": 5},
        "end": {"line": 2, "character": 5 + WIDTHS[encoding]},
    }
    renamed = client.ask("textDocument/rename", {**asked, "newName": "Gas"})
    assert [edit["range"]["end"]["character"] for edit in renamed["changes"]["untitled:lines"]] == [
        5 + WIDTHS[encoding],
        5 + WIDTHS[encoding],
    ]
    change = {"range": found["range"], "text": "Gas"}
    identifier = {"uri": "untitled:lines", "version": 2}
    client.notify("textDocument/didChange", {"textDocument": identifier, "contentChanges": [change]})
    assert client.ask("textDocument/definition", {**asked, "position": {"line": 2, "character": 6}})[0]["range"] == {
        "start": {"line": 2, "character": 5},
        "end": {"line": 2, "character": 8},
    }


def test_files_beside_a_deck_outside_the_workspace_are_not_listed(
    agreed: tuple[str, RawClient], tmp_path: Path
) -> None:
    _, client = agreed
    (tmp_path / "secret.keyxm").write_text(CLEAN, encoding="utf-8")
    uri = (tmp_path / "deck.keyxm").as_uri()
    client.open(uri, "$LOAD CASE\n*RESTART\n LAST=\n")
    asked: dict[str, Any] = {"textDocument": {"uri": uri}, "position": {"line": 2, "character": 6}}
    assert client.ask("textDocument/completion", asked)["items"] == []
    folder = {"uri": tmp_path.as_uri(), "name": "folder"}
    client.notify("workspace/didChangeWorkspaceFolders", {"event": {"added": [folder], "removed": []}})
    assert [each["label"] for each in client.ask("textDocument/completion", asked)["items"]] == ["secret.keyxm"]
    client.notify("workspace/didChangeWorkspaceFolders", {"event": {"added": [], "removed": [folder]}})
    assert client.ask("textDocument/completion", asked)["items"] == []
