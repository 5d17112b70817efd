"""Conditions on the values of a deck: what holds, and what is no condition."""

from __future__ import annotations

import pytest

from mudline.editing.assignment.fields import ConditionError, parse_condition
from mudline.editing.assignment.paths import PathError
from mudline.language.deck.loading import load_bytes
from tests.editing.assignment.test_assigning import TWO_SETS
from tests.helpers.builders.decks import CLEAN


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        ("OCEAN.depth > 99", True),
        ("OCEAN.depth < 100", False),
        ("OCEAN.depth <= 100 and OCEAN.gravity > 9", True),
        ("not OCEAN.depth = 100", False),
        ("OCEAN.depth = 1 or SEABED PROPERTIES.stiffness = CLAY", True),
        ("SEABED PROPERTIES.stiffness > 4000", True),
        ("SEABED PROPERTIES[set=Pipe].stiffness > 4000", False),
        ("SEABED PROPERTIES.type != ELASTIC", False),
        ("TIME.step > 0", False),
        ("TIME.step != 0", False),
        ("not TIME.step > 0", True),
        ('SEABED PROPERTIES[set="Rest"].friction.transverse == 0.5', True),
        ("NODE.x > 0.2", True),
        ("NODE[node=1].x > 0.2", False),
        ("OCEAN.depth<1", False),
        ("((OCEAN.depth >= -1.5D2))", True),
        ("OCEAN.depth <> 100", False),
        ("OCEAN.depth <> 10mm", True),
        ('OCEAN.depth == "100"', False),
        ("not OCEAN.depth = 100 and OCEAN.depth = 1 OR (OCEAN.depth = 1 or OCEAN.depth = 100)", True),
        ("not OCEAN.depth = 1 and OCEAN.depth = 1", False),
        ("not (OCEAN.depth = 1 and OCEAN.depth = 1)", True),
        ("OCEAN.depth = 100 or OCEAN.depth = 1 and OCEAN.depth = 1", True),
    ],
)
def test_conditions(condition: str, *, holds: bool) -> None:
    assert parse_condition(condition)(load_bytes(TWO_SETS.encode(), "deck.keyxm")) is holds


def test_equations_are_evaluated_in_conditions() -> None:
    condition = parse_condition("OCEAN.depth == 100")
    head = "$PREPROCESSOR\n*PARAMETERS\n d, 50\n"
    deck = head + CLEAN.replace(" 100.0,", " =[2*d],")
    assert condition(load_bytes(deck.encode(), "deck.keyxm"))
    with pytest.raises(ConditionError, match=r"OCEAN.depth is given by an equation without a value, =\[2\*d\]"):
        condition(load_bytes(deck.removeprefix(head).encode(), "deck.keyxm"))


@pytest.mark.parametrize(
    "text",
    [
        "",
        "OCEAN.depth",
        "OCEAN.depth <",
        "OCEAN.depth < 1 <2",
        "and",
        "(OCEAN.depth<1",
        "OCEAN.depth<1 OCEAN.depth<2",
        "__import__('os')",
        "OCEAN.depth == f(1)",
        "1 < OCEAN.depth",
        "not " * 480 + "OCEAN.depth<1",
    ],
)
def test_what_is_no_condition(text: str) -> None:
    with pytest.raises(PathError, match="expected"):
        parse_condition(text)


def test_texts_have_no_order() -> None:
    with pytest.raises(PathError, match="an order needs a number"):
        parse_condition("UNITS.units > METRIC")
