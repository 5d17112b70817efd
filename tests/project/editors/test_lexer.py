"""The Pygments lexer: it is found, and it cuts decks as mudline does."""

from __future__ import annotations

import tomllib
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from tests.cli.runner import ROOT
from tests.project.editors.decks import HOSTILE, SAMPLES
from tests.project.editors.own_tokens import Classes, first_difference, own_classes

pytest.importorskip("pygments")

from pygments.token import Comment, Generic, Keyword, Name, Number, Operator, String, _TokenType

from mudline.language.highlighting.lexer import DeckLexer

CLASSES: dict[_TokenType, str] = {
    Generic.Heading: "section",
    Generic.Subheading: "section",
    Keyword: "keyword",
    Keyword.Pseudo: "unknown keyword",
    Comment.Single: "comment",
    Name.Attribute: "setting",
    Name.Property: "unknown setting",
    Name.Constant: "choice",
    Name.Function: "name",
    Name.Variable: "name",
    Name.Label: "text",
    Number.Float: "number",
    String: "text",
    String.Double: "text",
    Operator: "operator",
    Operator.Word: "word",
}


def lexer_classes(text: str) -> Classes:
    found: Classes = []
    for at, kind, piece in DeckLexer().get_tokens_unprocessed(text):
        assert at == len(found), "the tokens laid end to end are the text"
        found += [CLASSES.get(kind, "")] * len(piece)
    assert len(found) == len(text)
    return found


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.name)
def test_samples_are_cut_as_mudline_cuts_them(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert first_difference(text, own_classes(text), lexer_classes(text)) == ""


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_lines_are_cut_as_mudline_cuts_them(text: str) -> None:
    assert first_difference(text, own_classes(text), lexer_classes(text)) == ""


def test_a_long_line_takes_no_long_time() -> None:
    for piece in ("[", '"', "{", "a=", "=[", ",", "1 ", "1", "-", " ", "a ", "C-"):
        assert len(lexer_classes("$MODEL\n*NODE\n a" + piece * 20_000 + "\n" + piece * 20_000 + ";")) > 20_000


def test_the_entry_point_leads_to_it() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    value = project["entry-points"]["pygments.lexers"]["mudline"]
    assert EntryPoint("mudline", value, "pygments.lexers").load() is DeckLexer
