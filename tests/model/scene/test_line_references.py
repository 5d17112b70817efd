"""Names that the keywords of lines use of each other, and labels that are nearly one that a line makes."""

from __future__ import annotations

import pytest

from tests.helpers.builders.scenes import messages, reported

LINES = "*LINES\n LINE=SCR\n"
LOCATIONS = "*LINE LOCATIONS\n LINE=SCR\n Seabed End, 0.0\n {Hang-off}, 1200.0\n"


# --------------------------------------------------------------------------------------------------------------- labels


def nodes(*labels: str) -> str:
    return "".join(f" {index}, {label}, {label}\n" for index, label in enumerate(labels, 1))


def test_labels_that_lines_make() -> None:
    text = (
        "$MODEL\n"
        + LINES
        + LOCATIONS
        + "*ELEMENT\n"
        + nodes("{Seabed End}", "{HANG-OFF}", "{Elsewhere}")
        + " GEN=3, 2\n"
    )
    assert reported(text) == []


def test_labels_that_are_nearly_so() -> None:
    text = "$MODEL\n" + LINES + LOCATIONS + "*ELEMENT\n 1, {Seabed Ende}, 2\n*ELEMENT SETS\n SET=a\n 1, {Hangoff}\n"
    found = {message for message in messages(text) if message.startswith("label")}
    stands = "is not in *LINE LOCATIONS or *LINES"
    assert found == {
        f"label '{{Seabed Ende}}' {stands} (did you mean {{Seabed End}}?): correct it",
        f"label '{{Hangoff}}' {stands} (did you mean {{Hang-off}}?): correct it",
    }
    assert [entry for entry in reported(text) if entry[3] > 2] == [
        ("W", "REF006", 9, 5),
        ("W", "REF006", 9, 20),
        ("W", "REF005", 12, 5),
    ]


@pytest.mark.parametrize("other", ["{End 2}", "{End B}", "{End 11}", "{Oil Jumper FPSO}", "{Turret}"])
def test_a_label_that_differs_on_purpose_is_another_label(other: str) -> None:
    text = "$MODEL\n*LINES\n LINE=a\n {End 1}\n {End A}\n {Gas Jumper FPSO}\n*ELEMENT\n"
    assert reported(text + nodes("{End 1}", other)) == []


def test_a_label_beside_a_number_that_could_not_be_read() -> None:
    text = "$MODEL\n" + LINES + LOCATIONS + "*ELEMENT\n 1, {Seabed Ende}, {Seabed End}, 1.x\n"
    assert reported(text) == [("W", "REF006", 9, 5)]


# ----------------------------------------------------------------------------------------------- lines and their groups

SECTIONS = "*LINE PATH SECTIONS\n LINE=Flowline\n SECTION=a, 0, 100, REPEAT=Joint\n"
GROUPS = "*LINE SECTION GROUPS\n NAME=Joint\n SECTION=b, 12.0\n"
ROUTE = "*LINE PATHS\n LINE=Flowline\n 0, 0, 0\n"


def test_a_group_that_is_not_defined() -> None:
    assert reported("$MODEL\n" + SECTIONS) == [("W", "REF001", 4, 28)]
    text = "$MODEL\n" + SECTIONS + GROUPS.replace("Joint", "Joints")
    wanted = "REPEAT= names no group: 'Joint' is not defined (did you mean Joints?); define it in *LINE SECTION GROUPS"
    assert messages(text) == [wanted]
    later = "$LOAD CASE\n*RESTART\n LAST=static\n"
    assert messages(text + later) == [wanted + "; the deck that *RESTART continues may define it"]


def test_a_line_that_is_not_defined() -> None:
    text = "$MODEL\n" + ROUTE.replace("Flowline", "Flow Line") + SECTIONS + GROUPS
    assert reported(text) == [("W", "REF001", 6, 7)]
    assert messages(text) == [
        "LINE= names no line: 'Flowline' is not defined (did you mean Flow Line?); define it in *LINE PATHS"
    ]
