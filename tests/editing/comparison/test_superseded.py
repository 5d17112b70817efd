"""Decks of the two families of seabed keywords: what is spelling, and what differs beside it."""

from __future__ import annotations

import re

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from mudline.editing.comparison.comparing import compare
from mudline.editing.comparison.decks import Comparison, without_spelling
from mudline.editing.migration.migrating import migrate
from mudline.model.scene.model import resolve
from tests.editing.migration.test_migrating import legacy_decks
from tests.helpers.builders.decks import PIPE_WITH_SETS
from tests.helpers.builders.scenes import deck_of, scene_of

BED = """\
*ELASTIC SURFACE
 5.0D4, 0.3, 0.4, 200.0, 100.0, 0.25, 3.048, , 12, , 0.05
 2.5
*EMBEDMENT
 SET=East Bank
 0.0, 0.0
 0.5, 4000.0
 SET=7
 0.0, 0.0
 1.0, 100.0
"""
OLD = PIPE_WITH_SETS + BED
NEW = migrate(deck_of(OLD)).content.decode()
LINES = "$MODEL\n*LINES\n LINE=Riser\n SECTION=A, 10\n SECTION=B, 10\n"
OLD_LINES = LINES + "*ELASTIC SURFACE\n 1e4, 0.3\n*EMBEDMENT\n SET=A\n 0, 0\n 1, 5\n SET=B\n 0, 0\n 1, 7\n"
NEW_LINES = migrate(deck_of(OLD_LINES)).content.decode()


def compared(old: str, new: str, tolerance: float = 0.0) -> Comparison:
    before, after = scene_of(old), scene_of(new)
    return without_spelling(before, after, compare(before, after, tolerance), tolerance)


def shown(found: Comparison) -> list[str]:
    return [f"{one.where}: {one.before} -> {one.after}" for one in found.differences]


@pytest.mark.parametrize(("old", "new"), [(OLD, NEW), (OLD_LINES, NEW_LINES)], ids=["elements", "lines"])
def test_a_migrated_pair_differs_in_spelling_only(old: str, new: str) -> None:
    for one, other in ((old, new), (new, old)):
        found = compared(one, other)
        assert found.differences == []
        assert len(found.spelling) == len(compare(scene_of(one), scene_of(other))) > 10


CHANGES = [
    (" STIFFNESS=5.0D4", " STIFFNESS=5.1E4", ["elements 1-2, 4, 11-12/laws/stiffness: 50000.0 -> 51000.0"]),
    (
        " 0.5, 4000.0",
        " 0.5, 4000.5",
        ["elements 5-8, 10/laws/points: [[0.0, 0.0], [0.5, 4000.0]] -> [[0.0, 0.0], [0.5, 4000.5]]"],
    ),
    (
        "STIFFNESS=7 curve",
        "STIFFNESS=100.0",
        [
            "elements 3, 9/laws: curve -> linear",
            "elements 3, 9/laws/points: [[0.0, 0.0], [1.0, 100.0]] -> None",
            "elements 3, 9/laws/stiffness: None -> 100.0",
        ],
    ),
    ("STIFFNESS=5.0D4\n FRICTION=0.3,", "STIFFNESS=5.0D4\n FRICTION=0.4,", ["longitudinal friction: 0.3 -> 0.4"]),
    ("5.0D4\n FRICTION=0.3, 0.4, , 0.05", "5.0D4\n FRICTION=0.3, 0.4, , 0.06", ["mobilisation: 0.05 -> 0.06"]),
    ("SET=7\n STIFFNESS=7 curve\n FRICTION=0.3, 0.4, , 0.05, 12\n LATERAL=200.0", "", ["3, 9/bed/lateral: 200.0"]),
    ("SLOPE=2.5", "SLOPE=2.6", ["seabed/slope: 2.5 -> 2.6"]),
    ("TYPE=SLOPING\n SLOPE=2.5", "TYPE=SLOPING\n SLOPE=2.5\n DIRECTION=9", ["seabed/direction: 0.0 -> 9.0"]),
    ("SET=West\n GEN=1, 6", "SET=West\n GEN=1, 5", ["element sets/West: 1-6 -> 1-5"]),
    ("*SEABED STIFFNESS\n", "*SEABED STIFFNESS\n CURVE=idle\n 0, 0\n 1, 1\n", ["curves/idle: None ->"]),
    (" 13, -0.05, 120.0", " 13, -0.05, 121.0", ["nodes/13: [-0.05, 120.0, 0.0] -> [-0.05, 121.0, 0.0]"]),
]


@pytest.mark.parametrize(("old", "new", "expected"), CHANGES, ids=[change[1].strip()[:24] for change in CHANGES])
def test_a_difference_of_meaning_is_reported_beside_the_spelling(old: str, new: str, expected: list[str]) -> None:
    assert old in NEW
    if not new:  # the last of the blocks without its lateral resistance
        new = old.replace("\n LATERAL=200.0", "")
    found = compared(OLD, NEW.replace(old, new))
    texts = shown(found)
    assert all(any(one in text for text in texts) for one in expected), texts
    assert found.spelling
    both = compared(NEW.replace(old, new), OLD)
    assert len(both.differences) == len(found.differences)


def test_which_block_wins_counts_for_elements_that_the_deck_does_not_show() -> None:
    blocks = [f" SET={name}\n STIFFNESS={name}\n FRICTION=0.3, 0\n" for name in "AB"]
    found = compared(OLD_LINES, NEW_LINES.replace("".join(blocks), "".join(reversed(blocks))))
    assert shown(found) == ["an element of B and A/laws/points: [[0.0, 0.0], [1.0, 7.0]] -> [[0.0, 0.0], [1.0, 5.0]]"]
    lost = NEW_LINES.replace(" SET=ALL\n STIFFNESS=1e4\n FRICTION=0.3, 0\n", "")
    assert shown(compared(OLD_LINES, lost)) == [
        "an element of no set but ALL/laws: linear -> None",
        "an element of no set but ALL/laws/stiffness: 10000.0 -> None",
        "an element of no set but ALL/bed/longitudinal friction: 0.3 -> None",
    ]


def test_a_deck_rewritten_by_hand() -> None:
    """Other names, other orders, and a set of all elements in the place of ALL."""
    old = PIPE_WITH_SETS + "*ELASTIC SURFACE\n 5e4, 0.3, 0.4\n*EMBEDMENT\n SET=West\n 0, 0\n 0.5, 4000\n"
    new = (
        PIPE_WITH_SETS + "*SEABED STIFFNESS\n CURVE=Soft Clay\n 0.5, 4E3\n 0, 0\n"
        "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=50000\n FRICTION=0.3, 0.4\n"
        " SET=west\n STIFFNESS=soft clay\n FRICTION=0.3, 0.4\n"
    )
    assert compared(old, new).differences == []
    assert shown(compared(old, new.replace("4E3", "4001"), 1e-3)) == []
    assert len(shown(compared(old, new.replace("4E3", "4001"), 1e-5))) == 1


@pytest.mark.parametrize(
    ("units", "length", "same"), [("metric", "3.048", True), ("metric", "10", False), ("imperial", "10", True)]
)
def test_a_largest_characteristic_length_is_the_default_or_counts(units: str, length: str, same: bool) -> None:
    old = PIPE_WITH_SETS + f"*ELASTIC SURFACE\n 5e4, 0.3, 0.4, , , , {length}\n"
    new = PIPE_WITH_SETS + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=5e4\n FRICTION=0.3, 0.4\n"
    before, after = (resolve(deck_of(text, units=units)) for text in (old, new))
    found = without_spelling(before, after, compare(before, after))
    assert (found.differences == []) is same


def test_a_profile_that_both_decks_give_by_its_keyword_is_compared_as_ever() -> None:
    profile = "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE={}\n"
    old = PIPE_WITH_SETS + "*ELASTIC SURFACE\n 5e4\n" + profile.format("1.0")
    new = PIPE_WITH_SETS + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=5e4\n" + profile.format("1.5")
    assert shown(compared(old, new)) == ["*SEABED PROFILE/slope: 1.0 -> 1.5"]
    assert shown(compared(old, new.replace("1.5", "1"))) == []


def test_a_lost_law_is_no_spelling() -> None:
    """Both families in one deck: the curve of the legacy keyword held before the number."""
    new = PIPE_WITH_SETS + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=5e4\n"
    old = new + "*EMBEDMENT\n SET=West\n 0, 0\n 0.5, 4000\n"
    assert shown(compared(old, new))[0] == "elements 1-6/laws: curve -> linear"
    assert shown(compared(old.replace("SET=West\n 0", "SET=ALL\n 0"), new))[0] == "elements 1-12/laws: curve -> linear"


NUMBER = re.compile(r"(?<![\w.+-])\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.])")


@given(legacy_decks(), st.data())
def test_any_other_number_in_a_migrated_deck_is_reported(text: str, data: st.DataObject) -> None:
    found = migrate(deck_of(text))
    lines = found.content.decode().splitlines()
    values = [
        (index, number)
        for index, line in enumerate(lines[PIPE_WITH_SETS.count("\n") :], PIPE_WITH_SETS.count("\n"))
        if not line.startswith(("C", "$")) and not re.search("(SET|CURVE|SECTION|FILE)=", line)
        for number in NUMBER.finditer(line)
    ]
    assume(values and not found.files)
    index, number = data.draw(st.sampled_from(values))
    line = lines[index]
    lines[index] = line[: number.start()] + repr(float(number[0]) * 1.5 + 1.25) + line[number.end() :]
    before, after = resolve(deck_of(text)), scene_of("\n".join(lines) + "\n")
    assume(not after.errors())
    assert without_spelling(before, after, compare(before, after)).differences
