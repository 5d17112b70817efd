"""What no element follows is left out of the new deck, and stays in comments."""

from __future__ import annotations

import pytest

from mudline.migration.migrating import migrate, verify
from tests.builders.decks import PIPE_WITH_SETS
from tests.builders.scenes import deck_of

SURFACE = "*ELASTIC SURFACE\n 1e4, 0.3, 0.6\n"
LINES = "$MODEL\n*LINES\n LINE=Riser\n SECTION=West, 10\n"
FIRST, SECOND = " 0, 0\n 1, 5\n", " 0, 0\n 1, 7\n"


def seabed_after(head: str, bed: str, *, extended: bool = False) -> str:
    """The seabed of the new deck, which is verified."""
    found = migrate(deck_of(head + bed), extended=extended)
    assert verify(found).differences == ()
    text = found.content.decode()
    assert text.startswith(head)
    return text.removeprefix(head)


def group(name: str, stiffness: str) -> str:
    return f" SET={name}\n STIFFNESS={stiffness}\n FRICTION=0.3, 0.6\n"


def left_out(*lines: str) -> str:
    return "".join(f"C{line}\n" for line in (" left out, as no element is on this curve:", *lines))


NO_STIFFNESS = "*SEABED PROPERTIES\nC stiffness 1e4 left out, as every element is on a curve\n TYPE=ELASTIC\n"


@pytest.mark.parametrize("head", [PIPE_WITH_SETS, LINES], ids=["elements", "lines"])
@pytest.mark.parametrize("name", ["", " SET=ALL\n", " SET=all\n"])
def test_a_curve_for_all_makes_one_group(head: str, name: str) -> None:
    curve = name.strip().removeprefix("SET=") or "ALL"
    assert seabed_after(head, f"{SURFACE}*EMBEDMENT\n{name}{FIRST}") == (
        NO_STIFFNESS + group(curve, curve) + f"*SEABED STIFFNESS\n CURVE={curve}\n{FIRST}"
    )


def test_curves_for_all_elements_replace_the_stiffness() -> None:
    head = PIPE_WITH_SETS.replace(" SET=7\n 3, 9\n", " SET=7\n 11, 12\n")
    curves = f" SET=West\n{FIRST} SET=East Bank\n{SECOND} SET=7\n{FIRST}"
    named = curves.replace("SET=7", "SET=7 curve").replace("SET=", "CURVE=")
    assert seabed_after(head, f"{SURFACE}*EMBEDMENT\n{curves}") == (
        NO_STIFFNESS
        + group("West", "West")
        + group("East Bank", "East Bank")
        + group("7", "7 curve")
        + f"*SEABED STIFFNESS\n{named}"
    )


@pytest.mark.parametrize(
    ("head", "extended"), [(PIPE_WITH_SETS + "*LINES\n LINE=Riser\n", False), (PIPE_WITH_SETS, True)]
)
def test_the_stiffness_stays_where_there_may_be_more_elements(head: str, *, extended: bool) -> None:
    head = head.replace(" SET=7\n 3, 9\n", " SET=Pipe\n GEN=1, 12\n")
    found = seabed_after(head, f"{SURFACE}*EMBEDMENT\n SET=Pipe\n{FIRST}", extended=extended)
    assert found.startswith("*SEABED PROPERTIES\n TYPE=ELASTIC\n" + group("ALL", "1e4") + group("Pipe", "Pipe"))


@pytest.mark.parametrize("head", [PIPE_WITH_SETS, LINES], ids=["elements", "lines"])
def test_an_earlier_curve_of_a_set_stays_in_comments(head: str) -> None:
    bed = f"*EMBEDMENT\n SET=West\nC rev A\n{FIRST}\n{SURFACE}*EMBEDMENT\n SET=west\n{SECOND}"
    assert seabed_after(head, bed) == (
        "C *EMBEDMENT\n"
        + left_out("  SET=West")
        + "C rev A\nC  0, 0\nC  1, 5\n\n*SEABED PROPERTIES\n TYPE=ELASTIC\n"
        + group("ALL", "1e4")
        + group("west", "west")
        + f"*SEABED STIFFNESS\n CURVE=west\n{SECOND}"
    )


def test_curves_before_one_for_all_are_left_out() -> None:
    bed = f"{SURFACE}*EMBEDMENT\n SET=West\n{FIRST} SET=ALL\n{SECOND} SET=7\n{FIRST}"
    assert seabed_after(PIPE_WITH_SETS, bed) == (
        NO_STIFFNESS
        + group("ALL", "ALL")
        + group("7", "7 curve")
        + "*SEABED STIFFNESS\n"
        + left_out("  SET=West", "  0, 0", "  1, 5")
        + f" CURVE=ALL\n{SECOND} CURVE=7 curve\n{FIRST}"
    )


def test_a_block_that_becomes_comments_below_an_opaque_one() -> None:
    head = PIPE_WITH_SETS + "*HYDRODYNAMIC SETS\n SET=ALL\n 1.0, 2.0\n"
    bed = f"*EMBEDMENT\n SET=7\n\n{FIRST}{SURFACE}*EMBEDMENT\n SET=7\n{SECOND}"
    assert seabed_after(head, bed).startswith("C *EMBEDMENT\n" + left_out("  SET=7"))


def test_a_surface_without_stiffness_needs_no_comment() -> None:
    found = seabed_after(PIPE_WITH_SETS, f"*ELASTIC SURFACE\n , 0.3, 0.6\n*EMBEDMENT\n{FIRST}")
    assert found == f"*SEABED PROPERTIES\n TYPE=ELASTIC\n{group('ALL', 'ALL')}*SEABED STIFFNESS\n CURVE=ALL\n{FIRST}"
