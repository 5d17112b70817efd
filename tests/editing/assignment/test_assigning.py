"""One value of a deck set: the edits, the layout that stays, and what is refused."""

from __future__ import annotations

import pytest

from mudline.editing.assignment.assigning import AssignmentError, assigned
from mudline.editing.assignment.fields import target_of
from mudline.editing.assignment.paths import WrittenOperand, parse_assignment
from mudline.language.deck.loading import load_bytes
from mudline.language.syntax.edits import edited_bytes
from mudline.language.syntax.source import Source
from tests.helpers.builders.decks import CLEAN

TIMES = CLEAN + "$LOAD CASE\n*TIME\n STEP=FIXED\n 0.0, 10.0,  0.05, 2.0\nC the end\n"
TWO_SETS = CLEAN.replace("*SEABED STIFFNESS", " SET=Rest\n STIFFNESS=5000\n FRICTION=0.3, 0.5\n*SEABED STIFFNESS")
BOUNDARY = CLEAN + "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n GEN=1, 3, 2\n"
COLUMNS = CLEAN.replace(" 0.1, 1000.0\n 0.5, 3000.0\n", " 0.1 ,  1000.0\n 0.25,  3000.0\nC a comment\n 0.50, 12000.0\n")


def changed(deck: str, text: str, name: str = "deck.keyxm") -> str | None:
    """The deck with a value set; None where it has none."""
    data = deck.encode()
    assignment = parse_assignment(text)
    target = target_of(assignment.path, WrittenOperand.of(assignment.value))
    found = assigned(load_bytes(data, name), assignment, target)
    return None if found is None else edited_bytes(Source.from_bytes(data, name), found.edits).decode()


@pytest.mark.parametrize(
    ("deck", "text", "old", "new"),
    [
        (TIMES, "TIME.step=0.1", "10.0,  0.05, 2.0", "10.0,  0.1, 2.0"),
        (TIMES.replace("\n", "\r\n"), "TIME.step=1D-1", "0.05", "1D-1"),
        (CLEAN, "OCEAN.depth==[50*2]", " 100.0", " =[50*2]"),
        (CLEAN, "SEABED PROPERTIES.type=RIGID", "", ""),
        (CLEAN, "SEABED PROPERTIES.stiffness=2.5E4", "STIFFNESS=Clay", "STIFFNESS=2.5E4"),
        (TWO_SETS, "SEABED PROPERTIES[set=rest].stiffness=6000", "STIFFNESS=5000", "STIFFNESS=6000"),
        (TWO_SETS, "SEABED PROPERTIES[2].stiffness=6000", "STIFFNESS=5000", "STIFFNESS=6000"),
        (TWO_SETS, "SEABED PROPERTIES.transverse=0.6", "0.3, 0.5", "0.3, 0.6"),
        (CLEAN, "NODE[node=2].y=12.5", "2, -0.1, 10.0", "2, -0.1, 12.5"),
        (CLEAN, "GEOMETRIC SETS[set=PIPE].Do=0.51", "0.5, 0.46", "0.51, 0.46"),
        (CLEAN, "SEABED STIFFNESS[name=clay][ratio=1e-1].force=999", "0.1, 1000.0", "0.1, 999"),
        (COLUMNS, "SEABED STIFFNESS[ratio=0.1].force=990.25", "0.1 ,  1000.0", "0.1 ,  990.25"),
        (COLUMNS, "SEABED STIFFNESS[ratio=0.1].force=990", "0.1 ,  1000.0", "0.1 ,     990"),
        (COLUMNS, "SEABED STIFFNESS[ratio=0.1].force=10000.0", "0.1 ,  1000.0", "0.1 , 10000.0"),
        (COLUMNS, "SEABED STIFFNESS[ratio=0.1].force=1000000.0", "0.1 ,  1000.0", "0.1 , 1000000.0"),
        (COLUMNS, "SEABED STIFFNESS[ratio=0.25].ratio=0.2", "0.25,  3000.0", "0.2,   3000.0"),
    ],
)
def test_only_the_value_changes(deck: str, text: str, old: str, new: str) -> None:
    if not old:
        with pytest.raises(AssignmentError, match="new error"):
            changed(deck, text)
        return
    assert deck.count(old) == 1
    assert changed(deck, text) == deck.replace(old, new)


@pytest.mark.parametrize("text", ["TIME.step=1", "SEABED PROPERTIES[set=Pip].stiffness=1", "NODE[node=9].x=1"])
def test_a_deck_may_have_no_such_value(text: str) -> None:
    assert changed(CLEAN, text) is None


@pytest.mark.parametrize(
    ("deck", "text", "message"),
    [
        (CLEAN.replace("100.0, 1025", "=[99+1], 1025"), "OCEAN.depth=5", r"is given by an equation, =\[99\+1\]"),
        (TWO_SETS, "SEABED PROPERTIES.stiffness=1", r"is ambiguous: .* in lines 21, 23; choose one"),
        (TIMES + "*TIME\n STEP=FIXED\n 0, 1, 1\n", "TIME.step=1", "is ambiguous"),
        (CLEAN, "OCEAN.viscosity=1", "is left out here"),
        (CLEAN, "OCEAN.depth=abc", "cannot be 'abc': expected a number or an equation"),
        (CLEAN, "OCEAN.depth=1e999", "cannot be '1e999'"),
        (CLEAN, "SEABED PROPERTIES.type=SOFT", "cannot be 'SOFT': expected one of RIGID, ELASTIC"),
        (
            f"{CLEAN}$LOAD CASE\n*ANALYSIS TYPE\n TYPE=STATIC\n",
            "ANALYSIS TYPE.type=DYNAMC",
            r"DYNAMIC, TIME DOMAIN, FREQUENCY DOMAIN \(did you mean DYNAMIC\?\)",
        ),
        (CLEAN, "NODE[node=2].node=2.5", "expected a whole number"),
        (BOUNDARY, "BOUNDARY.generate.start=1.5", "expected a whole number"),
        (CLEAN, "OCEAN.depth=-1", "must be greater than 0"),
        (TIMES, "TIME.step=0", "must be greater than 0"),
        (CLEAN, "GEOMETRIC SETS.Do=0.4", "would have a new error"),
        (CLEAN, "SEABED PROPERTIES.set=Nowhere", "would have a new error"),
        (CLEAN, "OCEAN.depth==[nothing]", "would have a new error"),
        (CLEAN, "SEABED PROPERTIES.stiffness=Clay, SUCTION=1", "would"),
        (CLEAN, "ELEMENT SETS.set=a, SET=b", "would"),
    ],
)
def test_what_is_refused(deck: str, text: str, message: str) -> None:
    with pytest.raises(AssignmentError, match=message):
        changed(deck, text)


def test_a_value_that_changes_the_units_is_refused() -> None:
    with pytest.raises(AssignmentError, match=r"units of the deck, metric, would be taken for user"):
        changed(CLEAN, "OCEAN.gravity=8", "deck.keyx")


def test_a_character_that_the_encoding_lacks_is_refused() -> None:
    data = CLEAN.replace("SET=Pipe", "SET=Pïpe").encode("cp1252")
    assignment = parse_assignment("SEABED PROPERTIES.stiffness=łay")
    target = target_of(assignment.path, WrittenOperand.of(assignment.value))
    with pytest.raises(AssignmentError, match="encoding, cp1252, lacks"):
        assigned(load_bytes(data, "deck.keyxm"), assignment, target)
