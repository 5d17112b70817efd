"""What is a difference, and how it is told."""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.editing.comparison.comparing import compare
from mudline.language.deck.loading import dump
from mudline.language.diagnostics import DeckError
from tests.helpers.builders.decks import ordered_deck
from tests.helpers.builders.scenes import brief, deck_of, differences, scene_of

CHANGES = [
    ("od, 0.5", "od, 0.6", "parameters/od"),
    (" 3, 0.3", " 3, 0.4", "nodes/3"),
    (" 4, 0.5, 30.0\n", " 4, 0.5, 30.0\n 5, 0, 0\n", "nodes/5"),
    (" 3, 3, 4\n", " 3, 2, 4\n", "elements/3"),
    ("SET=Pipe\n 1, 2", "SET=Pipe\n 1, 3", "element sets/Pipe"),
    (" 0.1, 1000.0", " 0.1, 1001.0", "curves/Clay/0.1"),
    (" 0.5, 3000.0", " 0.6, 3000.0", "curves/Clay/0.6"),
    ("STIFFNESS=50000.0", "STIFFNESS=60000.0", "*SEABED PROPERTIES/Rest/stiffness"),
    ("STIFFNESS=50000.0", "STIFFNESS=Clay", "*SEABED PROPERTIES/Rest/stiffness"),
    ("0.46, 7850.0", "0.46, 7851.0", "*GEOMETRIC SETS/ALL/rigid/density"),
    ("FRICTION=0.3", "FRICTION=0.4", "*SEABED PROPERTIES/Pipe/friction/longitudinal"),
    ("1025.0", "1026.0", "*OCEAN/density"),
    ("1.2, 0.05", "1.3, 0.05", "*HYDRODYNAMIC SETS/ALL/constant/normal_drag"),
]


@pytest.mark.parametrize(("written", "other", "where"), CHANGES)
def test_a_change_is_told_where_it_is(written: str, other: str, where: str) -> None:
    assert written in ordered_deck()
    assert where in [one.where for one in differences(ordered_deck(), ordered_deck().replace(written, other))]


@pytest.mark.parametrize("form", ["json", "yaml"])
@pytest.mark.parametrize(("written", "other", "where"), CHANGES)
def test_a_change_in_a_document_has_its_lines(written: str, other: str, where: str, form: str) -> None:
    texts = ordered_deck(), ordered_deck().replace(written, other)
    documents = [dump(deck_of(text), form) for text in texts]
    found = compare(scene_of(documents[0], f"deck.{form}"), scene_of(documents[1], f"deck.{form}"))
    assert [brief([one]) for one in found] == [brief([one]) for one in differences(*texts)], where
    for one, same in zip(found, differences(*texts), strict=True):
        assert (one.before_line is None, one.after_line is None) == (same.before_line is None, same.after_line is None)
        if one.where == where and one.after_line is not None and isinstance(one.after, float):
            assert str(one.after) in documents[1].splitlines()[one.after_line - 1]


def test_which_of_two_overlapping_laws_comes_later_counts() -> None:
    text = ordered_deck().replace(" SET=Rest\n 3", " SET=Rest\n 2, 3")
    laws = " SET=Pipe\n STIFFNESS=Clay\n FRICTION=0.3, 0.5\n"
    later = text.replace(laws, "").replace("STIFFNESS=50000.0\n", f"STIFFNESS=50000.0\n{laws}")
    assert ("elements 2/laws", "linear", "curve:Clay") in brief(differences(text, later))
    assert {one.group for one in differences(text, later)} == {"laws of elements", "bed of elements"}


def test_what_elements_follow_is_said_where_no_record_says_it() -> None:
    moved = ordered_deck().replace(" SET=Pipe\n 1, 2\n SET=Rest\n 3", " SET=Pipe\n 1\n SET=Rest\n 2, 3")
    assert moved != ordered_deck()
    moved = moved.replace("STIFFNESS=50000.0", "STIFFNESS=60000.0")
    found = brief(differences(ordered_deck(), moved))
    assert ("elements 2/laws", "curve:Clay", "linear") in found
    assert [one for one in found if "60000" in str(one)] == [
        ("elements 2/laws/stiffness", None, 60000.0),
        ("*SEABED PROPERTIES/Rest/stiffness", 50000.0, 60000.0),
    ]


def test_an_option_that_an_earlier_set_gave() -> None:
    text = ordered_deck().replace("7850.0\n", "7850.0\n SET=Pipe\n 207.0E9, 79.6E9, 0.4, 0.3, 7850.0\n")
    assert differences(text, text.replace(" SET=Pipe\n 207", " OPTION=RIGID\n SET=Pipe\n 207")) == []


def test_a_keyword_in_one_deck_only() -> None:
    more = ordered_deck() + "*POINT MASS\n 1, 2\n"
    found = differences(ordered_deck(), more)
    assert ("*POINT MASS/lines", None, "1, 2") in brief(found)
    assert {one.kind for one in found} == {"added"}
    assert {one.kind for one in differences(more, ordered_deck())} == {"removed"}


def test_sets_of_elements_that_the_deck_does_not_show() -> None:
    text = "$MODEL\n*ELEMENT SETS\n SET=A\n 1, 2, {x}\n SET=B\n GEN=5, 9\n SUBSET=A\n"
    assert differences(text, text.replace("1, 2, {x}", "{X}, 2, 1")) == []
    found = brief(differences(text, text.replace("GEN=5, 9", "GEN=5, 9, 2")))
    assert found == [("element sets/B", "5-9, SUBSET=a", "5, 7, 9, SUBSET=a")]
    quoted = text.replace("SET=B", 'SET="B"').replace("SUBSET=A", 'SUBSET="A"')
    assert not differences(text, quoted)
    assert brief(differences(text, quoted.replace("GEN=5, 9", "GEN=5, 9, 2"))) == found


@pytest.mark.parametrize("text", ["$MODEL\n*NODE\n 1, x, 0\n", "$MODEL\n*OCEAN\n =[depth], 1025, 9.81\n"])
def test_a_deck_with_an_unknown_value_is_refused(text: str) -> None:
    with pytest.raises(DeckError):
        differences(ordered_deck(), text)


@given(st.randoms(use_true_random=False))
def test_a_shuffled_deck_means_the_same(chance: random.Random) -> None:
    def shuffled(items: list[str]) -> list[str]:
        return chance.sample(items, len(items))

    assert differences(ordered_deck(), ordered_deck(shuffled)) == []


@given(st.sets(st.integers(0, 35)))
def test_comments_and_blank_lines_are_no_difference(places: set[int]) -> None:
    lines = ordered_deck().splitlines()
    for place in sorted(places, reverse=True):
        lines[place + 4 : place + 4] = ["C a note"] if place % 2 else [""]
    assert differences(ordered_deck(), "\n".join(lines) + "\n") == []


@pytest.mark.parametrize(
    ("written", "other"),
    [
        (" 3, 0.3, 20.0", " 3, 3e-1, 2.0E1"),
        ("SET=Pipe\n STIFFNESS", "SET=PIPE\n STIFFNESS"),
        ("STIFFNESS=Clay", "stiffness=CLAY"),
        ("=[od]", "0.5"),
        (" SET=Pipe\n 1, 2", " SET=Pipe\n GEN=1, 2"),
        ("*NODE\n 1, -0.1, 0.0\n", "*NODE\n 1, -0.1, 0.0\n*NODE\n"),
    ],
)
def test_another_way_to_write_it(written: str, other: str) -> None:
    text = ordered_deck()
    assert written in text
    assert differences(text, text.replace(written, other)) == []


def test_records_in_another_block_mean_the_same() -> None:
    apart = ordered_deck().replace(" SET=Rest\n STIFF", "*SEABED PROPERTIES\n SET=Rest\n STIFF")
    assert differences(ordered_deck(), apart) == []


def test_a_tolerance() -> None:
    near = (
        ordered_deck()
        .replace("0.3, 20.0", "0.3000001, 20.0")
        .replace("3000.0", "3000.0001")
        .replace("50000.0", "50000.01")
    )
    assert differences(ordered_deck(), near, 1e-6) == []
    assert len(differences(ordered_deck(), near)) > 2
