"""Hover and completion, over the protocol."""

from __future__ import annotations

import pytest
from lsprotocol import types

from tests.helpers.builders.decks import CLEAN
from tests.tools.lsp.editor import Editor, applied, document, position

pytestmark = pytest.mark.asyncio(loop_scope="session")

DECK = (
    """\
$PREPROCESSOR
*PARAMETERS
 depth, 100.0
 deeper, =[depth*2]
 Point, /X:1, Y:2/
"""
    + CLEAN.replace(" 100.0, 1025.0", " =[deeper-depth], 1025.0")
    + "$LOAD CASE\n*RESTART\n LAST=base, TYPE=STATIC\n"
)


async def hover(editor: Editor, mark: str, behind: str = "", text: str = DECK) -> str:
    uri = await editor.open(text)
    found = await editor.client.text_document_hover_async(
        types.HoverParams(document(uri), position(text, mark, behind))
    )
    if found is None:
        return ""
    assert isinstance(found.contents, types.MarkupContent)
    return found.contents.value


@pytest.mark.parametrize(
    ("mark", "behind", "words"),
    [
        ("$MODEL", "$", ["**$MODEL**", "`*SEABED STIFFNESS`"]),
        ("*SEABED PROPERTIES", "*", ["Rigid or elastic seabed", "FRICTION=", "follows the last record"]),
        (
            "STIFFNESS=Clay",
            "",
            ["linear stiffness per unit length", "unit N/m2", "range >= 0", "usual 478 to 2.1e+11 N/m2"],
        ),
        ("STIFFNESS=Clay", "STIFFNESS=C", ["curve Clay: 3 points, ratio 0 to 0.5", "followed by 2 elements"]),
        ("SET=Pipe\n STIFF", "SET=P", ["set **Pipe**: 2 elements", "1, 2", "D = 0.5 m"]),
        ("=[deeper-depth]", "=[deeper", ["parameter **deeper** = 200", "=[depth*2]"]),
        ("=[deeper-depth]", "=", ["`=[deeper-depth]` = 100", "unit m"]),
        (" 0.1, 1000.0", " 0.", ["point 2 of 3", "up to here: slope 10000 N/m, stiffness 20000 N/m2", "from here"]),
        (" 2, -0.1, 10.0", " ", ["node **2**: X -0.1, Y 10", "of elements 1, 2"]),
        (" 2, 2, 3", " ", ["element **2**: nodes 2 and 3", "D = 0.5 m", "'Pipe'"]),
        ("TYPE=ELASTIC", "TYPE=E", ["contact model", "RIGID, ELASTIC"]),
        ("0.46", "0", ["internal diameter", "unit m"]),
        ("LAST=base", "LAST=b", ["this file was not found"]),
    ],
)
async def test_hover_explains_what_is_there(editor: Editor, mark: str, behind: str, words: list[str]) -> None:
    text = await hover(editor, mark, behind)
    assert [word for word in words if word not in text] == [], text


FAULTY = (
    CLEAN.replace(" 2, 2, 3", " 2, 2, 99\n 3, 1, 1.5")
    .replace(" SET=Pipe\n 1, 2\n", " SET=Pipe\n 1, 2, 77\n SET=End\n 2\n", 1)
    .replace(" 0.46, 7850.0\n", " 0.46, 7850.0\n SET=End\n 207.0E9, 79.6E9, 0.3, 0.26, 7850.0\n")
    .replace(" 100.0, 1025.0", " =[nothing], 1025.0")
    .replace(" 0.1, 1000.0\n 0.5, 3000.0\n", "")
    + "*LINE PATHS\n x\n*EMBEDMENT\n SET=Nowhere\n 0.0, 0.0\n 0.5, 900.0\n"
)


@pytest.mark.parametrize(
    ("mark", "behind", "words"),
    [
        ("=[nothing]", "=[no", ["parameter `nothing` is not defined"]),
        ("=[nothing]", "=", ["no value: "]),
        (" 2, 2, 99", " 2, 2, 9", ["node 99 is not defined here"]),
        (" 3, 1, 1.5", " 3, 1, 1", ["node"]),
        (" 1, 2, 77", " 1, 2, 7", ["element 77 is not defined here"]),
        ("SET=Pipe\n STIFF", "SET=P", ["D = 0.3 to 0.5 m"]),
        ("STIFFNESS=Clay", "STIFFNESS=C", ["curve Clay cannot be evaluated"]),
        ("*LINE PATHS", "*", ["passed through unchanged"]),
        ("*EMBEDMENT", "*", ["Superseded by"]),
        ("SET=Nowhere", "SET=N", ["**SET="]),
        ("0.5, 900.0", "0", ["point 2 of 2 of the curve of set Nowhere"]),
    ],
)
async def test_hover_says_what_is_not_there(editor: Editor, mark: str, behind: str, words: list[str]) -> None:
    text = await hover(editor, mark, behind, FAULTY)
    assert [word for word in words if word not in text] == [], text


async def complete(editor: Editor, text: str, mark: str, behind: str) -> dict[str, types.CompletionItem]:
    uri = await editor.open(text)
    found = await editor.client.text_document_completion_async(
        types.CompletionParams(document(uri), position(text, mark, behind))
    )
    assert isinstance(found, types.CompletionList)
    return {item.label: item for item in found.items}


def accepted(text: str, item: types.CompletionItem) -> str:
    assert isinstance(item.text_edit, types.TextEdit)
    return applied(text, [item.text_edit])


async def test_keywords_of_the_section_are_completed(editor: Editor) -> None:
    text = CLEAN + "*SEAB\n"
    items = await complete(editor, text, "*SEAB\n", "*SEAB")
    assert {"*SEABED PROPERTIES", "*SEABED FRICTION", "*OCEAN"} <= items.keys()
    assert "*PARAMETERS" not in items
    assert "*TIME" not in items
    assert accepted(text, items["*SEABED FRICTION"]) == CLEAN + "*SEABED FRICTION\n"
    resolved = await editor.client.completion_item_resolve_async(items["*SEABED FRICTION"])
    assert isinstance(resolved.documentation, types.MarkupContent)
    assert "COEFFICIENTS=" in resolved.documentation.value


async def test_whole_blocks_are_snippets(editor: Editor) -> None:
    items = await complete(editor, CLEAN + "\n", "3000.0\n", "3000.0\n")
    block = items["*SEABED STIFFNESS ..."]
    assert block.insert_text_format == types.InsertTextFormat.Snippet
    assert isinstance(block.text_edit, types.TextEdit)
    assert block.text_edit.new_text.startswith("*SEABED STIFFNESS\n CURVE=${1:clay}\n ${2:0.0}, ${3:0.0}\n")


@pytest.mark.parametrize(
    ("line", "label", "result"),
    [
        (" ST", "STIFFNESS=", " STIFFNESS="),
        (" TYPE=", "ELASTIC", " TYPE=ELASTIC"),
        (" TYPE=RI", "RIGID", " TYPE=RIGID"),
        (" SET=P", "Pipe", " SET=Pipe"),
        (" SET=", "ALL", " SET=ALL"),
        (" STIFFNESS=", "Clay", " STIFFNESS=Clay"),
        (" LATERAL=2*=[dee", "deeper", None),
        (" LATERAL==[sq", "sqrt", " LATERAL==[sqrt("),
    ],
)
async def test_settings_values_and_names_are_completed(
    editor: Editor, line: str, label: str, result: str | None
) -> None:
    text = DECK.replace(" STIFFNESS=Clay\n", f"{line}\n")
    items = await complete(editor, text, f"{line}\n", line)
    assert label in items
    if result is not None:
        assert accepted(text, items[label]) == DECK.replace(" STIFFNESS=Clay\n", f"{result}\n")


async def test_files_beside_the_deck_are_completed(editor: Editor) -> None:
    (editor.folder / "base.keyxm").write_text(CLEAN, encoding="utf-8")
    assert "base.keyxm" in await complete(editor, DECK, "LAST=base", "LAST=")


async def test_nothing_is_completed_in_a_comment(editor: Editor) -> None:
    text = CLEAN + "C SET=\n"
    assert await complete(editor, text, "C SET=", "C SET=") == {}
