"""Decks that a program changes: blocks found, added and removed, and what is written of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import mudline
from mudline import keywords
from mudline.language.deck.writing import keyword_file
from tests.helpers.samples import SAMPLES

DECK = """\
C  A deck.

$MODEL
*OCEAN
   500.0 ,1025.0,   9.81
C  Two curves
*SEABED STIFFNESS
 CURVE = clay
  0.00,    0.0

  0.10,  120.0
  0.50, 1500.0
 CURVE=sand
  0.0, 0.0
  0.1, 99
*SEABED PROPERTIES
 SET=ALL
   STIFFNESS = clay
 FRICTION=0.3,0.5
*GUIDE
 any, thing
$LOAD CASE
*ANALYSIS TYPE
 TYPE=STATIC
"""


def deck() -> mudline.Deck:
    return mudline.from_keyword(DECK)


def written(changed: mudline.Deck) -> str:
    return keyword_file(changed).decode()


@pytest.mark.parametrize("path", sorted(SAMPLES.glob("*.key*")), ids=lambda path: path.name)
def test_a_deck_that_nobody_changed_is_written_as_it_was_read(path: Path, tmp_path: Path) -> None:
    try:
        read = mudline.read(path)
    except mudline.DeckError:
        return
    read.write(tmp_path / path.name)
    assert (tmp_path / path.name).read_bytes() == path.read_bytes()


CHANGES: dict[str, tuple[Callable[[mudline.Deck], None], str, str]] = {
    "a value": (lambda deck: setattr(deck.block("OCEAN"), "depth", 80), "500.0 ,", "80.0 ,"),
    "a cell": (lambda deck: deck.set("SEABED STIFFNESS[clay][ratio=0.1].force", 130), " 120.0", " 130.0"),
    "a row more": (
        lambda deck: deck.set("SEABED STIFFNESS[sand].points", [(0, 0), (0.1, 99), (0.2, 100)]),
        "  0.1, 99\n",
        "  0.1, 99\n 0.2, 100.0\n",
    ),
    "a row less": (
        lambda deck: deck.set("SEABED STIFFNESS[clay].points", [(0, 0), (0.5, 1500)]),
        "\n\n  0.10,  120.0\n",
        "\n",
    ),
    "a setting": (
        lambda deck: deck.set("SEABED PROPERTIES[1].stiffness", "sand"),
        "STIFFNESS = clay",
        "STIFFNESS=sand",
    ),
    "a block less": (lambda deck: deck.remove("GUIDE"), "*GUIDE\n any, thing\n", ""),
    "a block more": (lambda deck: deck.add(keywords.Ocean(depth=3)), "$LOAD CASE", "*OCEAN\n 3.0\n$LOAD CASE"),
    "a comment": (lambda deck: setattr(deck.sections[0], "comments", []), "C  Two curves\n", ""),
}


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("end", ["\n", "\r\n"], ids=["LF", "CRLF"])
def test_only_what_was_changed_is_written_anew(change: str, end: str) -> None:
    make, before, after = CHANGES[change]
    assert DECK.count(before) == 1
    found = mudline.from_keyword(DECK.replace("\n", end))
    make(found)
    assert written(found) == DECK.replace(before, after).replace("\n", end)


def test_encoding_and_mark_of_the_file_stay(tmp_path: Path) -> None:
    for data in (b"\xef\xbb\xbf" + DECK.encode(), DECK.replace("A deck", "Fl\xe4che").encode("cp1252")):
        file = tmp_path / "deck.keyxm"
        file.write_bytes(data)
        found = mudline.read(file)
        found.set("OCEAN.gravity", 9.8)
        found.write(file)
        assert file.read_bytes() == data.replace(b"9.81", b"9.8")
    found.add(keywords.SeabedStiffness.model_validate({"curves": [{"name": "\u03a9", "points": [(0, 0), (1, 1)]}]}))
    with pytest.raises(mudline.DeckError, match="cannot be written in the file's encoding, cp1252"):
        found.write(file)
    assert file.read_bytes() == data.replace(b"9.81", b"9.8")


@pytest.mark.parametrize("lines", ["   STIFFNESS = clay, FRICTION=0.3,0.5", " FRICTION=0.3,0.5\n   STIFFNESS = clay"])
def test_a_block_whose_lines_are_not_the_canonical_ones_is_written_anew_as_a_whole(lines: str) -> None:
    text = DECK.replace("   STIFFNESS = clay\n FRICTION=0.3,0.5", lines)
    found = mudline.from_keyword(text)
    found.set("SEABED PROPERTIES[ALL].friction", (0.4, 0.5))
    assert written(found) == DECK.replace("   STIFFNESS = clay\n FRICTION=0.3,", " STIFFNESS=clay\n FRICTION=0.4, ")


# ----------------------------------------------------------------------------------------------------- blocks of a deck


@pytest.mark.parametrize(
    ("keyword", "message"),
    [
        ("OCAEN", r"the deck has no \*OCAEN \(did you mean OCEAN\?\)"),
        ("NODE", r"the deck has no \*NODE$"),
        ("GUIDE", r"the lines of \*GUIDE are not read"),
    ],
)
def test_a_block_that_is_not_there(keyword: str, message: str) -> None:
    with pytest.raises(KeyError, match=message):
        deck().block(keyword)


def test_a_block_is_added_where_it_belongs() -> None:
    found = deck()
    found.add(keywords.Units(units="METRIC"))
    found.add(keywords.Parameters.model_validate({"parameters": [{"name": "a", "value": 1.0}]}))
    assert [section.name for section in found.sections] == ["PREPROCESSOR", "MODEL", "LOAD CASE", "ANALYSIS"]
    with pytest.raises(ValueError, match=r"section must be MODEL, where \*OCEAN belongs, not 'LOAD CASE'"):
        found.add(keywords.Ocean(depth=3), "LOAD CASE")
    assert mudline.from_keyword(written(found)).sections == found.sections


def test_a_block_is_removed_and_comments_stay_with_their_blocks() -> None:
    found = deck()
    found.remove(found.block("OCEAN"))
    assert written(found) == DECK.replace("*OCEAN\n   500.0 ,1025.0,   9.81\n", "")
    for gone in ("OCEAN", keywords.Ocean(depth=500.0)):
        with pytest.raises((KeyError, ValueError), match=r"not in the deck|has no"):
            found.remove(gone)


def test_findings_of_a_changed_deck_have_the_places_of_what_would_be_written() -> None:
    found = deck()
    found.remove("OCEAN")
    found.add(keywords.SeabedProperties.model_validate({"type": "ELASTIC", "sets": [{"set": "Nowhere"}]}))
    with pytest.raises(mudline.DeckError) as error:
        found.scene()
    lines = written(found).split("\n")
    assert {lines[one.line - 1] for one in error.value.diagnostics if "Nowhere" in one.message} == {" SET=Nowhere"}


# ------------------------------------------------------------------------------------------------------------------ set


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("OCEAN.depth", "x", "expected a number"),
        ("OCEAN.depth", -1, "out of range"),
        ("OCEAN.dept", 1, "did you mean depth"),
        ("SEABED STIFFNESS.points", [(0, 0), (1, 1)], "is ambiguous"),
        ("SEABED STIFFNESS[clay].points", [(0, 0)], "a curve needs at least 2"),
        ("SEABED STIFFNESS[rock].points", [(0, 0), (1, 1)], r"the deck has no SEABED STIFFNESS\[rock\].points"),
        ("NODE[1].x", 5, r"the deck has no NODE\[1\].x"),
        ("OCEAN", 5, "expected KEYWORD.field"),
    ],
)
def test_what_cannot_be_set_changes_nothing(path: str, value: object, message: str) -> None:
    found = deck()
    with pytest.raises(ValueError, match=message):
        found.set(path, value)
    assert found == deck()
