"""What elements and nodes have twice, and what unread keywords may hide: where it is told, and where not."""

from __future__ import annotations

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from tests.checks.findings import found, messages

LINE = "$MODEL\n*NODE\n 1, 50.0, 0.0\n 6, 50.0, 50.0\n GEN=1, 6\n*ELEMENT\n 1, 1, 2\n GEN=1, 5\n"
STEEL = " 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0\n"
HELD = "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n 6, 1\n"
CURRENT = "*CURRENT\n TYPE=UNIFORM\n 0.5\n"


def sections(one: str, other: str) -> str:
    sets = f"*ELEMENT SETS\n SET=A\n GEN={one}\n SET=B\n GEN={other}\n"
    return LINE + sets + f"*GEOMETRIC SETS\n OPTION=RIGID\n SET=A\n{STEEL} SET=B\n{STEEL}"


def test_sets_that_overlap_in_part() -> None:
    assert found(sections("1, 3", "3, 5"), "GEO013") == [("GEO013", 18, 6)]
    assert "element 3 the values of SET='A': this line holds" in messages(sections("1, 3", "3, 5"), "GEO013")[0]
    coefficients = sections("1, 3", "2, 5").partition("*GEOMETRIC")[0]
    coefficients += "*HYDRODYNAMIC SETS\n SET=A\n 1.0\n SET=B\n 1.2\n"
    assert found(coefficients, "GEO013") == [("GEO013", 17, 6)]


@pytest.mark.parametrize(("one", "other"), [("1, 2", "3, 5"), ("1, 5", "3, 4"), ("3, 4", "1, 5")])
def test_a_set_that_refines_another_one(one: str, other: str) -> None:
    assert found(sections(one, other), "GEO013") == []


def test_two_elements_between_the_same_nodes() -> None:
    assert found(LINE + " 9, 3, 2\n", "GEO014") == [("GEO014", 9, 2)]
    assert "element 2 joins already" in messages(LINE + " 9, 3, 2\n", "GEO014")[0]
    assert found(LINE + " 9, 3, 1\n", "GEO014") == []
    assert found(LINE + " 9, 3, 2\n*HINGE\n 9\n", "GEO014") == []
    assert found(LINE + " 9, 3, 2\n*DAMPER\n 9\n", "GEO014") == []


@pytest.mark.parametrize(
    ("lines", "severity"),
    [(" 1, 1, 0.5\n", "warning"), (" 1, 1, 0.0\n", "info"), (" GEN=1, 3, 1, 1, 0.5\n", "warning")],
)
def test_a_freedom_that_is_held_twice(lines: str, severity: str) -> None:
    assert [code for code, line, _ in found(LINE + HELD + lines, "BND001") if line == 14] == ["BND001"]
    words = "in the same way" if severity == "info" else "at 0.0, and at 0.5 here"
    assert words in messages(LINE + HELD + lines, "BND001")[0]


def test_other_freedoms_and_other_load_cases() -> None:
    assert found(LINE + HELD + " 1, 2\n GEN=2, 5, 1, 1\n" + HELD, "BND001") == []


@pytest.mark.parametrize(
    ("line", "count"), [("1, Barge", 1), ("1, Barge, 1", 1), ("1, Barge, 2", 0), ("1, 1", 1), ("2, Barge", 0)]
)
def test_a_node_at_a_place_and_on_a_vessel(line: str, count: int) -> None:
    assert found(LINE + HELD + f" TYPE=VESSEL\n {line}\n", "BND002") == [("BND002", 15, 2)] * count


@pytest.mark.parametrize("keyword", ["TITLE", "DAMPING", "COATINGS", "TEMPERATURE"])
def test_a_keyword_that_gives_nothing_hides_nothing(keyword: str) -> None:
    deck = sections("1, 2", "4, 5") + f"*HYDRODYNAMIC SETS\n SET=A\n 1.0\n*{keyword}\n 5\n" + HELD + CURRENT
    assert [code for code, _, _ in found(deck, "GEO007", "GEO008")] == ["GEO007", "GEO008"]


def test_inner_pipes_need_no_coefficients() -> None:
    deck = sections("1, 2", "3, 5") + "*HYDRODYNAMIC SETS\n SET=A\n 1.0\n{}" + HELD + CURRENT
    assert found(deck.format(""), "GEO008") == [("GEO008", 8, 2)]
    assert found(deck.format("*PIP SECTION\n OUTER=A, INNER=B\n"), "GEO008") == []


def test_a_tapered_joint_has_no_other_section() -> None:
    joint = "*TAPER\n SET=B\n 207.0E9, 79.6E9, 7850.0, 0.2731, 0.3239, 0.4\n"
    alone = sections("1, 3", "4, 5").replace(f" SET=B\n{STEEL}", "")
    assert found(alone + joint + HELD, "GEO006", "GEO007", "GEO013") == []
    assert found(alone.replace("1, 3", "1, 4") + joint + HELD, "GEO013") == [("GEO013", 19, 6)]
    whole = alone.replace(" SET=A\n 207", " SET=ALL\n 207")
    assert "it is of *GEOMETRIC SETS, and which holds is open" in messages(whole + joint, "GEO013")[0]


def test_a_joint_needs_no_section() -> None:
    deck = sections("1, 2", "3, 4") + "*FLEXJOINT\n ELEMENT=5\n TYPE=LINEAR\n 9.0E3\n" + HELD
    assert found(deck, "GEO007") == []


def test_a_deck_without_elements() -> None:
    nodes = LINE.partition("*ELEMENT")[0]
    assert found(nodes + HELD, "GEO015") == [("GEO015", 1, 1)]
    assert found(nodes, "GEO015") == []
    assert found(nodes + "*LINES\n LINE=a\n" + HELD, "GEO015") == []
    assert found(nodes + HELD + "*RESTART\n LAST=static\n", "GEO015") == []
    assert found(LINE + HELD, "GEO015") == []


@pytest.mark.parametrize(
    ("coefficients", "suffix", "words"),
    [
        (
            "1.0, 0.0, 2.0, 1.0, 0.0",
            "keyxm",
            "read as 1 normal, 0 tangential (inferred): these are the defaults, remove both",
        ),
        ("1.0, 0.0, 2.0, 0.2, 1.0", "keyxm", "read as 0.2 normal, 1 tangential (inferred): keep them"),
        ("1.0, 0.0, 2.0, 1.0, 1.0", "keyxm", ""),  # the same in either order
        ("1.0, 0.0, 2.0, 1.0", "keyxm", ""),
        ("1.0, 0.0, 2.0, 1.0, 0.0", "das", ""),  # whose order is public
    ],
)
def test_added_masses_say_how_they_are_read(coefficients: str, suffix: str, words: str) -> None:
    text = f"$MODEL\n*HYDRODYNAMIC SETS\n SET=ALL, TYPE=CONSTANT\n {coefficients}\n"
    found = [one.message for one in lint_bytes(text.encode(), f"deck.{suffix}", select(["GEO016"]))]
    assert len(found) == bool(words)
    assert words in "".join(found)
