"""A fault leads to no second finding, and what may be defined elsewhere is no error."""

from __future__ import annotations

import pytest

from tests.helpers.builders.decks import PIPE
from tests.helpers.builders.scenes import all_reported, messages, reported, scene_of

RESTART = "$LOAD CASE\n*RESTART\n LAST=static\n"


# -------------------------------------------------------------------------------- what is not read may define a name


def test_a_set_of_the_deck_goes_before_one_of_a_line() -> None:
    text = PIPE + "*LINES\n LINE=SCR\n*ELEMENT SETS\n SET=scr\n 1\n"
    named = scene_of(text).set_table.named["scr"]
    assert (named.name, named.elements.tolist(), named.open) == ("scr", [0], False)


def test_keywords_astray_may_define_it() -> None:
    seabed = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=b\n STIFFNESS=1\n"
    early = "*ELEMENT SETS\n SET=b\n 1\n" + PIPE + seabed
    assert messages(early)[0].endswith("the *ELEMENT SETS before the first section may define it")
    wrong = "$LOAD CASE\n*ELEMENT SETS\n SET=b\n 1\n" + PIPE + seabed
    assert messages(wrong)[0].endswith("the *ELEMENT SETS in $LOAD CASE, where it does not belong, may define it")
    right = "$CLEAR\n*ELEMENT SETS\n 1, 2\n 3, 4\n" + PIPE + seabed
    assert reported(right)[0][:2] == ("E", "REF001")


def test_a_deck_that_continues_another_needs_no_model() -> None:
    assert reported(RESTART) == []
    model = "$MODEL\n*ELEMENT SETS\n SET=a\n 1, 2\n SUBSET=b\n*EMBEDMENT\n SET=c\n 0, 0\n 1, 1\n"
    found = reported(RESTART + model)
    assert {severity for severity, _, _, _ in found} == {"W"}
    assert [code for _, code, _, _ in found] == ["REF005", "REF008", "SBD005", "REF001"]


# --------------------------------------------------------------------------------------------------------- follow-ups


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("STIFFNESS=", ["SYN003"]),
        ("STIFFNESS==[nothing]", ["REF013"]),
        ("STIFFNESS=-5", ["SBD010"]),
        ("STIFNESS=5", ["SYN004"]),
        ("STIFFNESS=5, Clay", ["SYN003"]),
    ],
)
def test_a_law_that_could_not_be_read_is_unknown(line: str, expected: list[str]) -> None:
    text = PIPE + f"*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n {line}\n"
    assert [code for _, code, _, _ in all_reported(text)] == expected
    grant = scene_of(text).laws.set_laws[0]
    assert grant.unknown


@pytest.mark.parametrize("type_", ["ELASTC", "", "RIGID, ELASTIC"])
def test_a_type_that_could_not_be_read_is_told_once(type_: str) -> None:
    text = PIPE + f"*SEABED PROPERTIES\n TYPE={type_}\n SET=ALL\n FRICTION=0.3\n*EMBEDMENT\n SET=ALL\n 0, 0\n 1, 1\n"
    scene = scene_of(text)
    assert len(scene.deck.problems) == 1
    assert "SBD005" not in [problem.code.code for problem in scene.problems]


def test_a_set_that_could_not_be_read_gives_its_law_to_nothing() -> None:
    text = PIPE + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=\n STIFFNESS=5\n"
    scene = scene_of(text)
    assert scene.problems == []
    assert scene.law_names == ["none"] * 10
    assert scene.laws.uncertain


def test_elements_out_of_sight_are_told_once_for_a_list() -> None:
    text = "$MODEL\n*LINES\n LINE=SCR\n*ELEMENT SETS\n SET=a\n 1, 2, 3\n 4\n GEN=5, 9\n"
    assert reported(text) == [("W", "REF005", 6, 2), ("W", "REF005", 7, 2)]
    assert messages(text)[0].startswith("3 elements of this list (first: 1) are not defined; *LINES")
