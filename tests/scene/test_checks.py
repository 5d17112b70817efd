"""The list of checks, and what they find in decks that they used to miss or to refuse in vain."""

from __future__ import annotations

import pytest

from mudline.diagnostics import Blocks, DeckError, Severity
from mudline.scene.checks import all_checks
from tests.builders.decks import LINEAR_BED, PIPE, STEEL
from tests.builders.scenes import scene_of


def test_no_check_is_there_twice() -> None:
    assert len(all_checks()) == len({check.find for check in all_checks()})


@pytest.mark.parametrize(
    ("lines", "code"),
    [
        ("*SEABED PROPERTIES\n SET=ALL\n STIFFNESS=50000\n", "SBD003"),
        ("*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n*SEABED PROFILE\n TYPE=3D\n FILE=a.txt\n", "SBD011"),
        (LINEAR_BED + "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=95.0\n", "SBD012"),
        ("*ELASTIC SURFACE\n 50000\n 0.0, 0.0\n 0.0, 1.0\n", "SBD023"),
        ("*ELASTIC SURFACE\n 50000\n 2.0\n*SEABED PLANES\n PLANE=a\n POINT=0, 0, 0\n SLOPE=0\n", "EXT002"),
        (LINEAR_BED + "*SEABED PLANES\n PLANE=a\n POINT=0, 0, 0\n SLOPE=0\n BOUNDS=5.0, 5.0\n", "EXT007"),
        ("*RIGID SURFACE\n 0.3\n*SEABED UNLOADING\n SET=ALL\n STIFFNESS=1\n", "EXT001"),
        ("*NODE\n 20, -0.05, 0.0\n*ELEMENT\n 20, 1, 20\n" + LINEAR_BED, "GEO004"),
        (LINEAR_BED.replace("ALL", "a") + "*ELEMENT SETS\n SET=a\n SUBSET=a\n", "REF008"),
    ],
)
def test_what_lint_finds_is_refused_with_its_code(lines: str, code: str) -> None:
    with pytest.raises(DeckError) as caught:
        scene_of(PIPE + STEEL + lines).contact()
    assert [one.code for one in caught.value.diagnostics] == [code]


def test_cohesion_needs_a_diameter_unless_it_is_overridden() -> None:
    suction = "*SEABED SUCTION\n SET=ALL\n COHESION=5000\n"
    (found,) = scene_of(PIPE + LINEAR_BED + suction).problems
    assert found.message.startswith("COHESION= needs the external diameter, and 10 elements (first: 1) have none")
    assert scene_of(PIPE + LINEAR_BED + suction + " FORCE=5, 0.2\n DEPTH=1, 0.3\n").problems == []


def test_an_element_that_ends_at_a_word_is_refused_at_the_word() -> None:
    scene = scene_of(PIPE + " 20, 1, End\n" + LINEAR_BED)
    assert [(one.code.code, one.blocking) for one in scene.findings] == [("SYN016", Blocks.ALWAYS)]
    with pytest.raises(DeckError, match="SYN016"):
        scene.contact()


def test_a_wall_that_locks_itself_is_refused_though_a_deck_before_may_give_another_friction() -> None:
    trench = " FRICTION=0.3, 0.6\n*SEABED TRENCH\n SET=ALL\n GEOMETRY=5.0, 1.0, 3.0\n MODEL=WALL\n"
    scene = scene_of(PIPE + STEEL + LINEAR_BED + trench + "$LOAD CASE\n*RESTART\n LAST=static\n")
    (found,) = scene.problems
    assert (found.code.code, found.weight, found.blocking) == ("EXT003", Severity.WARNING, Blocks.ALWAYS)
    with pytest.raises(DeckError, match="EXT003"):
        scene.contact()


def test_many_findings_of_a_check_are_cut_short() -> None:
    many = "".join(f" SET=s{number}\n STIFFNESS=Lost\n" for number in range(1200))
    sets = "*ELEMENT SETS\n" + "".join(f" SET=s{number}\n 1\n" for number in range(1200))
    found = scene_of(PIPE + STEEL + sets + "*SEABED PROPERTIES\n TYPE=ELASTIC\n" + many).problems
    assert len(found) == 1001
    assert found[-1].message == "and more of the same: the first 1000 are listed"
