"""Grammars whose tables are kept from run to run: the same trees, and nothing lost where a file is of no use."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from zlib import crc32

import lark
import pytest
from lark import Lark, Token, UnexpectedCharacters, UnexpectedToken

from mudline import cache_folder
from mudline.expression import parsing
from mudline.keywords import catalogue, grammar, recovery
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


def resealed(path: Path, changed: dict[str, object]) -> None:
    """Write other tables with the checksum that they have to have."""
    body = json.dumps(changed).encode()
    path.write_bytes(f"{crc32(body):08x}\n".encode() + body)


def test_a_grammar_is_compiled_once(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = compiled(monkeypatch)
    assert works(sums())
    assert works(sums())
    assert seen == [SUMS]
    [kept] = folder.iterdir()
    assert kept.name.startswith("grammar-sums-")
    if os.name == "posix":
        assert folder.stat().st_mode & 0o777 == 0o700


def test_another_grammar_takes_the_place_of_the_one_before(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = compiled(monkeypatch)
    sums()
    monkeypatch.setattr(lark, "__version__", "0.0")
    sums()
    kept_parser("sums", SUMS.replace("+", "-"), lexer="basic")
    assert len(seen) == 3
    assert len(list(folder.iterdir())) == 1


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


@pytest.mark.parametrize("lacking", ["data", "memo", "key"])
def test_tables_in_another_form_are_not_used(folder: Path, monkeypatch: pytest.MonkeyPatch, lacking: str) -> None:
    sums()
    [kept] = folder.iterdir()
    tables = json.loads(kept.read_bytes().partition(b"\n")[2])
    others: list[object] = [{}, [], 3, None, {"parser": {}}]
    for value in others:
        resealed(kept, {**tables, lacking: value})
        seen = compiled(monkeypatch)
        assert works(sums())
        assert seen == [SUMS]
    resealed(kept, {name: held for name, held in tables.items() if name != lacking})
    assert works(sums())


def test_a_folder_that_cannot_be_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blocked = tmp_path / "a file"
    blocked.write_text("")
    monkeypatch.setenv(cache_folder.PLACE, str(blocked))
    assert works(sums())
    monkeypatch.setattr(scanning, "cache_folder", lambda: None)
    assert works(sums())


def test_a_file_that_cannot_be_replaced_leaves_nothing_behind(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise PermissionError

    monkeypatch.setattr(Path, "replace", fails)
    assert works(sums())
    assert list(folder.iterdir()) == []


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


@pytest.mark.parametrize("rule", sorted({catalogue.load(module).rule for module in catalogue.modules()}))
@pytest.mark.usefixtures("folder")
def test_the_rules_of_keywords_are_the_same(rule: str) -> None:
    make = recovery._parser.__wrapped__
    made, kept = make(rule), make(rule)
    known = grammar.terminals_below(rule)
    for start in range(len(known)):
        for terminals in (known[start:], known[: start + 1], [known[start]] * 3, [*known[:start], *known[: start + 2]]):
            assert sequence(kept, terminals) == sequence(made, terminals)


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
