"""Definitions, uses and new names, over the protocol."""

from __future__ import annotations

import pytest
from lsprotocol import types
from pygls.exceptions import JsonRpcException

from tests.helpers.builders.decks import CLEAN
from tests.tools.lsp.editor import Editor, applied, document, position

pytestmark = pytest.mark.asyncio(loop_scope="session")

DECK = (
    "$PREPROCESSOR\n*PARAMETERS\n depth, 100.0\n twice, =[depth*2]\n Point, /X:1, Y:2/\n"
    "*VARIATION\n NAME=Depths\n PARA=depth, VALUE=90.0, 100.0\n"
    + CLEAN.replace(" 100.0, 1025.0", " =[Depth], 1025.0").replace(
        " SET=Pipe\n 1, 2\n", ' SET=Pipe\n 1, 2\n SET=All of it\n SUBSET="pipe"\n SET=Part\n GEN=1, 2\n'
    )
    + "*PROPERTIES\n SET=Pipe\n 1, 2\n$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n GEN=1, 3, 2\n"
)
BASE = CLEAN
NEXT = "$MODEL\n*SEABED FRICTION\n SET=PIPE\n COEFFICIENTS=0.3, 0.5\n$LOAD CASE\n*RESTART\n LAST=base\n"


def shown(text: str, places: list[types.Location] | None) -> list[str]:
    """The texts at some places of a deck, each with its line."""
    lines = text.split("\n")
    found = [(place.range.start, place.range.end) for place in places or ()]
    assert all(start.line == end.line for start, end in found)
    return [f"{start.line + 1}:{lines[start.line][start.character : end.character]}" for start, end in found]


async def definition(editor: Editor, uri: str, place: types.Position) -> list[types.Location]:
    found = await editor.client.text_document_definition_async(types.DefinitionParams(document(uri), place))
    assert isinstance(found, list | tuple)
    return [each for each in found if isinstance(each, types.Location)]


async def references(editor: Editor, uri: str, place: types.Position) -> list[types.Location]:
    params = types.ReferenceParams(types.ReferenceContext(include_declaration=True), document(uri), place)
    return list(await editor.client.text_document_references_async(params) or ())


@pytest.mark.parametrize(
    ("mark", "behind", "defined", "used"),
    [
        ("SET=Pipe\n STIFF", "SET=", ["20:Pipe"], 5),
        ("STIFFNESS=Clay", "STIFFNESS=C", ["35:Clay"], 2),
        ("=[Depth]", "=[", ["3:depth"], 4),
        (" 2, 2, 3", " 2, ", ["14:2"], 0),
        (" 2, 2, 3", " ", ["18:2"], 0),
    ],
)
async def test_names_and_numbers_lead_to_their_definition(
    editor: Editor, mark: str, behind: str, defined: list[str], used: int
) -> None:
    uri = await editor.open(DECK)
    place = position(DECK, mark, behind)
    assert shown(DECK, await definition(editor, uri, place)) == defined
    found = shown(DECK, await references(editor, uri, place))
    assert len(found) == used, found
    assert set(defined) <= set(found) or not used
    highlights = await editor.client.text_document_document_highlight_async(
        types.DocumentHighlightParams(document(uri), place)
    )
    assert len(highlights or ()) == used


async def test_a_node_of_a_deck_before_is_found(editor: Editor) -> None:
    base = await editor.open(BASE, "base.keyxm")
    text = NEXT.replace("$MODEL\n", "$MODEL\n*ELEMENT\n 9, 3, 88\n 10, 1.5, 1e300\n")
    uri = await editor.open(text, "next.keyxm")
    (found,) = await definition(editor, uri, position(text, " 9, 3", " 9, "))
    assert (found.uri, shown(BASE, [found])) == (base, ["7:3"])
    for number in ("88", "1.5", "1e300"):
        assert await definition(editor, uri, position(text, number)) == []


async def test_a_file_is_its_own_definition(editor: Editor) -> None:
    await editor.open(BASE, "base.keyxm")
    uri = await editor.open(NEXT, "next.keyxm")
    (found,) = await definition(editor, uri, position(NEXT, "LAST=base", "LAST="))
    assert found.uri == editor.uri("base.keyxm")
    (named,) = await references(editor, uri, position(NEXT, "LAST=base", "LAST="))
    assert (named.uri, shown(NEXT, [named])) == (uri, ["7:base"])


@pytest.mark.parametrize("opened", [True, False])
async def test_a_set_of_a_deck_before_is_found_and_renamed(editor: Editor, *, opened: bool) -> None:
    (editor.folder / "base.keyxm").write_text(BASE, encoding="utf-8")
    base = await editor.open(BASE, "base.keyxm") if opened else editor.uri("base.keyxm")
    uri = await editor.open(NEXT, "next.keyxm")
    place = position(NEXT, "PIPE")
    (found,) = await definition(editor, uri, place)
    assert (found.uri, shown(BASE, [found])) == (base, ["12:Pipe"])
    edit = await editor.client.text_document_rename_async(types.RenameParams(document(uri), place, "Riser"))
    assert edit is not None
    assert edit.changes is not None
    assert applied(BASE, list(edit.changes[base])) == BASE.replace("SET=Pipe", "SET=Riser")
    assert applied(NEXT, list(edit.changes[uri])) == NEXT.replace("PIPE", "Riser")


@pytest.mark.parametrize(
    ("mark", "behind", "name", "changes"),
    [
        ("SET=Pipe\n STIFF", "SET=", "Riser 1", [("SET=Pipe", "SET=Riser 1"), ('"pipe"', '"Riser 1"')]),
        ("CURVE=Clay", "CURVE=", "Sand", [("=Clay", "=Sand")]),
        (
            " depth, 100",
            " ",
            "water",
            [
                (" depth, 100", " water, 100"),
                ("=[depth*2]", "=[water*2]"),
                ("=[Depth]", "=[water]"),
                ("PARA=depth", "PARA=water"),
            ],
        ),
    ],
)
async def test_a_thing_is_renamed_wherever_it_is_named(
    editor: Editor, mark: str, behind: str, name: str, changes: list[tuple[str, str]]
) -> None:
    uri = await editor.open(DECK)
    place = position(DECK, mark, behind)
    prepared = await editor.client.text_document_prepare_rename_async(types.PrepareRenameParams(document(uri), place))
    assert isinstance(prepared, types.PrepareRenamePlaceholder)
    edit = await editor.client.text_document_rename_async(types.RenameParams(document(uri), place, name))
    assert edit is not None
    assert edit.changes is not None
    expected = DECK
    for old, new in changes:
        expected = expected.replace(old, new)
    assert applied(DECK, list(edit.changes[uri])) == expected


@pytest.mark.parametrize(
    ("mark", "behind", "name", "reason"),
    [
        ("SET=Pipe", "SET=", "All of it", "set 'All of it' is already defined"),
        ("SET=Pipe", "SET=", "ALL", "set 'ALL' is already defined"),
        ("SET=Pipe", "SET=", "a, b", "cannot be the name of a set"),
        ("SET=Pipe", "SET=", "", "cannot be the name of a set"),
        ("SET=Pipe", "SET=", "a\nb", "cannot be the name of a set"),
        ("SET=Pipe", "SET=", "x" * 300, "at most 256 characters"),
        (" depth, 100", " ", "twice", "parameter 'twice' is already defined"),
        (" depth, 100", " ", "2*x", "cannot be used in an equation"),
        (" depth, 100", " ", "pi", "cannot be used in an equation"),
        (" depth, 100", " ", "point_x", "parameter 'point_x' is already defined"),
        ("$MODEL", "$", "x", "only sets, curves and parameters can be renamed"),
    ],
)
async def test_a_name_that_cannot_be_given_is_refused(
    editor: Editor, mark: str, behind: str, name: str, reason: str
) -> None:
    uri = await editor.open(DECK)
    params = types.RenameParams(document(uri), position(DECK, mark, behind), name)
    with pytest.raises(JsonRpcException, match=reason):
        await editor.client.text_document_rename_async(params)


async def test_what_lines_define_is_not_renamed(editor: Editor) -> None:
    text = CLEAN.replace("*ELEMENT SETS\n SET=Pipe\n 1, 2\n", "*LINES\n NAME=Pipe\n")
    uri = await editor.open(text)
    params = types.PrepareRenameParams(document(uri), position(text, "SET=Pipe", "SET="))
    with pytest.raises(JsonRpcException, match="rename it by hand"):
        await editor.client.text_document_prepare_rename_async(params)
