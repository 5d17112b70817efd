"""Keywords beyond nodes, elements, sets and curves: extensions, beds, boundaries, soil, blocks without a model."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.editing.comparison.comparing import compare
from mudline.editing.comparison.model import Difference
from mudline.language.deck.loading import load_path
from mudline.model.scene.model import resolve
from tests.helpers.builders.decks import ordered_deck
from tests.helpers.builders.scenes import brief, differences

FRICTION = "*SEABED FRICTION\n SET=Pipe\n COEFFICIENTS=0.3, 0.6\n STIFFNESS=2e4\n"
BOUNDARY = "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 2\n 1, 3, 0.5\n GEN=1, 3, 1, 4, 0.0\n"
SOIL = "*P-Y\n SET=Pipe\n DEPTH=0.0\n 0.0, 0.0\n 100.0, 0.1\n DEPTH=2.0\n 0.0, 0.0\n 300.0, 0.1\n"


def between(old: str, new: str) -> list[tuple[str, object, object]]:
    return brief(differences(ordered_deck() + old, ordered_deck() + new))


def test_an_extension_is_told_by_record_and_where_none_says_it_by_element() -> None:
    found = between(FRICTION, FRICTION.replace("0.6", "0.7"))
    assert found == [("*SEABED FRICTION/Pipe/coefficients/second", 0.6, 0.7)]
    more = FRICTION + " SET=Rest\n COEFFICIENTS=0.1, 0.1\n STIFFNESS=1e4\n"
    later = ordered_deck().replace(" SET=Rest\n 3", " SET=Rest\n 2, 3")
    assert ("elements 2/seabed friction/stiffness/first", 20000.0, 10000.0) in brief(
        differences(ordered_deck() + more, later + more)
    )
    added = between("", FRICTION)
    assert ("*SEABED FRICTION/Pipe/stiffness/first", None, 20000.0) in added
    assert not [where for where, _, _ in added if where.startswith("elements")]
    assert [(where, before) for where, before, _ in added if where == "*SEABED FRICTION"] == [
        ("*SEABED FRICTION", None)
    ]


def test_a_type_of_all_records_is_said_of_each_once() -> None:
    bed = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=Pipe\n STIFFNESS=1e4\n"
    lean = ordered_deck().partition("*SEABED PROPERTIES")[0]
    found = brief(differences(lean + bed, lean + bed.replace("ELASTIC", "RIGID")))
    assert found == [("*SEABED PROPERTIES/Pipe/type", "ELASTIC", "RIGID")]


def test_a_later_record_of_a_set_replaces_an_earlier_one() -> None:
    twice = FRICTION + " SET=PIPE\n COEFFICIENTS=0.1, 0.1\n STIFFNESS=1e4\n"
    assert between(twice, "*SEABED FRICTION\n SET=Pipe\n COEFFICIENTS=0.1, 0.1\n STIFFNESS=1e4\n") == []


def test_the_order_of_boundary_conditions_does_not_count() -> None:
    other = "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n GEN=1, 3, 1, 4, 0.0\n 1, 3, 0.5\n 1, 2\n"
    assert between(BOUNDARY, other) == []
    found = between(BOUNDARY, BOUNDARY.replace("0.5", "0.7"))
    assert [(before, after) for _, before, after in found] == [(0.5, 0.7)]
    assert "1, 3" in found[0][0]


@pytest.mark.parametrize(
    "other",
    [
        "$LOAD CASE\n*WAVE\n 2\n$LOAD CASE\n*WAVE\n 5\n*DRILLING MUD\n 1\n",
        "$LOAD CASE\n*DRILLING MUD\n 1\n*WAVE\n 2\n*WAVE\n 5\n",
        (
            "$LOAD CASE\n*DRILLING MUD\n 1\n*WAVE\n 2\n$LOAD CASE\n*WAVE\n 5\n"
            "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 2\n"
        ),
    ],
    ids=["current in the second", "one load case", "a third one"],
)
def test_load_cases_are_apart(other: str) -> None:
    one = "$LOAD CASE\n*WIND\n 1\n*WAVE\n 2\n$LOAD CASE\n*WAVE\n 5\n"
    assert between(one, one) == []
    assert between(one, other) != []


def test_the_order_of_soil_curves_does_not_count() -> None:
    head, first, second = "*P-Y\n SET=Pipe\n", *SOIL.removeprefix("*P-Y\n SET=Pipe\n").split(" DEPTH=2.0\n")
    assert between(SOIL, f"{head} DEPTH=2.0\n{second}{first}") == []
    found = between(SOIL, SOIL.replace("300.0", "310.0"))
    assert len(found) == 1
    assert found[0][1:] == ([300.0, 0.1], [310.0, 0.1])


@pytest.mark.parametrize("changed", [False, True])
def test_points_of_a_profile_in_a_file(tmp_path: Path, changed: bool) -> None:
    text = ordered_deck() + "*SEABED PROFILE\n TYPE=2D\n FILE=bed.txt\n"
    for name, points in (("a", "0, 0\n10, 1\n"), ("b", "10, 2\n0, 0\n" if changed else "10, 1\n0, 0\n")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "deck.keyxm").write_text(text, encoding="utf-8")
        (tmp_path / name / "bed.txt").write_text(points, encoding="utf-8")
    one, other = (resolve(load_path(tmp_path / name / "deck.keyxm")) for name in "ab")
    expected = [("seabed/points", "2 points", "2 points")] if changed else []
    assert brief(compare(one, other)) == expected


def test_a_joint_that_tapers_the_other_way() -> None:
    mesh = "*NODE\n 1, 0.0, 0.0\n 4, 3.0, 0.0\n GEN=1, 4\n*ELEMENT\n 1, 1, 2\n GEN=1, 3\n"
    joint = "*TAPER\n SET=Foot\n 207.0E9, 79.6E9, 7850.0, 0.2, 0.3, 0.4\n"
    deck = f"$MODEL\n{mesh}*ELEMENT SETS\n SET=Foot\n 1, 2, 3\n{joint}"
    one, other = deck, deck.replace("1, 2, 3\n*TAPER", "3, 2, 1\n*TAPER")
    assert differences(one, one) == []
    changed = [(f"elements {element}/sections/first element", "1", "3") for element in (1, 2, 3)]
    assert sorted(brief(differences(one, other))) == changed


def test_blocks_without_a_model_compare_by_their_lines() -> None:
    text = "*DAMPER\n VESSEL=FPSO\nC a comment\n INITIAL POSITION=0, 0, 0\n"
    assert between(text, text.replace("C a comment\n", "\n").replace(" VESSEL", "  VESSEL")) == []
    assert between(text, text.replace("0, 0, 0", "0, 0, 5")) == [
        ("*DAMPER/lines", "INITIAL POSITION=0, 0, 0", None),
        ("*DAMPER/lines", None, "INITIAL POSITION=0, 0, 5"),
    ]
    assert ("before the first section/lines", "TITLE", None) in brief(
        differences("TITLE\n" + ordered_deck(), ordered_deck())
    )


def test_long_blocks_without_a_model_are_compared_between_their_equal_ends() -> None:
    lines = [f" {number}, {number}\n" for number in range(3000)]
    changed = ["C\n", *lines[:10], " new\n", *reversed(lines[10:2990]), *lines[2990:]]
    found = differences(ordered_deck() + "*DAMPER\n" + "".join(lines), ordered_deck() + "*DAMPER\n" + "".join(changed))
    assert {one.kind for one in found} == {"added", "removed"}
    assert len(found) == 2 * 2980 + 1


def test_units_of_the_decks() -> None:
    (found,) = differences(ordered_deck(), ordered_deck(), name="b.keyxi")
    assert found == Difference("changed", "units", "units", "metric", "imperial")


def test_values_of_equations_behind_the_model_compare() -> None:
    given = "$PREPROCESSOR\n*PARAMETERS\n x, 0.5\n"
    assert between(given + BOUNDARY, given + BOUNDARY.replace("0.5", "=[x]")) == []
    found = between(given + BOUNDARY.replace("0.5", "=[2*x]"), given + BOUNDARY)
    assert [values[1:] for values in found] == [(1.0, 0.5)]


def test_equations_without_a_value_behind_the_model_compare_as_written() -> None:
    one, other = (BOUNDARY.replace("0.5", f"=[strange({number})]") for number in (1, 2))
    assert between(one, one) == []
    assert [values[1:] for values in between(one, other)] == [("=[strange(1)]", "=[strange(2)]")]
