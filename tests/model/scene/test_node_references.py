"""Nodes of `*BOUNDARY` and of soil springs, degrees of freedom: what leads nowhere is reported, and nothing else."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.language.deck.loading import load_bytes
from mudline.model.scene.csv_file import read_external
from mudline.model.scene.model import resolve
from tests.helpers.builders.decks import PIPE
from tests.helpers.builders.scenes import Finding, all_reported, messages, reported
from tests.helpers.growth import call_growth

GIVEN = "$PREPROCESSOR\n*PARAMETERS\n dof, 6\n last, 11\n far, 13\n odd, 6.5\n"
HELD = "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n"
LINE = PIPE.count("\n") + HELD.count("\n") + 1
ELSEWHERE = "$MODEL\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=5000.0\n"


def held(*lines: str) -> list[Finding]:
    """What is told of lines behind TYPE=CONSTANT, in a deck with the nodes 1 to 11."""
    found = all_reported(PIPE + HELD + "".join(f" {line}\n" for line in lines) + GIVEN)
    return [(letter, code, line - LINE, column) for letter, code, line, column in found]


@pytest.mark.parametrize(
    "line",
    [
        "1, 1",
        "11, 6, 0.5",
        "1, =[dof]",
        "GEN=1, 11, 2",
        "GEN=1, 11, 2, 3",
        "GEN=1, 11, , 4, 0.5",
        "GEN=1, 11, 5, 2, 0.0",
        "GEN=1, 11, 2, 0.25",
        "GEN=1, 11, =[dof]",
        "GEN=1, =[last], 2",
        "GEN=1, 11, , =[dof]",
    ],
)
def test_lines_in_which_nothing_is_wrong(line: str) -> None:
    assert held(line) == []


@pytest.mark.parametrize(
    ("line", "finding"),
    [
        ("99, 1", ("E", "REF006", 0, 2)),
        ("1, 7", ("E", "SYN005", 0, 5)),
        ("1, 0", ("E", "SYN005", 0, 5)),
        ("1, -2", ("E", "SYN005", 0, 5)),
        ("{Top}, 1", ("E", "REF006", 0, 2)),
        ("GEN=8, 12, 2", ("W", "REF006", 0, 2)),
        ("GEN=21, 30, 2", ("E", "REF006", 0, 2)),
        ("GEN=1, 13, 6, 2, 0.0", ("W", "REF006", 0, 2)),
        ("GEN=1, 11", ("E", "SYN003", 0, 2)),
        ("GEN=1, 11, 2, , 0.0", ("E", "SYN003", 0, 2)),
        ("GEN=1, 11, 9", ("E", "SYN005", 0, 13)),
        ("GEN=1, 11, 9, 0.5", ("E", "SYN005", 0, 16)),
        ("GEN=1, 11, 2, 9, 0.5", ("E", "SYN005", 0, 16)),
        ("GEN=11, 1, 2", ("E", "REF010", 0, 2)),
        ("GEN=1, 11, 0, 2, 0.0", ("E", "REF010", 0, 2)),
        ("1, =[dof + 1]", ("E", "SYN005", 0, 5)),
        ("GEN=1, 11, 2, =[dof + 1], 0.5", ("E", "SYN005", 0, 16)),
        ("GEN=1, =[far], 6, 2, 0.0", ("W", "REF006", 0, 2)),
        ("1, =[nothing]", ("E", "REF013", 0, 5)),
        ("1, =[odd]", ("E", "SYN002", 0, 5)),
        ("1, 2, =[1/0]", ("E", "SYN017", 0, 8)),
        ("GEN=1, 11, =[nothing]", ("E", "REF013", 0, 13)),
        ("GEN=1, 11, 2, =[nothing]", ("E", "REF013", 0, 16)),
        ("GEN={Top}, 11, 2", ("E", "REF006", 0, 6)),
        ("GEN=1, =[cu(2)], 2", ("W", "SYN017", 0, 9)),
    ],
)
def test_a_fault_is_told_once(line: str, finding: Finding) -> None:
    assert held("1, 1", line, "1, 2")[0] == (finding[0], finding[1], 1, finding[3])
    assert len(held("1, 1", line, "1, 2")) == 1


def test_words() -> None:
    assert messages(PIPE + HELD + " 99, 8\n GEN=8, 12, 1, 2, 0.0\n 1, 2, FIXATION=RELATIVE\n GEN=2, 3\n") == [
        "node 99 is not defined: define it in *NODE, or correct the number",
        "8 is not a degree of freedom: expected 1 (vertical), 2 or 3 (horizontal), or 4 to 6 (rotations)",
        "GEN= holds the nodes from 8 to 12 in steps of 1: 1 of these 5 are not defined; correct it, or define them",
        "this GEN= has no degree of freedom: write start, end [, increment], dof [, displacement]",
    ]


def test_a_long_range_takes_no_time() -> None:
    assert held("GEN=1, 9007199254740992, 1") == [("W", "REF006", 0, 2)]
    assert call_growth(held, "GEN=1, 12, 1", "GEN=1, 9007199254740992, 1") == 1.0


def test_what_could_not_be_read_is_told_by_the_reader_only() -> None:
    assert held("x1, 1", "1, one", "GEN=1, x, 2", "1") == [
        ("W", "SYN016", 0, 2),
        ("E", "SYN002", 1, 5),
        ("W", "SYN016", 2, 9),
        ("E", "SYN003", 3, 2),
    ]


def test_nodes_on_cables_are_one_info() -> None:
    cables = "*CABLE\n 1, 1, 2, 50.0\n*NODE,CURVILINEAR\n 99, 1, 5.0\n"
    text = PIPE + cables + HELD + " 99, 1\n 98, 1\n {Hang-off}, 1\n GEN=90, 99, 1\n"
    assert reported(text) == [("I", "REF006", LINE - 1, 1), ("E", "REF006", LINE + 5, 2)]
    expected = "*NODE,CURVILINEAR may define nodes that this deck does not show: 1 use of such nodes (first: node 99)"
    assert messages(text)[0].startswith(expected)


def test_a_node_that_no_cable_holds_is_missing() -> None:
    text = PIPE + "*CABLE\n 1, 1, 98, 50.0\n*NODE,CURVILINEAR\n 20, 1, 5.0\n 30, 1, 9.0\n CURV=20, 30, 5, CABLE=1\n"
    held = HELD + " 20, 1\n 25, 1\n 26, 1\n"
    line = text.count("\n") + HELD.count("\n")
    assert ("E", "REF006", PIPE.count("\n") + 2, 8) in reported(text + held)
    assert ("E", "REF006", line + 3, 2) in reported(text + held)
    assert len(reported(text + held)) == 3
    unknown = text.replace("CURV=20", "CURV={Top}")
    assert all(letter == "I" for letter, *_ in reported(unknown + held))


def test_cables_that_nodes_lie_on() -> None:
    text = "$MODEL\n*NODE\n 1, 0.0, 0.0\n 2, 0.0, 9.0\n*CABLE\n 1, 1, 2, 50.0\n*NODE,CURVILINEAR\n"
    rows = " 20, 1, 5.0\n 30, 4, 9.0\n CURV=20, 30, 5, CABLE=6\n"
    found = [one for one in reported(text + rows) if one[1] == "REF019"]
    assert found == [("E", "REF019", 9, 6), ("E", "REF019", 10, 24)]
    kept = text.replace("50.0\n", "50.0\n a line of another form\n") + rows
    assert [one for one in reported(kept) if one[1] == "REF019"] == [("W", "REF019", 10, 6), ("W", "REF019", 11, 24)]


def test_a_deck_without_nodes_is_not_judged() -> None:
    assert reported(ELSEWHERE + HELD + " 1, 1\n {Top}, 1\n GEN=2, 9, 2\n") == []
    assert reported("$MODEL\n*NODE\n" + HELD + " 1, 1\n GEN=2, 9, 2\n") == [
        ("E", "REF006", 6, 2),
        ("E", "REF006", 7, 2),
    ]


def test_a_number_that_could_not_be_read_excuses_what_one_edit_of_it_gives() -> None:
    text = "$MODEL\n*NODE\n 1, 0.0, 0.0\n 2x, 0.0, 5.0\n" + HELD + " 2, 1\n 21, 1\n 31, 1\n"
    assert reported(text) == [("E", "REF006", 10, 2)]


def test_a_file_of_elements_does_not_tell_of_every_node(tmp_path: Path) -> None:
    file = tmp_path / "elements.csv"
    file.write_text("element,node1,node2,diameter\n1,1,2,0.25\n")
    deck = load_bytes((PIPE + "*P-Y\n SET=Pile\n" + HELD + " 99, 1\n").encode(), "deck.keyxm")
    assert [problem.code.code for problem in resolve(deck).problems] == ["REF001", "REF006"]
    assert resolve(deck, read_external(file)).problems == []


SOIL_CURVE = " DEPTH=0.0\n 0.0, 0.0\n 4000.0, 0.01\n"
SOIL_POINTS = " 0.0, 0.0\n 4000.0, 0.01\n"
SOIL_SETS = "*ELEMENT SETS\n SET=Pile\n 1, 2\n"
SOIL_LINE = (PIPE + SOIL_SETS).count("\n") + 2


@pytest.mark.parametrize("keyword", ["P-Y", "T-Z"])
def test_names_that_lead_nowhere(keyword: str) -> None:
    text = (
        PIPE
        + SOIL_SETS
        + f"*{keyword}\n SET=PILE\n{SOIL_CURVE} SET=Pale\n{SOIL_CURVE} NODE=99\n{SOIL_POINTS} NODE=11\n{SOIL_POINTS}"
    )
    assert all_reported(text) == [("E", "REF001", SOIL_LINE + 4, 6), ("E", "REF006", SOIL_LINE + 8, 7)]
    assert messages(text) == [
        "set 'Pale' is not defined (did you mean Pile?): define it in *ELEMENT SETS",
        "node 99 is not defined: define it in *NODE, or correct the number",
    ]


def test_lines_make_sets_and_nodes_of_their_own() -> None:
    rest = f"*P-Y\n SET=Riser\n NODE={{End}}\n{SOIL_POINTS} NODE=99\n{SOIL_POINTS}"
    assert reported(PIPE + "*LINES\n LINE=Riser\n" + rest) == [("W", "REF006", SOIL_LINE + 3, 7)]
    assert reported(PIPE + rest) == [
        ("E", "REF001", SOIL_LINE - 3, 6),
        ("E", "REF006", SOIL_LINE - 2, 7),
        ("E", "REF006", SOIL_LINE + 1, 7),
    ]
