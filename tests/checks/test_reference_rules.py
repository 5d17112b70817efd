"""Rules over names, sets, lists and parameters: where they find something, and above all where they do not."""

from __future__ import annotations

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from mudline.language.deck.forms.json import to_json
from mudline.language.deck.loading import load_bytes
from tests.checks.findings import CLAY, CURVES, PIPE, PROPERTIES, RESTART, curve, found, messages, repaired


@pytest.mark.parametrize(
    "text",
    [
        CURVES + CLAY + PROPERTIES + " STIFFNESS=clay\n",
        '$PREPROCESSOR\n*PARAMETERS\n soil, "Sand"\n'
        + CURVES
        + CLAY
        + curve("Sand", (0, 0), (1, 1))
        + PROPERTIES
        + " STIFFNESS==[soil]\n",
        CURVES + CLAY + PROPERTIES + " STIFFNESS==[nothing]\n",
        CURVES + CLAY + PROPERTIES + " STIFFNESS=Caly\n",
        CURVES + CLAY + PROPERTIES + " STIFFNESS=\n",
        CURVES + CLAY + PROPERTIES + " STIFNESS=Clay\n",
        CURVES + CLAY + "*SEABED PROPERTEIS\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n",
        CURVES + CLAY + "$LOAD CASE\n" + PROPERTIES + " STIFFNESS=Clay\n",
        PROPERTIES + " STIFFNESS=Clay\n" + CURVES + CLAY,
        RESTART + CURVES + CLAY,
        "$PREPROCESSOR\n*VARIATION\n NAME=v\n ACTION=ADD, KEYWORD=SEABED PROPERTIES, FILE=x\n" + CURVES + CLAY,
        CURVES + " CURVE=\n 0, 0\n 1, 1\n",
        "$MODEL\n*ELASTIC SURFACE\n ,\n*EMBEDMENT\n SET=ALL\n 0, 0\n 1, 1\n",
    ],
)
def test_curves_that_are_used_or_may_be(text: str) -> None:
    assert found(text, "REF003") == []


def test_a_curve_whose_name_reads_as_a_number_is_not_reached() -> None:
    text = CURVES + curve("100", (0, 0), (1, 1)) + PROPERTIES + " STIFFNESS=100\n"
    assert found(text, "REF003", "SBD017") == [("SBD017", 3, 8)]


def test_a_second_curve_of_a_set_is_a_duplicate_too() -> None:
    text = "$MODEL\n*ELASTIC SURFACE\n ,\n*EMBEDMENT\n 0, 0\n 1, 1\n SET=all\n 0, 0\n 1, 1\n"
    assert found(text, "REF004") == [("REF004", 7, 6)]
    assert messages(text, "REF004")[0].startswith("set 'all' already has a curve")


@pytest.mark.parametrize(("again", "letter"), [(" 9, 8\n", "info"), (" 3\n", "warning"), (" GEN=2, 9\n", "warning")])
def test_a_repeated_set_whose_elements_add_up_is_an_info(again: str, letter: str) -> None:
    text = "$MODEL\n*ELEMENT SETS\n SET=A\n 1, 2\n GEN=3, 4\n SET=a\n" + again
    (one,) = (one for one in lint_bytes(text.encode(), "deck.keyxm", select(["REF016"])) if one.code == "REF016")
    assert (one.severity.value, one.line) == (letter, 6)


def test_names_of_256_characters_are_fine() -> None:
    text = "$MODEL\n*ELEMENT SETS\n SET={}\n GEN=1, 2\n"
    assert found(text.format("x" * 256), "REF011") == []
    assert found(text.format("x" * 257), "REF011") == [("REF011", 3, 6)]


def listed(count: int, separator: str = ", ") -> str:
    return "$MODEL\n*ELEMENT SETS\n SET=a\n  " + separator.join(map(str, range(1, count + 1))) + "\n"


def test_a_list_of_twenty_is_fine() -> None:
    assert found(listed(20), "REF012") == []
    assert found(listed(21), "REF012") == [("REF012", 4, 74)]


@pytest.mark.parametrize("separator", [", ", ",", " , "])
def test_a_long_list_is_split_into_lines_of_twenty(separator: str) -> None:
    text = repaired(listed(45, separator), "REF012")
    assert [line.replace(" ", "").count(",") for line in text.split("\n")[3:6]] == [19, 19, 4]
    assert [line[:3].count(" ") for line in text.split("\n")[3:6]] == [2, 2, 2]
    assert found(text, "REF012") == []


def test_a_split_line_ends_as_the_lines_of_the_file() -> None:
    finding = lint_bytes(listed(21).replace("\n", "\r\n").encode(), "deck.keyxm", select(["REF012"]))[0]
    assert finding.fix is not None
    assert (finding.fix.applicability, finding.fix.edits[0].text) == ("safe", "\r\n  ")


def test_a_list_with_an_empty_field_is_told_and_not_split() -> None:
    findings = lint_bytes(listed(25).replace("20,", "20,,").encode(), "deck.keyxm", select(["REF012"]))
    assert [finding.fix for finding in findings] == [None]


def test_lists_of_files_with_lone_returns_are_split_and_those_of_documents_are_only_told() -> None:
    finding = lint_bytes(listed(21).replace("\n", "\r").encode(), "deck.keyxm", select(["REF012"]))[0]
    assert finding.fix is not None
    assert finding.fix.edits[0].text == "\r  "
    document = to_json(load_bytes(listed(21).encode(), "deck.keyxm")).encode()
    assert [one.fix for one in lint_bytes(document, "deck.json", select(["REF012"]))] == [None]


def test_sets_are_repeated_without_case_and_over_blocks() -> None:
    text = "$MODEL\n*ELEMENT SETS\n SET=a\n 1\n SET=b\n 2\n*ELEMENT SETS\n SET=A\n 3\n SET=ALL\n 1\n SET=All\n"
    text += " SET=\n SET=a\n"
    assert found(text, "REF016") == [("REF016", 8, 6), ("REF016", 14, 6)]


def test_items_of_lists_repeat_parameters() -> None:
    text = "$PREPROCESSOR\n*PARAMETERS\n soil_k, 1\n Soil, /K:2, mu:3/\n n, /1 2/\n n, /3 4/\n od\n x, =[soil_k]\n"
    assert found(text, "REF017") == [("REF017", 4, 2), ("REF017", 6, 2)]
    assert "and 1 more" in messages(text, "REF017")[1]


@pytest.mark.parametrize(
    ("given", "advice"),
    [("45O00.0", ": if it is a number, write 45000.0"), ("Clay0.l", ": *SEABED STIFFNESS has no such curve")],
)
def test_a_number_with_a_letter_is_no_name_of_a_curve(given: str, advice: str) -> None:
    (message,) = messages(PIPE + PROPERTIES + f" STIFFNESS={given}\n", "REF002")
    assert message == f"curve '{given}' is not defined{advice}"
