"""Curves of every kind, and nodes and elements that any keyword names."""

from __future__ import annotations

from pathlib import Path

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from tests.helpers.builders.decks import CLEAN

VESSEL = "*VESSEL,INTEGRATED\n VESSEL=FPSO\n INITIAL POSITION=1005.0, 0.0, 0.0\n"
OFFSET = "$LOAD CASE\n*OFFSET\n VESSEL={}\n OFFSET=1.0\n"
BEND = "*MOMENT-CURVATURE\n CURVE={}\n 0.0, 0.0\n 1.0, 2.0\n"
SECTION = "*GEOMETRIC SETS\n OPTION=FLEXIBLE\n SET=ALL, EI=Bend\n , , 1.0, 1.0, 92.0, 0.9, 0.2, 0.3, 0.3\n"


def found(text: str, name: str = "deck.keyxm", folder: Path | None = None) -> list[tuple[str, str, int]]:
    """Code, severity and line of what is found about names."""
    told = lint_bytes(text.encode(), name, rules(), folder=folder)
    return [(one.code, one.severity.value, one.line) for one in told if one.code.startswith(("REF", "SYN017"))]


def test_curves_of_other_kinds() -> None:
    deck = CLEAN + SECTION + BEND.format("bend")
    lines = CLEAN.count("\n")
    assert found(deck) == []
    assert found(CLEAN + SECTION + BEND.format("Bent")) == [("REF002", "error", lines + 3)]  # read as the one near it
    assert found(CLEAN + SECTION + BEND.format("Riser")) == [
        ("REF002", "error", lines + 3),
        ("REF003", "warning", lines + 6),
    ]
    assert found(deck + BEND.format("BEND")) == [("REF004", "warning", lines + 10)]
    assert found(CLEAN + "*DAMPER DATA\n NAME=a\n 0.0, 0.0\n 1.0, 1.0\n") == [("REF003", "info", lines + 2)]


def test_a_curve_that_a_line_which_is_not_read_names_is_used() -> None:
    assert found(CLEAN + BEND.format("Bend") + "*COATINGS\n CURVE=Bend\n") == []


def test_nodes_and_elements_that_any_keyword_names() -> None:
    lines = CLEAN.count("\n")
    springs = "*MASS\n 77, 12.0\n*SPRING ELEMENT\n ELEMENT=1, 55\n TYPE=LINEAR\n 3.0\n"
    assert found(CLEAN + springs) == [("REF006", "error", lines + 2), ("REF005", "error", lines + 4)]
