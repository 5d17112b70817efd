"""Texts and places of open decks, with every line end."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lsprotocol import types

from mudline.language.diagnostics import Span
from mudline.language.syntax.edits import TextEdit, apply_edits
from mudline.tools.lsp.decks import OpenDocument, characters_of, file_of

TEXT = "$MODEL\r\n*NODE\tä\n 1, 0.0 C 😋 x\r 2, ü\n"
LETTERS = st.text(alphabet="ab\r\n\täß😋,1", max_size=12)


def document(text: str) -> OpenDocument:
    return OpenDocument("file:///deck.keyxm", text, 1)


def test_every_offset_comes_back() -> None:
    made = document(TEXT)
    for offset in range(len(TEXT) + 1):
        if TEXT[offset - 1 : offset + 1] != "\r\n":
            assert made.offset(made.position(offset)) == offset


def test_columns_count_in_utf_16() -> None:
    assert document(TEXT).position(TEXT.index("x")).character == 13


def test_a_column_inside_a_character_stands_before_it() -> None:
    line = TEXT.split("\n")[2].partition("\r")[0]
    assert characters_of(line, 11) == line.index("😋")


@pytest.mark.parametrize("line", [0, 3, 4, 2**31 - 1])
@pytest.mark.parametrize("character", [0, 5, 2**31 - 1])
def test_a_place_beyond_the_text_stands_at_its_end(line: int, character: int) -> None:
    made = document(TEXT)
    offset = made.offset(types.Position(line, character))
    assert 0 <= offset <= len(TEXT)
    assert made.position(offset).line <= line


@given(LETTERS, st.lists(st.tuples(st.integers(0, 12), st.integers(0, 12), LETTERS), max_size=4))
def test_changes_keep_lines_and_text(text: str, changes: list[tuple[int, int, str]]) -> None:
    made = document(text)
    for first, last, new in changes:
        start, end = sorted((min(first, len(made.text)), min(last, len(made.text))))
        range_ = made.range(Span(start, end))
        start, end = made.offset(range_.start), made.offset(range_.end)
        expected = made.text[:start] + new + made.text[end:]
        made.change(types.Range(range_.end, range_.start) if first > last else range_, new)
        assert made.text == expected
        assert made.source.line_starts == document(expected).source.line_starts


@given(st.lists(LETTERS), st.lists(LETTERS))
def test_a_difference_leads_from_one_text_to_the_other(one: list[str], other: list[str]) -> None:
    made = document("\n".join(one))
    edits = [
        TextEdit(Span(made.offset(each.range.start), made.offset(each.range.end)), each.new_text)
        for each in made.difference("\n".join(other).encode())
    ]
    assert apply_edits(made.text, edits) == "\n".join(other)


def test_halves_of_pairs_are_replaced() -> None:
    made = document("a\ud83d")
    made.change(types.Range(types.Position(0, 1), types.Position(0, 1)), "\ude0b")
    assert made.text == "a\ufffd\ufffd"
    assert made.as_file().decode() == made.text


def test_a_byte_order_mark_counts_for_the_editor_only() -> None:
    made = document("\ufeff$MODEL\n*NODE\n")
    assert made.text.startswith("$MODEL")
    assert made.position(0).character == 1
    assert made.offset(made.position(3)) == 3
    assert made.position(7) == types.Position(1, 0)


def test_only_files_of_this_machine_are_files() -> None:
    assert file_of("file:///tmp/a%20b.keyxm") is not None
    for uri in ("untitled:Untitled-1", "http://host/a.keyxm", "file://host/a.keyxm", "file:///a%00b", "", "file:///"):
        assert file_of(uri) is None or uri == "file:///"


def test_a_text_in_no_file_has_the_form_of_its_language() -> None:
    assert OpenDocument("untitled:Untitled-1", "", 1, "yaml").name == "Untitled-1.yaml"
    assert OpenDocument("untitled:deck.json", "", 1, "json").name == "deck.json"
    assert OpenDocument("untitled:", "", 1).name == "untitled"
