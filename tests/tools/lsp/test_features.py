"""Outline, folding, layout and hints, over the protocol."""

from __future__ import annotations

import pytest
from lsprotocol import types
from pygls.exceptions import JsonRpcException

from mudline.editing.formatting.document import formatted
from mudline.language.deck.loading import dump, load_bytes
from mudline.tools.lsp.structure import LEGEND
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN
from tests.tools.lsp.editor import Editor, applied, document

pytestmark = pytest.mark.asyncio(loop_scope="session")

PARAMETERS = "$PREPROCESSOR\n*PARAMETERS\n depth, 100.0\n wide, =[depth/2]\n"
CURVE = CLEAN.replace("STIFFNESS=Clay", "STIFFNESS=Clay\n LATERAL==[wide*2]")
WHOLE = types.Range(types.Position(0, 0), types.Position(10**6, 0))


async def test_the_outline_has_sections_keywords_and_names(editor: Editor) -> None:
    text = PARAMETERS + CLEAN
    uri = await editor.open(text)
    symbols = await editor.client.text_document_document_symbol_async(types.DocumentSymbolParams(document(uri)))
    tree = [symbol for symbol in symbols or () if isinstance(symbol, types.DocumentSymbol)]
    assert [symbol.name for symbol in tree] == ["$PREPROCESSOR", "$MODEL"]
    blocks = {block.name: block for symbol in tree for block in symbol.children or ()}
    assert list(blocks)[:4] == ["*PARAMETERS", "*OCEAN", "*NODE", "*ELEMENT"]
    assert [one.name for one in blocks["*PARAMETERS"].children or ()] == ["depth", "wide"]
    assert [one.name for one in blocks["*SEABED STIFFNESS"].children or ()] == ["Clay"]
    assert [one.name for one in blocks["*SEABED PROPERTIES"].children or ()] == ["Pipe"]
    node = blocks["*NODE"]
    assert (node.range.start.line, node.range.end.line) == (7, 10)
    assert node.selection_range == types.Range(types.Position(7, 0), types.Position(7, 5))


async def test_a_deck_in_json_has_no_places(editor: Editor) -> None:
    """It is read as the keyword text that it becomes, whose places are not those of the file."""
    uri = await editor.open(dump(load_bytes(CLEAN.encode(), "deck.keyxm"), "json"), "deck.json")
    assert await editor.client.text_document_document_symbol_async(types.DocumentSymbolParams(document(uri))) == []
    at = types.Position(1, 1)
    assert await editor.client.text_document_hover_async(types.HoverParams(document(uri), at)) is None
    offered = await editor.client.text_document_completion_async(types.CompletionParams(document(uri), at))
    assert isinstance(offered, types.CompletionList)
    assert not offered.items


async def test_sections_blocks_and_comments_fold(editor: Editor) -> None:
    text = CLEAN.replace("*NODE\n", "*NODE\nC one\nC two\n")
    uri = await editor.open(text)
    ranges = await editor.client.text_document_folding_range_async(types.FoldingRangeParams(document(uri)))
    found = {(one.start_line, one.end_line, one.kind) for one in ranges or ()}
    assert (0, text.count("\n") - 1, "region") in found
    assert (3, 8, "region") in found
    assert (4, 5, "comment") in found


UGLY = CLEAN.replace(" 1, -0.1, 0.0\n", "1,-0.1,0.0\n").replace(" 0.1, 1000.0\n", "0.1,1000.0\n")


async def test_a_deck_is_formatted(editor: Editor) -> None:
    uri = await editor.open(UGLY)
    options = types.FormattingOptions(tab_size=4, insert_spaces=True)
    edits = await editor.client.text_document_formatting_async(types.DocumentFormattingParams(document(uri), options))
    assert applied(UGLY, list(edits or ())).encode() == formatted(UGLY.encode(), "deck.keyxm")


async def test_a_deck_with_an_error_is_not_formatted(editor: Editor) -> None:
    uri = await editor.open(BAD_NUMBER)
    options = types.FormattingOptions(tab_size=4, insert_spaces=True)
    with pytest.raises(JsonRpcException, match=r"correct the error in line 6 first \(SYN002\)"):
        await editor.client.text_document_formatting_async(types.DocumentFormattingParams(document(uri), options))


async def test_equations_have_hints(editor: Editor) -> None:
    text = PARAMETERS + CURVE
    uri = await editor.open(text)
    hints = await editor.client.text_document_inlay_hint_async(types.InlayHintParams(document(uri), WHOLE))
    found = [(one.position.line, one.label) for one in hints or ()]
    lines = text.split("\n")
    assert found == [
        (lines.index(" wide, =[depth/2]"), "= 50"),
        (lines.index(" LATERAL==[wide*2]"), "= 100"),
    ]


COLOURED = (
    "C über\n$MODEL\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=Röhre \U0001f600\n STIFFNESS==[2*depth]\n *NOTHING\n 1\n"
)


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
async def test_a_deck_has_colours(editor: Editor, end: str) -> None:
    uri = await editor.open(COLOURED.replace("\n", end))
    found = await editor.client.text_document_semantic_tokens_full_async(types.SemanticTokensParams(document(uri)))
    assert found is not None
    line = column = 0
    coloured = []
    lines = [text.encode("utf-16-le") for text in COLOURED.split("\n")]
    for at in range(0, len(found.data), 5):
        down, along, length, kind, _ = found.data[at : at + 5]
        line, column = line + down, along if down else column + along
        written = lines[line][2 * column : 2 * (column + length)].decode("utf-16-le")
        coloured.append((written, LEGEND.token_types[kind]))
    assert coloured == [
        ("C über", "comment"),
        ("$MODEL", "namespace"),
        ("*SEABED PROPERTIES", "keyword"),
        ("TYPE", "property"),
        ("=", "operator"),
        ("ELASTIC", "enumMember"),
        ("SET", "property"),
        ("=", "operator"),
        ("Röhre \U0001f600", "string"),
        ("STIFFNESS", "property"),
        ("=", "operator"),
        ("=[", "operator"),
        ("2", "number"),
        ("*", "operator"),
        ("depth", "variable"),
        ("]", "operator"),
        ("1", "number"),
    ]
