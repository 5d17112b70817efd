"""Findings about rows, values and copies: one for one slip."""

from __future__ import annotations

import pytest

from tests.linting.test_causes import DECK, changed, found

NODES = DECK[DECK.index("*NODE") : DECK.index("*ELEMENT\n")]
ROWS = "*NODE\n" + "".join(f" {number}, -0.05, {10.0 * number - 10.0}\n" for number in range(1, 12))
LISTED = DECK.replace(NODES, ROWS)
CURVE = " CURVE=Clay\n 0.0, 0.0\n 0.5, 20000.0\n"
POINTS = " CURVE=Clay\n 1, 0.0, 0.0\n 2, 0.1, 8000.0\n 3, 0.3, 15000.0\n 4, 0.5, 20000.0\n"
SECTION = " SET=ALL\n 1.0E8, 1.0E8, 8.0E7, 3.5E9, 130.0, 0.0, 0.2889, 0.3239, 0.3239, 0.3239\n"
STEEL = " OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0\n"


def summary(text: str, name: str = "deck.keyxm") -> list[tuple[str, int, int]]:
    return [(one.code, one.line, len(one.following)) for one in found(text, name)]


def test_the_decks_without_a_fault_are_clean() -> None:
    assert found(LISTED) == []
    assert found(changed((SECTION, STEEL))) == []


def test_the_same_fault_in_row_after_row_is_one_finding() -> None:
    (one,) = (each for each in found(changed((CURVE, POINTS))) if each.code == "SYN003")
    assert one.message == ("3 fields, expected 2 (`ratio, force`); and 3 more rows of this block, the last in line 24")
    assert (one.line, [each.line for each in one.following]) == (21, [22, 23, 24])


def test_two_rows_may_each_have_a_fault() -> None:
    text = changed((CURVE, "".join(POINTS.splitlines(keepends=True)[:3])))
    assert [one.line for one in found(text) if one.code == "SYN003"] == [21, 22]


def test_rows_of_which_something_else_is_said_are_apart() -> None:
    wrong = [" 0.1x, 1.0\n", " O.2, 2.0\n", " 0..3, 3.0\n", " --0.4, 4.0\n"]
    text = changed((CURVE, " CURVE=Clay\n 0.0, 0.0\n" + "".join(wrong) + " 0.5, 20000.0\n"))
    assert [one.line for one in found(text) if one.code == "SYN002"] == [22, 23, 24, 25]


def test_the_fields_of_a_heading_are_one_finding() -> None:
    (one,) = found(LISTED.replace("*NODE\n", "*NODE\n Node, X, Y\n"))
    assert (one.code, one.line, len(one.following)) == ("SYN002", 5, 2)
    assert one.message.endswith("; and 2 more fields of this row")


def test_values_of_a_misread_row_are_not_judged() -> None:
    text = changed((SECTION, STEEL.replace("207.0E9, 79.6E9", "207.0E9 79.6E9")))
    (one,) = found(text)
    assert (one.code, one.line) == ("SYN003", 19)
    assert {each.code for each in one.following} == {"SYN002", "UNT005", "GEO001"}


ONE_CAUSE = {
    "a keyword line without its star": (("*ELEMENT\n", "ELEMENT\n"), "SYN003", 16),
    "a number used twice": ((" 7, -0.05", " 6, -0.05"), "REF007", 11),
    "nodes pasted twice": ((ROWS, ROWS + ROWS), "REF007", 17),
    "a letter in a density": ((" 500.0, 1025.0", " 500.0, l025.0"), "SYN002", 3),
    "laws without their keyword line": (("*SEABED PROPERTIES\n TYPE", "*CABLE\n x\n TYPE"), "SBD006", 36),
}


@pytest.mark.parametrize(("change", "code", "line"), ONE_CAUSE.values(), ids=ONE_CAUSE)
def test_a_slip_is_one_finding(change: tuple[str, str], code: str, line: int) -> None:
    assert LISTED.count(change[0]) == 1
    (one,) = (each for each in found(LISTED.replace(*change)) if each.severity != "info")
    assert (one.code, one.line) == (code, line)


def test_a_number_that_fits_no_neighbour_is_not_guessed() -> None:
    text = LISTED.replace(" 7, -0.05", " 3, -0.05").replace("*ELEMENT\n 1, 1, 2", "*ELEMENT\n 1, 1, 99")
    assert "is this one 99" not in "".join(one.message for one in found(text))


FALLING = " CURVE=Clay\n 0.0, 3000.0\n 0.1, 2000.0\n 0.5, 0.0\n"


def test_the_shape_of_a_curve_is_one_finding() -> None:
    assert summary(changed((CURVE, FALLING))) == [("CRV005", 22, 2)]
    far = " CURVE=Clay\n 0.0, 0.0\n 10.0, 800.0\n 0.2, 1200.0\n 0.5, 20000.0\n"
    assert [one[:2] for one in summary(changed((CURVE, far)))] == [("CRV010", 22)]


def test_two_softening_parts_of_a_curve_are_two_findings() -> None:
    text = " CURVE=Clay\n 0.0, 0.0\n 0.1, 3000.0\n 0.2, 2000.0\n 0.3, 5000.0\n 0.4, 4000.0\n 0.5, 9000.0\n"
    assert [one[:2] for one in summary(changed((CURVE, text)))] == [("CRV005", 23), ("CRV005", 25)]


def test_names_come_from_the_findings_and_not_from_their_words() -> None:
    text = changed((" SET=Left\n STIFF", " SET=O'Brien's\n STIFF"), (" SET=Left\n 1,", " SET=\n 1,"))
    assert [(one.code, len(one.following)) for one in found(text)][:1] == [("SYN003", 1)]
