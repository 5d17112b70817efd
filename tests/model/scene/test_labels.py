"""Labels that `*LABEL` gives: they stand for numbers wherever these may stand, and one that is not given is told."""

from __future__ import annotations

import pytest

from mudline.language.diagnostics import Severity
from tests.helpers.builders.scenes import all_reported, diagnostics, ends_of, legal_scene, members, scene_of

GRID = "$MODEL\n*NODE\n 1, 0.0, 0.0\n 2, 0.0, 10.0\n 3, 0.0, 20.0\n"
BARS = "*ELEMENT\n 7, {Anchor}, 2\n 8, 2, {HANG-OFF}\n*ELEMENT SETS\n SET=Top\n {Last Joint}\n"
LABELS = (
    "*LABEL\n TYPE=NODE\n 1, LABEL=Anchor\n 3, LABEL=Hang-off\n TYPE=ELEMENT\n 8, LABEL=Last Joint\n"
    " 7, LABEL=Hang-off\n"
)
HELD = "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n {Anchor}, 1\n GEN={Anchor}, {Hang-off}, 2\n"
SUMMARY = "$SUMMARY POSTPROCESSING\n*PARA ANGLE ELEMENT\n DATA1={last joint}\n DATA2={Hang-off}\n"


def test_labels_are_the_numbers_of_nodes_and_elements() -> None:
    scene = legal_scene(GRID + BARS + LABELS)
    assert ends_of(scene) == {7: [1, 2], 8: [2, 3]}
    assert members(scene)["Top"] == [8]


@pytest.mark.parametrize(
    ("right", "wrong", "code", "words"),
    [
        ("{Anchor}, 1\n", "{Ancor}, 1\n", "REF006", "node label '{Ancor}' is not defined (did you mean Anchor?)"),
        ("{last joint}", "{last joints}", "REF005", "element label '{last joints}' is not defined (did you mean Last"),
        ("2, {HANG-OFF}", "2, {Last Joint}", "REF006", "node label '{Last Joint}' is not defined"),
        (" 3, LABEL", " 4, LABEL", "REF006", "node 4, which is not defined"),
        (" 7, LABEL=Hang-off", " 7, LABEL=Last Joint", "REF007", "that of element 8 and of element 7"),
    ],
)
def test_a_label_that_is_wrong_is_told(right: str, wrong: str, code: str, words: str) -> None:
    found = diagnostics(scene_of((GRID + BARS + LABELS + HELD + SUMMARY).replace(right, wrong, 1)))
    assert found[0].code == code
    assert found[0].severity is Severity.ERROR
    assert words in found[0].message


def test_labels_of_lines_that_are_not_read_may_be_there_too() -> None:
    lines = "*LINES\n LINE=Umbilical\n START=Connector, 0.0, 0.0, 0.0\n"
    told = diagnostics(scene_of(GRID + BARS + LABELS + lines + "*MASS\n {Elsewhere}, 20.0\n {Ancor}, 1.0\n"))
    labels = [(one.code, one.severity) for one in told if "label" in one.message]
    assert labels == [("REF006", Severity.WARNING)]


def test_what_a_broken_line_of_labels_may_have_given_is_not_missed() -> None:
    broken = (GRID + BARS + LABELS + HELD).replace(" 3, LABEL=Hang-off", " 3")
    assert {code for _, code, _, _ in all_reported(broken)} == {"SYN001"}


def test_a_deck_without_labels_says_where_they_are_made() -> None:
    (found, *_) = diagnostics(scene_of(GRID + "*MASS\n {Top}, 1.0\n"))
    assert found.message == (
        "node '{Top}' is a label, and nothing in this deck makes labelled nodes: define it in *LABEL, or give a number"
    )
