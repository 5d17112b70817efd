"""Grammars whose tables are kept from run to run: the same trees, and nothing lost where a file is of no use."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
from lark import Lark, Token, UnexpectedCharacters, UnexpectedToken

from mudline import cache_folder
from mudline.expression import parsing
from mudline.syntax import scanning
from mudline.syntax.scanning import kept_parser

SUMS = 'start: NUMBER ("+" NUMBER)*\nNUMBER: /[0-9]+/\n'


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the tables are kept."""
    place = tmp_path / "cache"
    monkeypatch.setenv(cache_folder.PLACE, str(place))
    return place


def sums() -> Lark:
    return kept_parser("sums", SUMS, lexer="basic")


def works(parser: Lark) -> bool:
    return [str(number) for number in parser.parse("1+23").children] == ["1", "23"]


def compiled(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The grammars that lark compiles from now on."""
    seen: list[str] = []

    class Counting(Lark):
        def __init__(self, text: str, **options: object) -> None:
            seen.append(text)
            super().__init__(text, **options)

    monkeypatch.setattr(scanning, "Lark", Counting)
    return seen


def test_a_grammar_is_compiled_once(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = compiled(monkeypatch)
    assert works(sums())
    assert works(sums())
    assert seen == [SUMS]
    [kept] = folder.iterdir()
    assert kept.name.startswith("grammar-sums-")
    if os.name == "posix":
        assert folder.stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize("damage", [b"", b"{}", b"\xff\x00", b"00000000\n{}", b"00000000\n"])
def test_a_damaged_file_is_made_again(folder: Path, monkeypatch: pytest.MonkeyPatch, damage: bytes) -> None:
    assert works(sums())
    [kept] = folder.iterdir()
    whole = kept.read_bytes()
    for broken in (damage, whole[: len(whole) // 2], whole.replace(b"NUMBER", b"NUMBFR"), whole + b" "):
        kept.write_bytes(broken)
        seen = compiled(monkeypatch)
        assert works(sums())
        assert works(sums())
        assert seen == [SUMS]


def test_a_folder_that_cannot_be_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blocked = tmp_path / "a file"
    blocked.write_text("")
    monkeypatch.setenv(cache_folder.PLACE, str(blocked))
    assert works(sums())
    monkeypatch.setattr(scanning, "cache_folder", lambda: None)
    assert works(sums())


@pytest.mark.skipif(sys.platform == "win32", reason="files have no user's number there")
def test_a_file_of_another_user_is_not_read(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sums()
    own = os.getuid()
    monkeypatch.setattr(os, "getuid", lambda: own + 1)
    seen = compiled(monkeypatch)
    assert works(sums())
    assert seen == [SUMS]
    assert len(list(folder.iterdir())) == 1


def sequence(parser: Lark, terminals: list[str]) -> object:
    """What a parser makes of terminals: the tree, or where it stops and what it expects there."""
    steps = parser.parse_interactive()
    for index, terminal in enumerate(terminals):
        try:
            steps.feed_token(Token(terminal, "", start_pos=index))
        except UnexpectedToken:
            return index, sorted(steps.accepts())
    try:
        return steps.feed_eof()
    except UnexpectedToken:
        return len(terminals), sorted(steps.accepts())


@pytest.mark.usefixtures("folder")
def test_equations_are_read_the_same() -> None:
    made, kept = parsing._grammar.__wrapped__(), parsing._grammar.__wrapped__()
    assert scanning.scanner(kept) == scanning.scanner(made)
    for text in ("1", "a + 2 * -b ^ 2", 'if(a <> "x", max(1, 2), not (b > 1.5D3 and c))'):
        assert kept.parse(text) == made.parse(text)
    faults = []
    for parser in (made, kept):
        with pytest.raises(UnexpectedCharacters) as fault:
            parser.parse("a ? b")
        faults.append(str(fault.value))
    assert faults[0] == faults[1]
