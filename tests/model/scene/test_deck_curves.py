"""Curves of other kinds than those of a seabed: the checks that hold for any curve."""

from __future__ import annotations

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from mudline.language.keywords import catalogue
from mudline.language.keywords.model import Block, Part, Rows, record_schema
from mudline.model.scene.model import resolve
from tests.helpers.builders.decks import CLEAN
from tests.helpers.builders.scenes import deck_of

HEAD = CLEAN + "*MOMENT-CURVATURE\n CURVE=Bend\n"
FIRST = HEAD.count("\n") + 1
CASES = {
    " 0.0, 0.0\n 4.0, 1.0\n 5.0, 2.0\n": [],
    " 5.0, 2.0\n 4.0, 1.0\n 0.0, 0.0\n": [],
    " 0.0, 0.0\n 5.0, 2.0\n 4.0, 1.0\n": [("CRV002", 2)],
    " 4.0, 1.0\n": [("CRV001", -1)],
    " 0.0, 0.0\n 4.0, 1.0\n 5.0, 1.0\n": [("CRV003", 2)],
    " 0.0, 0.0\n 4.0, 1.0\n 4.0, 1.0\n": [("CRV004", 2)],
    " 0.0, 0.0\n 1.0E308, 1.0\n -1.0E308, 1.1\n": [("CRV011", 2)],
    " 0.0, 0.0\n 5.0, 1.0\n 4.0, 2.0\n -9.0, 3.0\n": [],
}


@pytest.mark.parametrize(("points", "expected"), CASES.items(), ids=str)
def test_checks_that_hold_for_any_curve(points: str, expected: list[tuple[str, int]]) -> None:
    told = lint_bytes((HEAD + points).encode(), "deck.keyxm", rules())
    assert [(one.code, one.line - FIRST) for one in told if one.code.startswith("CRV")] == expected


def test_a_curve_that_is_none_of_a_seabed_keeps_nothing_from_being_evaluated() -> None:
    assert resolve(deck_of(HEAD + " 4.0, 1.0\n")).blocking() == []


@pytest.mark.parametrize("block", catalogue.block_classes())
def test_declared_curves_have_their_abscissa_and_another_column(block: type[Block]) -> None:
    for about in _curves(block):
        columns = [column.json for column in record_schema(about.row).columns] if about.row else []
        assert about.abscissa in columns
        assert len(columns) > 1
        assert about.unordered


def _curves(part: type[Part]) -> list[Rows]:
    slots = record_schema(part).slots
    own = [slot.about for slot in slots if isinstance(slot.about, Rows) and slot.about.curve]
    return [*own, *(about for slot in slots for record in slot.record.values() for about in _curves(record))]
