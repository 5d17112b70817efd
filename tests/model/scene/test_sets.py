"""Element sets: lists, ranges, subsets, names."""

from __future__ import annotations

import pytest

from tests.helpers.builders.decks import PIPE, STEEL
from tests.helpers.builders.scenes import all_reported, members, messages, reported, scene_of

SETS = PIPE + "*ELEMENT SETS\n"
FIRST = SETS.count("\n") + 1
"""Line of the first line behind *ELEMENT SETS."""


def sets_of(lines: str) -> dict[str, list[int]]:
    return members(scene_of(SETS + lines))


def test_lists_ranges_and_subsets_make_one_set() -> None:
    found = sets_of(" SET=a\n 9, 1\n 3\n GEN=5, 8, 3\n SUBSET=b\n SET=b\n GEN=1, 2\n")
    assert found["a"] == [1, 2, 3, 5, 8, 9]
    assert found["b"] == [1, 2]


def test_all_cannot_be_redefined() -> None:
    lines = " SET=aLL\n 1\n"
    assert sets_of(lines) == {"ALL": list(range(1, 11))}
    assert reported(SETS + lines) == [("E", "REF009", FIRST, 6)]


def test_names_have_no_case_and_inner_blanks_count() -> None:
    lines = " SET=Touch Down\n 1\n SET=a\n SUBSET= TOUCH DOWN \n SET=b\n SUBSET=TouchDown\n"
    assert sets_of(lines) == {"ALL": list(range(1, 11)), "Touch Down": [1], "a": [1], "b": []}
    assert reported(SETS + lines) == [("E", "REF008", FIRST + 5, 9)]
    assert "(did you mean Touch Down?)" in messages(SETS + lines)[0]


def test_a_name_defined_twice_holds_the_elements_of_both() -> None:
    lines = " SET=a\n 1\n SET=b\n 9\n SET=A\n GEN=3, 4\n*ELEMENT SETS\n SET=a\n SUBSET=b\n"
    assert sets_of(lines)["a"] == [1, 3, 4, 9]
    assert reported(SETS + lines) == []


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("GEN=1, 10", [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]),
        ("GEN=2, 9, 3", [2, 5, 8]),
        ("GEN=10, 10", [10]),
        ("GEN=7, 8, 9007199254740992", [7]),
    ],
)
def test_ranges(line: str, expected: list[int]) -> None:
    assert sets_of(f" SET=a\n {line}\n")["a"] == expected
    assert reported(SETS + f" SET=a\n {line}\n") == []


@pytest.mark.parametrize("line", ["GEN=5, 4", "GEN=1, 5, 0", "GEN=1, 5, -1"])
def test_ranges_of_nothing(line: str) -> None:
    assert reported(SETS + f" SET=a\n {line}\n") == [("E", "REF010", FIRST + 1, 2)]


def test_a_range_may_be_as_long_as_a_slip_of_the_pen_makes_it() -> None:
    lines = " SET=a\n GEN=1, 9007199254740992\n"
    assert sets_of(lines)["a"] == list(range(1, 11))
    assert reported(SETS + lines) == [("W", "REF005", FIRST + 1, 2)]
    assert "9007199254740982 of its 9007199254740992 elements" in messages(SETS + lines)[0]


def test_undefined_elements_are_told_at_their_fields() -> None:
    lines = " SET=a\n 1, 11, 2, 11, 12\n"
    assert sets_of(lines)["a"] == [1, 2]
    assert reported(SETS + lines) == [("E", "REF005", FIRST + 1, column) for column in (5, 12, 16)]


def test_labels_name_no_element_without_lines() -> None:
    assert reported(SETS + " SET=a\n 1, {Top}\n") == [("E", "REF005", FIRST + 1, 5)]
    assert all_reported(SETS + " SET=a\n 1, Top\n") == [("W", "SYN016", FIRST + 1, 5)]
    assert reported(SETS + " SET=a\n 1, {Top}\n*LINES\n LINE=b\n") == []


def test_a_set_of_what_does_not_exist_is_not_empty_as_well() -> None:
    assert [code for _, code, _, _ in reported(SETS + " SET=a\n 11\n SET=b\n SUBSET=a\n")] == ["REF005"]


def test_a_set_whose_line_could_not_be_read_is_not_empty() -> None:
    assert [code for _, code, _, _ in reported(SETS + " SET=a\n GEM=1, 4\n SET=b\n 1\n")] == []
    assert [code for _, code, _, _ in reported(SETS + " SET=b\n 1\n SET=a\n GEM=1, 4\n")] == []


def test_a_set_that_is_its_own_subset() -> None:
    lines = " SET=a\n 1\n SUBSET=A\n"
    assert reported(SETS + lines) == [("E", "REF008", FIRST + 2, 9)]
    assert sets_of(lines)["a"] == [1]


def test_a_circle_is_told_once() -> None:
    lines = " SET=a\n 1\n SUBSET=b\n SET=b\n 2\n SUBSET=c\n SET=c\n 3\n SUBSET=a\n SET=d\n SUBSET=b\n"
    assert reported(SETS + lines) == [("E", "REF008", FIRST + 8, 9)]
    assert sets_of(lines)["d"] == [2, 3]


def test_two_circles_are_told_both() -> None:
    lines = " SET=a\n SUBSET=b\n SUBSET=c\n SET=b\n SUBSET=a\n SET=c\n SUBSET=a\n"
    assert reported(SETS + lines) == [("E", "REF008", FIRST + 4, 9), ("E", "REF008", FIRST + 6, 9)]


def test_a_set_without_a_readable_name_may_be_the_one_that_is_missing() -> None:
    text = SETS + " SET=\n 1\n SET=b\n SUBSET=a\n"
    assert reported(text) == [("W", "REF008", FIRST + 3, 9)]


@pytest.mark.parametrize(("defined", "used"), [('"Flow Line"', "flow line"), ("Flow Line", '"FLOW LINE"')])
def test_quotes_around_a_name_do_not_count(defined: str, used: str) -> None:
    sets = f"*ELEMENT SETS\n SET={defined}\n 1, 2\n SET=Both\n SUBSET={used}\n 3\n"
    deck = PIPE + STEEL + sets + f"*SEABED PROPERTIES\n TYPE=ELASTIC\n SET={used}\n STIFFNESS=1e5\n"
    assert reported(deck) == []
    assert scene_of(deck).law_names == ["linear"] * 2 + ["none"] * 8
