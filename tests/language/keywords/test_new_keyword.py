"""A keyword needs its module, its grammar rule and its line in the index, which is made: all else follows."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from lark.load_grammar import load_grammar

from mudline.checks.engine import lint_bytes
from mudline.checks.recovery import lines
from mudline.checks.registry import rules
from mudline.language.deck.forms.json import read, to_json
from mudline.language.deck.keyword_text import to_keyword
from mudline.language.deck.loading import load_bytes
from mudline.language.keywords import catalogue, library
from mudline.language.keywords.catalogue import suggest_keyword
from mudline.language.syntax import grammars
from tests.docs.keyword_index import keyword_index
from tests.docs.keyword_page import keyword_page
from tests.helpers.builders.decks import CLAY, PIPE, STEEL
from tests.language.keywords.index import declared_entries

NAME = "SEABED ANCHOR"
MODULE = '''
from typing import Annotated, Literal

from mudline.language.keywords.common import *


class AnchorSet(Record):
    """What one SET= gets, taken whole."""

    rule = "anchor_set"
    set_name: Annotated[Name, setting("SET", "element set", names=Names.SET)] = Field(alias="set")
    curve: Annotated[Name | None, setting("CURVE", "force of the anchor", names=Names.CURVE)] = None
    file: Annotated[Name | None, setting("FILE", "test of the anchor", names=Names.FILE)] = None
    spacing: Annotated[
        Real | None, setting("SPACING", "distance between anchors", unit="L", above=0, inferred="along the line")
    ] = None


class SeabedAnchor(Block):
    """Anchors by set."""

    rule = "seabed_anchor"
    facts = Facts(extension=True, later_wins=True)
    summary = "Anchors by element set (extension)."
    example = "*SEABED ANCHOR\\n SET=ALL\\n SPACING=12.0\\n"

    keyword: Literal["SEABED ANCHOR"] = "SEABED ANCHOR"
    sets: list[AnchorSet] = []

'''
RULES = """
seabed_anchor: anchor_set*
anchor_set: K_SET (K_CURVE | K_FILE | K_SPACING)*
%declare K_SET K_CURVE K_FILE K_SPACING
"""
SEABED = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n"
DECK = PIPE + STEEL + CLAY + SEABED + f"*{NAME}\n"
LINE = DECK.count("\n") + 1


@pytest.fixture(autouse=True)
def anchor(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The keyword, as if the library had it."""
    (tmp_path / "seabed_anchor.py").write_text(MODULE, encoding="utf-8")
    monkeypatch.setattr(library, "__path__", [*library.__path__, str(tmp_path)])
    caches = [one for module in (catalogue, lines) for one in vars(module).values() if hasattr(one, "cache_clear")]
    entries = tuple(declared_entries())
    monkeypatch.setattr(catalogue, "index", lambda: entries)
    known, new = grammars.definitions("blocks"), load_grammar(RULES, "new", [], False)[0]
    monkeypatch.setattr(known, "rule_defs", [*known.rule_defs, *new.rule_defs])
    monkeypatch.setattr(
        known, "term_defs", [*{str(one[0]): one for one in (*known.term_defs, *new.term_defs)}.values()]
    )
    for cache in caches:
        cache.cache_clear()
    yield
    monkeypatch.undo()
    for cache in caches:
        cache.cache_clear()
    sys.modules.pop(f"{library.__name__}.seabed_anchor", None)


def found(text: str, folder: Path | None = None, dialect: str = "mudline") -> list[tuple[str, int]]:
    """Code and line, from the first line below the keyword, of what is found in a deck with these lines."""
    told = lint_bytes((DECK + text).encode(), "deck.keyxm", rules(), folder=folder, dialect=dialect)
    return [(each.code, each.line - LINE + 1) for each in told]


def test_a_block_without_a_fault(tmp_path: Path) -> None:
    (tmp_path / "pull.csv").touch()
    assert found(" SET=ALL\n CURVE=clay\n FILE=pull.csv\n SPACING=12.0\n", tmp_path) == []


def test_references_are_checked(tmp_path: Path) -> None:
    text = " SET=Riser\n CURVE=Sand\n FILE=pull.csv\n"
    assert found(text, tmp_path) == [("REF001", 1), ("REF002", 2), ("REF015", 3)]


def test_a_curve_that_only_this_keyword_names_is_used() -> None:
    sand = "*SEABED STIFFNESS\n CURVE=Sand\n 0.0, 0.0\n 0.5, 9000.0\n"
    assert found(f" SET=ALL\n SPACING=12.0\n{sand}") == [("REF003", 4)]
    assert found(f" SET=ALL\n CURVE=Sand\n{sand}") == []


def test_values_are_checked() -> None:
    assert found(" SET=ALL\n SPACING=-1.0\n") == [("SBD010", 2)]
    assert found(" SET=ALL\n SPACING=far\n") == [("SYN002", 2)]


def test_an_extension_needs_an_elastic_seabed() -> None:
    told = lint_bytes(f"{PIPE}*{NAME}\n SET=ALL\n".encode(), "deck.keyxm", rules())
    assert "EXT001" in [each.code for each in told]


def test_spelling() -> None:
    assert suggest_keyword("SEABED ANCOR") == NAME
    (misspelt,) = lint_bytes((DECK + " SET=ALL\n SPACIN=2.0\n").encode(), "deck.keyxm", rules())
    assert "did you mean SPACING?" in misspelt.message


def test_every_form() -> None:
    deck = load_bytes((DECK + " SET=ALL\n SPACING=12.0\n").encode(), "deck.keyxm")
    assert read(to_json(deck).encode(), "deck.json").sections == deck.sections
    assert to_keyword(deck).endswith(f"*{NAME}\n SET=ALL\n SPACING=12.0\n")


def test_page() -> None:
    page = keyword_page(catalogue.declarations(NAME)[0])
    assert f"# `*{NAME}`" in page
    assert "SPACING=number" in page
    assert all(f"[{code}](../rules/{code}.md)" in page for code in ("EXT001", "REF001", "SBD010"))
    assert "along the line" in page
    assert f"`*{NAME}`" in keyword_index()
