"""The classes of keywords as type checkers see them: mypy reads this file too, and no ignore may be idle."""

from __future__ import annotations

from typing import assert_type

import numpy as np
import pytest

import mudline
from mudline import keywords
from mudline.language.keywords.library.ocean import Ocean
from mudline.language.keywords.library.seabed_curves import SeabedStiffness, StiffnessCurve
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import Equation

DECK = mudline.from_keyword("$MODEL\n*OCEAN\n 5\n*SEABED STIFFNESS\n CURVE=clay\n 0, 0\n 1, 1\n")


def test_names_and_classes_give_blocks_of_their_type() -> None:
    assert_type(DECK.block("OCEAN"), Ocean)
    assert_type(DECK.block("OCEAN").depth, float | Equation)
    assert_type(DECK.block(keywords.SeabedStiffness), SeabedStiffness)
    for _, block in DECK.blocks("SEABED STIFFNESS"):
        assert_type(block.curves[0], StiffnessCurve)
        assert block.curves[0].name == "clay"
    for _, other in DECK.blocks(keywords.Ocean):
        assert_type(other, Ocean)
        assert other.depth == 5.0


def test_a_field_that_is_none_is_an_error_of_the_checker() -> None:
    with pytest.raises(AttributeError):
        DECK.block("OCEAN").dept  # type: ignore[attr-defined]  # noqa: B018 - it is what is tested


def test_every_class_says_what_its_fields_are() -> None:
    for name in dir(keywords):
        assert getattr(keywords, name).__doc__.startswith("*"), name
    assert "depth: water depth; [length]; > 0; mandatory" in str(keywords.Ocean.__doc__)
    with pytest.raises(AttributeError, match="has no attribute 'Nonsense'"):
        keywords.Nonsense  # type: ignore[attr-defined]  # noqa: B018 - it is what is tested


def test_a_table_is_assigned_from_rows_of_any_kind_and_read_as_a_table() -> None:
    curve = DECK.copy().block("SEABED STIFFNESS").curves["clay"]
    curve.points = [(0, 0.0), (0.5, "=[k]")]
    assert_type(curve.points, Table)
    assert curve.points[1] == (0.5, "=[k]")
    curve.points = "0, 0\n0.1, 5"
    assert curve.points[1] == (0.1, 5.0)
    curve.points = np.ones((3, 2))
    assert curve.points[2] == (1.0, 1.0)
    with pytest.raises(ValueError, match=r"points: expected rows"):
        curve.points = 5  # type: ignore[assignment]
