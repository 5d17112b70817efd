"""Findings as you type and their fixes, over the protocol."""

from __future__ import annotations

import pytest
from lsprotocol import types

from mudline.checks.engine import Fixing, LintSettings, lint_bytes
from mudline.checks.fixing import lint_one
from mudline.checks.registry import select
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN, UNSORTED
from tests.helpers.samples import SAMPLES
from tests.tools.lsp.editor import Editor, applied, codes, document, position

pytestmark = pytest.mark.asyncio(loop_scope="session")

WHOLE = types.Range(types.Position(0, 0), types.Position(10**6, 0))
LONG = [*range(1, 3)] * 11
BASE = "$MODEL\n*NODE\n 1, 0.0, 0.0\n 2, 0.0, 10.0\n*ELEMENT\n 1, 1, 2\n*ELEMENT SETS\n SET=Riser\n 1\n"
NEXT = "$MODEL\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=Riser\n STIFFNESS=5000.0\n$LOAD CASE\n*RESTART\n LAST=base\n"


async def test_a_deck_shows_what_lint_finds_in_it(editor: Editor) -> None:
    text = (SAMPLES / "broken.keyxm").read_text(encoding="utf-8")
    uri = editor.uri("broken.keyxm")
    shown = await editor.shown(uri, lambda: editor.send_open(uri, text))
    found = lint_bytes(text.encode(), "broken.keyxm", select(), folder=editor.folder)
    assert [(one.code, one.message) for one in shown] == [(one.code, one.message) for one in found]
    places = [(one.range.start.line + 1, one.range.start.character + 1) for one in shown]
    assert places == [(one.line, one.column) for one in found]
    assert {one.source for one in shown} == {"mudline"}
    assert all(one.code_description and one.code_description.href for one in shown)


async def test_what_is_under_a_finding_is_listed_there(editor: Editor) -> None:
    text = "$MODEL\n*NODE\n 1, 0.0\n 2, 0.0\n 3, 0.0\n"
    uri = editor.uri("deck.keyxm")
    shown = await editor.shown(uri, lambda: editor.send_open(uri, text))
    (cause,) = [one for one in shown if one.code == "SYN003"]
    related = [
        (one.location.range.start.line, one.message.partition(" ")[0]) for one in cause.related_information or ()
    ]
    assert related == [(3, "SYN003"), (4, "SYN003")]


async def test_typing_changes_findings(editor: Editor) -> None:
    uri = await editor.open(CLEAN)
    at = position(CLEAN, "$MODEL")
    assert codes(await editor.change(uri, 2, (at, at, "*OCAEN\n"))) == ["SYN007", "SYN009"]
    end = types.Position(at.line + 1, 0)
    assert await editor.change(uri, 3, (at, end, "")) == []


async def test_a_change_older_than_the_text_is_dropped(editor: Editor) -> None:
    uri = await editor.open(CLEAN, version=5)
    editor.send_change(uri, 4, "$MODLE\n")
    assert await editor.change(uri, 6, (types.Position(0, 0), types.Position(0, 0), "C a comment\n")) == []


async def test_findings_go_when_a_deck_is_closed(editor: Editor) -> None:
    uri = await editor.open(BAD_NUMBER)
    params = types.DidCloseTextDocumentParams(document(uri))
    assert await editor.shown(uri, lambda: editor.client.text_document_did_close(params)) == []


async def test_a_continued_deck_is_checked_with_its_dependents(editor: Editor) -> None:
    base = await editor.open(BASE, "base.keyxm")
    uri = editor.uri("next.keyxm")
    assert "REF001" not in codes(await editor.shown(uri, lambda: editor.send_open(uri, NEXT)))
    at, behind = position(BASE, "Riser"), position(BASE, "Riser", "Riser")
    unsaved = await editor.shown(uri, lambda: editor.send_change(base, 2, (at, behind, "Other")))
    assert "REF001" in codes(unsaved)
    again = await editor.shown(uri, lambda: editor.send_change(base, 3, BASE))
    assert "REF001" not in codes(again)


async def test_a_change_of_a_file_on_the_disk_is_seen(editor: Editor) -> None:
    (editor.folder / "base.keyxm").write_text(BASE, encoding="utf-8")
    uri = await editor.open(NEXT, "next.keyxm")
    (editor.folder / "base.keyxm").write_text(BASE.replace("Riser", "Another"), encoding="utf-8")
    event = types.FileEvent(editor.uri("base.keyxm"), types.FileChangeType.Changed)
    params = types.DidChangeWatchedFilesParams([event])
    assert "REF001" in codes(await editor.shown(uri, lambda: editor.client.workspace_did_change_watched_files(params)))


async def test_the_configuration_of_the_project_holds(editor: Editor) -> None:
    (editor.folder / "mudline.toml").write_text('ignore = ["SYN009"]\n', encoding="utf-8")
    text = CLEAN + "*OCAEN\n"
    uri = editor.uri("deck.keyxm")
    assert await editor.shown(uri, lambda: editor.send_open(uri, text)) == []
    (editor.folder / "mudline.toml").write_text('[severity]\nSYN009 = "error"\n', encoding="utf-8")
    params = types.DidChangeWatchedFilesParams(
        [types.FileEvent(editor.uri("mudline.toml"), types.FileChangeType.Changed)]
    )
    shown = await editor.shown(uri, lambda: editor.client.workspace_did_change_watched_files(params))
    assert [(one.code, one.severity) for one in shown] == [("SYN009", types.DiagnosticSeverity.Error)]
    (editor.folder / "mudline.toml").write_text('exclude = ["deck.*"]\n', encoding="utf-8")
    assert await editor.shown(uri, lambda: editor.client.workspace_did_change_watched_files(params)) == []


async def test_a_fault_of_the_configuration_is_shown_once(editor: Editor) -> None:
    (editor.folder / "mudline.toml").write_text('ignroe = ["SYN009"]\n', encoding="utf-8")
    before = len(editor.client.messages)
    uri = await editor.open(CLEAN)
    await editor.change(uri, 2, CLEAN + "C more\n")
    assert [("ignroe" in one.message) for one in editor.client.messages[before:]] == [True]


async def test_decks_in_json_and_yaml_are_checked(editor: Editor) -> None:
    text = '{"format": "mudline-deck/1", "sections": [{"name": "MODEL"}]}'
    uri = editor.uri("deck.json")
    shown = await editor.shown(uri, lambda: editor.send_open(uri, text, language="json"))
    assert codes(shown) == ["DOC002"]
    other = editor.uri("package.json")
    assert await editor.shown(other, lambda: editor.send_open(other, '{"name": 1}', language="json")) == []
    uri = "untitled:Untitled-1"
    yaml = "format: mudline-deck/1\nsections: 3\n"
    assert codes(await editor.shown(uri, lambda: editor.send_open(uri, yaml, language="yaml"))) == ["DOC002"]


async def test_a_finding_has_its_fix(editor: Editor) -> None:
    text = CLEAN + "*OCAEN\n"
    uri = await editor.open(text)
    place = position(text, "OCAEN")
    params = types.CodeActionParams(document(uri), types.Range(place, place), types.CodeActionContext([]))
    actions = await editor.client.text_document_code_action_async(params)
    (action,) = actions or []
    assert isinstance(action, types.CodeAction)
    assert action.title == "SYN009: write *OCEAN (may change what the deck means)"
    assert not action.is_preferred
    assert action.edit is not None
    assert action.edit.changes is not None
    assert applied(text, list(action.edit.changes[uri])) == CLEAN + "*OCEAN\n"


async def test_all_safe_fixes_are_made_at_once(editor: Editor) -> None:
    text = UNSORTED.replace(" 1, 2\n*GEO", f" {', '.join(map(str, LONG))}\n*GEO")
    uri = await editor.open(text)
    only: list[types.CodeActionKind | str] = [types.CodeActionKind.SourceFixAll]
    params = types.CodeActionParams(document(uri), WHOLE, types.CodeActionContext([], only=only))
    (action,) = await editor.client.text_document_code_action_async(params) or []
    assert isinstance(action, types.CodeAction)
    assert action.edit is None
    resolved = await editor.client.code_action_resolve_async(action)
    settings = LintSettings(select(), fixing=Fixing.SAFE)
    fixed = lint_one("deck.keyxm", text.encode(), settings, editor.folder).changed
    assert fixed is not None
    assert resolved.edit is not None
    assert resolved.edit.changes is not None
    assert applied(text, list(resolved.edit.changes[uri])).encode() == fixed


async def test_findings_that_are_not_to_be_fixed_have_no_fix(editor: Editor) -> None:
    (editor.folder / "mudline.toml").write_text('unfixable = ["SYN009"]\n', encoding="utf-8")
    uri = await editor.open(CLEAN + "*OCAEN\n")
    params = types.CodeActionParams(document(uri), WHOLE, types.CodeActionContext([]))
    assert not await editor.client.text_document_code_action_async(params)
