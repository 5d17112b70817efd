"""The grammars of the package: plain lark loads them, and tables give the parsers that lark compiles."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from pathlib import Path
from typing import cast

import pytest
from lark import Lark, Token, Tree

from mudline.language.syntax import grammars
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import parse

FOLDER = Path(__file__).parents[3] / "grammar"
LINES = ("K_SET", "ROW", "ROW", "K_SET")


def by_plain_lark() -> Tree[Token]:
    parser = Lark(
        (FOLDER / "blocks.lark").read_text(encoding="utf-8"), parser="lalr", start="embedment"
    ).parse_interactive()
    for terminal in LINES:
        parser.feed_token(Token(terminal, ""))
    return cast("Tree[Token]", parser.feed_eof())


def by_ours() -> Tree[Token]:
    parser = grammars.parser("blocks", "embedment").parse_interactive()
    for terminal in LINES:
        parser.feed_token(Token(terminal, ""))
    return cast("Tree[Token]", parser.feed_eof())


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Where the grammars are, without tables."""
    for name in ("blocks", "deck"):
        (tmp_path / f"{name}.lark").write_bytes((FOLDER / f"{name}.lark").read_bytes())
    monkeypatch.setattr(grammars, "grammar_file", lambda name: tmp_path / name)
    caches = grammars.parser, grammars.definitions, grammars._tables
    for cache in caches:
        cache.cache_clear()
    yield tmp_path
    for cache in caches:
        cache.cache_clear()


def test_the_grammar_stands_alone() -> None:
    lines = [Token(each, "") for each in LINES]
    tree = by_plain_lark()
    assert tree.data == "embedment"
    assert [curve.children for curve in tree.iter_subtrees() if curve.data == "embedment_curve"] == [
        lines[:3],
        lines[3:],
    ]


@pytest.mark.usefixtures("folder")
def test_without_tables_the_grammar_is_compiled() -> None:
    assert by_ours() == by_plain_lark()


def test_tables_are_read(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert grammars.save_tables("blocks") == folder / "blocks.tables"
    grammars.save_tables("deck")
    monkeypatch.setattr(grammars, "_compiled", None)
    assert by_ours() == by_plain_lark()
    assert len(parse(Source("", "$MODEL\n*NODE\n 1, 2\n")).sections) == 1


@pytest.mark.alike
@pytest.mark.parametrize("at", [0, 1, 2])
def test_tables_of_another_lark_class_or_grammar_are_not_read(folder: Path, at: int) -> None:
    saved = [*pickle.loads(grammars.save_tables("blocks").read_bytes())]  # noqa: S301 - made by the line itself
    saved[at] += " of another one"
    saved[-1] = dict.fromkeys(saved[-1], b"")
    (folder / "blocks.tables").write_bytes(pickle.dumps(tuple(saved)))
    assert by_ours() == by_plain_lark()
