"""Blocks that cannot be read: their lines in a document, what is found in them there, and the way back."""

from __future__ import annotations

from collections import Counter

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from mudline.language.deck.keyword_text import with_raw_lines
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.model import Deck, Opaque
from mudline.language.diagnostics import DeckError, Diagnostic, Severity
from tests.helpers.builders.decks import CLEAN

FORMS = ["json", "yaml"]
MISPLACED = (
    CLEAN.replace(" 2, -0.1, 10.0\n", "C inside\n   2,\t-0.1 , 1O.0\n\n")
    .replace("*SEABED STIFFNESS", "C before the curves\n*SEABED STIFFNESS")
    .replace(" 0.1, 1000.0\n", " 0.1, 1000.0\n misplaced = 3\n")
)
"""A number in *NODE that is none, and a line in the last block that belongs to no keyword."""


def carried(text: str, form: str) -> str:
    kept, places = with_raw_lines(load_bytes(text.encode(), "deck.keyxm"))
    assert places
    return dump(kept, form)


def back(document: str, form: str, to: str) -> str:
    return dump(with_raw_lines(load_bytes(document.encode(), f"deck.{form}"))[0], to)


def lines_of(text: str, keyword: str) -> list[str]:
    """The lines of a block, from its first one to the next."""
    lines = text.split("\n")
    start = lines.index(f"*{keyword}")
    ends = (n for n, line in enumerate(lines) if n > start and line[:1] in ("*", "$"))
    return lines[start : next(ends, len(lines) - 1)]


@pytest.mark.parametrize("form", FORMS)
def test_lines_come_back_as_they_were(form: str) -> None:
    text = back(carried(MISPLACED, form), form, "keyword")
    for keyword in ("NODE", "SEABED STIFFNESS"):
        assert lines_of(text, keyword) == lines_of(MISPLACED, keyword)
    assert "C before the curves" in lines_of(text, "SEABED PROPERTIES")
    assert back(carried(MISPLACED, form), form, form) == carried(MISPLACED, form)


def found_in(text: str, name: str) -> list[Diagnostic]:
    return [one for one in lint_bytes(text.encode(), name, select()) if one.severity is not Severity.INFO]


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(
    "text",
    [
        MISPLACED,
        CLEAN.replace(" 100.0, 1025.0, 9.81", " -100.0, 1025.0, 9.81"),  # out of range: no document has it
        CLEAN.replace("*ELEMENT\n", "*ELEMENT\n GEN=1, 0\n"),
        CLEAN.replace(" 0.1, 1000.0\n 0.5, 3000.0\n", ""),  # a curve of one point
        CLEAN.replace(" STIFFNESS=Clay", " STIFFNESS=Clya").replace(" 0.1, 1000.0", " 0.1 1000.0, 5"),
    ],
    ids=["misplaced", "range", "generated", "points", "recovered"],
)
def test_a_document_has_the_findings_of_the_keyword_text(text: str, form: str) -> None:
    document = carried(text, form)
    wanted, found = found_in(text, "deck.keyxm"), found_in(document, f"deck.{form}")
    assert Counter((one.code, one.message) for one in found) == Counter((one.code, one.message) for one in wanted)
    assert [one for one in wanted if one.severity is Severity.ERROR]
    assert all(one.fix is None for one in found)


@pytest.mark.parametrize("form", FORMS)
def test_a_finding_has_the_place_of_its_line(form: str) -> None:
    document = carried(MISPLACED, form)
    places = [one for one in found_in(document, f"deck.{form}") if one.code == "SYN004"]
    line = document.splitlines()[places[0].line - 1]
    assert "misplaced = 3" in line[places[0].column - 1 : places[0].end_column]


def test_other_blocks_are_values_and_a_deck_without_faults_stays() -> None:
    kept, places = with_raw_lines(load_bytes(MISPLACED.encode(), "deck.keyxm"))
    assert [kept.sections[where.section].blocks[where.block].keyword for where in places] == [
        "NODE",
        "SEABED STIFFNESS",
    ]
    assert kept.sections[0].blocks[2] == load_bytes(CLEAN.encode(), "deck.keyxm").sections[0].blocks[2]
    clean = load_bytes(CLEAN.encode(), "deck.keyxm")
    assert with_raw_lines(clean) == (clean, [])
    assert with_raw_lines(Deck("a")) == (Deck("a"), [])


def test_lines_beside_what_keyword_text_cannot_say_are_refused() -> None:
    document = carried(MISPLACED, "json").replace('"set": "Pipe"', '"set": "Pipe, line"')
    with pytest.raises(DeckError, match=r"blocks\[4\].sets\[0\].set cannot be written as keyword text: 'Pipe, line'"):
        load_bytes(document.encode(), "deck.json")


@pytest.mark.parametrize("form", FORMS)
def test_what_reading_would_refuse_is_refused_when_it_is_written(form: str) -> None:
    deck = load_bytes(CLEAN.replace(" 100.0, 1025.0, 9.81", " -100.0, 1025.0, 9.81").encode(), "deck.keyxm")
    with pytest.raises(
        DeckError, match=r"deck.keyxm:2:1: DOC002 sections\[0\].blocks\[0\].depth: -100.0 is out of range"
    ):
        dump(deck, form)
    deck = load_bytes(CLEAN.encode(), "deck.keyxm")
    deck.sections[0].blocks.append(Opaque(keyword="TITLE", lines=["x", "*y"]))
    with pytest.raises(DeckError, match=r"blocks\[7\].lines\[1\]: a line that begins with \*"):
        dump(deck, form)


@pytest.mark.parametrize("form", FORMS)
def test_comments_stay_where_they_stood(form: str) -> None:
    lines = [line for number, line in enumerate(CLEAN.splitlines()) for line in (f"C {number}", line)]
    text = "\n".join([*lines, "C at the end", ""])
    deck = load_bytes(text.encode(), "deck.keyxm")
    again = dump(load_bytes(dump(deck, form).encode(), f"deck.{form}"), "keyword")
    numbers = [n for n, line in enumerate(text.splitlines()) if line.startswith("C ")]
    assert [again.splitlines()[n] for n in numbers] == [text.splitlines()[n] for n in numbers]
    assert len(again.splitlines()) == len(text.splitlines())
