"""Ranges of fields, and what rules that block find in decks that they used to miss or to refuse in vain."""

from __future__ import annotations

import pytest

from mudline.language.diagnostics import Blocks, DeckError, Severity
from tests.helpers.builders.decks import LINEAR_BED, PIPE, STEEL
from tests.helpers.builders.scenes import messages, reported, scene_of


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


@pytest.mark.parametrize(
    ("lines", "column", "message"),
    [
        ("*OCEAN\n -5.0, 1025", 2, "water depth is -5.0: it must be greater than 0"),
        ("*OCEAN\n 0.0, 1025", 2, "water depth is 0.0: it must be greater than 0"),
        ("*OCEAN\n 5.0, -1", 7, "density of sea water is -1.0: it must not be less than 0"),
        ("*ELASTIC SURFACE\n -1, 0.3", 2, "stiffness per unit length is -1.0"),
        ("*RIGID SURFACE\n 0.3, -0.3", 7, "transverse friction coefficient is -0.3"),
    ],
)
def test_values_of_rows(lines: str, column: int, message: str) -> None:
    text = f"$MODEL\n{lines}\n"
    assert reported(text) == [("E", "SBD010", 3, column)]
    assert message in messages(text)[0]


@pytest.mark.parametrize(
    ("keyword", "line", "names"),
    [
        (
            "SEABED PROPERTIES",
            "FRICTION=-0.3, 0.6, 0.0, -0.01",
            ["longitudinal friction coefficient", "longitudinal mobilisation length", "transverse mobilisation length"],
        ),
        ("SEABED PROPERTIES", "STIFFNESS=-1.0", ["STIFFNESS="]),
        ("SEABED FRICTION", "COEFFICIENTS=-0.3, 0.6", ["friction coefficient along u1"]),
        ("SEABED TRENCH", "PEAK=-1.0", ["PEAK="]),
        ("SEABED TRENCH", "PEAK=TABLE\n 0, -1\n 1, 5\n 2, -3", ["lateral resistance per unit length there"] * 2),
        ("SEABED SUCTION", "CYCLIC=-0.1", ["CYCLIC="]),
    ],
)
def test_a_field_is_named_once(keyword: str, line: str, names: list[str]) -> None:
    kind = " TYPE=ELASTIC\n" if keyword == "SEABED PROPERTIES" else ""
    found = [message for message in messages(f"$MODEL\n*{keyword}\n{kind} SET=ALL\n {line}\n") if "must" in message]
    assert [message.partition(" is ")[0] for message in found] == names


def test_values_of_sections_are_named_by_their_symbol() -> None:
    text = "$MODEL\n*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 1, 1, 0.0, -0.2, 7850\n"
    assert reported(text) == [("E", "SBD010", 5, 8), ("E", "SBD010", 5, 13)]
    assert messages(text) == [
        "external diameter Do is 0.0: it must be greater than 0",
        "internal diameter Di is -0.2: it must not be less than 0",
    ]
    text = "$MODEL\n*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 1, 1, 0.3, 0.2, 7850, , -1.0\n"
    assert [message.partition(" is ")[0] for message in messages(text)] == ["second moment of area (I)"]


def test_the_floor_of_cyclic_loading_is_a_share() -> None:
    deck = "$MODEL\n*SEABED SUCTION\n SET=ALL\n CYCLIC={}\n COHESION=5000\n*ELASTIC SURFACE\n 5000\n"
    assert reported(deck.format("0.9, 1.0")) == reported(deck.format("1.5, 0.0")) == []
    assert reported(deck.format("0.9, 1.01")) == [("E", "SBD010", 4, 14)]
    assert reported(deck.format("-0.9, -0.01")) == [("E", "SBD010", 4, 9), ("E", "SBD010", 4, 15)]
    assert messages(deck.format("0.9, 2")) == [
        "share of the first largest force below which the cycles do not lower it is 2.0: it must not be more than 1"
    ]
