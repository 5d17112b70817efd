"""Names of every kind that keywords define and use, and what is looked at in lines that are not read."""

from __future__ import annotations

from pathlib import Path

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.keywords import catalogue
from mudline.language.keywords.values import Names
from mudline.model.scene.references import CURVES, THINGS
from tests.helpers.builders.decks import CLEAN

VESSEL = "*VESSEL,INTEGRATED\n VESSEL=FPSO\n INITIAL POSITION=1005.0, 0.0, 0.0\n"
OFFSET = "$LOAD CASE\n*OFFSET\n VESSEL={}\n OFFSET=1.0\n"
BEND = "*MOMENT-CURVATURE\n CURVE={}\n 0.0, 0.0\n 1.0, 2.0\n"
SECTION = "*GEOMETRIC SETS\n OPTION=FLEXIBLE\n SET=ALL, EI=Bend\n , , 1.0, 1.0, 92.0, 0.9, 0.2, 0.3, 0.3\n"


def found(text: str, name: str = "deck.keyxm", folder: Path | None = None) -> list[tuple[str, str, int]]:
    """Code, severity and line of what is found about names."""
    told = lint_bytes(text.encode(), name, rules(), folder=folder)
    return [(one.code, one.severity.value, one.line) for one in told if one.code.startswith(("REF", "SYN017"))]


def test_a_vessel_is_looked_up() -> None:
    lines = CLEAN.count("\n")
    assert found(CLEAN + VESSEL + OFFSET.format("fpso")) == []
    assert found(CLEAN + VESSEL + OFFSET.format("FSPO")) == [("REF019", "error", lines + 6)]
    assert found(OFFSET.format("FSPO")) == []  # a part of a job: the model is somewhere else


def test_a_line_that_was_not_read_may_define_it() -> None:
    more = VESSEL + " WORKING=yes\n"
    assert found(CLEAN + more + OFFSET.format("FSPO")) == [("REF019", "warning", CLEAN.count("\n") + 7)]
    restart = "*RESTART\n LAST=static\n"
    assert [one[:2] for one in found(CLEAN + VESSEL + OFFSET.format("FSPO") + restart)] == [("REF019", "warning")]


def test_curves_of_other_kinds() -> None:
    deck = CLEAN + SECTION + BEND.format("bend")
    lines = CLEAN.count("\n")
    assert found(deck) == []
    assert found(CLEAN + SECTION + BEND.format("Bent")) == [("REF002", "error", lines + 3)]  # read as the one near it
    assert found(CLEAN + SECTION + BEND.format("Riser")) == [
        ("REF002", "error", lines + 3),
        ("REF003", "warning", lines + 6),
    ]
    assert found(deck + BEND.format("BEND")) == [("REF004", "warning", lines + 10)]
    assert found(CLEAN + "*DAMPER DATA\n NAME=a\n 0.0, 0.0\n 1.0, 1.0\n") == [("REF003", "info", lines + 2)]


def test_a_curve_that_a_line_which_is_not_read_names_is_used() -> None:
    assert found(CLEAN + BEND.format("Bend") + "*COATINGS\n CURVE=Bend\n") == []


def test_nodes_and_elements_that_any_keyword_names() -> None:
    lines = CLEAN.count("\n")
    springs = "*MASS\n 77, 12.0\n*SPRING ELEMENT\n ELEMENT=1, 55\n TYPE=LINEAR\n 3.0\n"
    assert found(CLEAN + springs) == [("REF006", "error", lines + 2), ("REF005", "error", lines + 4)]


def test_sets_of_postprocessing() -> None:
    post = (
        "$DATABASE POSTPROCESSING\n*ELEMENT SET\n SET=Hot\n 1\n$CODE CHECKING\n*TIMETRACE\n SET={}\n 1, 1, OUTPUT=ALL\n"
    )
    assert found(CLEAN + post.format("hot")) == []
    assert found(CLEAN + post.format("Cold")) == [("REF001", "error", CLEAN.count("\n") + 7)]


def test_kinds_are_said_in_words() -> None:
    assert all(kind.value.startswith(("a ", "an ")) for kind in CURVES | THINGS)
    assert catalogue.definers(Names.VESSEL) == ["VESSEL", "VESSEL,INTEGRATED"]
    assert catalogue.users(Names.MOMENT_CURVATURE) == ["GEOMETRIC SETS"]


UNREAD = """\
*COATINGS

 SET=Pype
C SET=Nowhere, =[no]
 0.003, =[depth + 1]
*FOO BAR
 SET=Nowhere
 =[1 + 2], =[up]
$LOAD CASE
*TEMPERATURE
 SET=Pipe, FILE=none.txt
*BOUNDARY
 TYPE=VESSEL
 VESSEL=Semi
 1, =[q]
"""


def test_lines_that_are_not_read_are_looked_at(tmp_path: Path) -> None:
    text = CLEAN + VESSEL + UNREAD
    first = (CLEAN + VESSEL).count("\n")
    assert [(code, line - first) for code, _, line in found(text, folder=tmp_path)] == [
        ("REF001", 3),
        ("REF013", 5),
        ("REF013", 8),
        ("REF015", 11),
        ("REF019", 14),
        ("REF013", 15),
    ]
    (tmp_path / "none.txt").touch()
    assert "REF015" not in {code for code, _, _ in found(text, folder=tmp_path)}


def test_lines_of_a_document_that_are_not_read_are_looked_at() -> None:
    text = dump(load_bytes((CLEAN + "*COATINGS\n 0.003, =[b]\n").encode(), "deck.keyxm"), "json")
    (told,) = found(text, "deck.json")
    assert told[0] == "REF013"
    assert "=[b]" in text.splitlines()[told[2] - 1]
