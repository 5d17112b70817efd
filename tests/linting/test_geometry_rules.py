"""Rules over sections and elements: thresholds, and where they are silent."""

from __future__ import annotations

import pytest

from mudline.linting.engine import lint_bytes
from mudline.linting.registry import select
from tests.linting.findings import ON_CLAY, PIPE, PROPERTIES, found, messages


@pytest.mark.parametrize(
    ("di", "fires"), [("0.2499", False), ("0.25", True), ("0.3", True), ("=[0.25]", True), ("x", False)]
)
def test_a_pipe_needs_a_wall(di: str, fires: bool) -> None:
    assert bool(found(PIPE.replace("0.22", di), "GEO001")) is fires


def test_a_number_beside_its_curve() -> None:
    text = "$MODEL\n*GEOMETRIC SETS\n SET=ALL, {}\n {}, 90, 1, 0.2, 0.4, 0.3\n"
    assert found(text.format("EI=x, GJ=y", ", , , 1"), "GEO002") == []
    assert found(text.format("EI=x, GJ=y", ", 2, 3, 1"), "GEO002") == [("GEO002", 4, 4), ("GEO002", 4, 7)]
    assert found(text.format("EA=x", ", , , =[2*3]"), "GEO002") == [("GEO002", 4, 8)]
    mooring = "$MODEL\n*GEOMETRIC SETS\n OPTION=MOORING\n SET=ALL, EA=x\n 1, 90, 0.2\n"
    assert found(mooring, "GEO002") == []


FLEXIBLE = PIPE.replace("RIGID", "FLEXIBLE").replace(
    "207.0E9, 79.6E9, 0.25, 0.22, 7850.0", ", , , , 90, 1, 0.2, 0.4, 0.3"
)


def test_the_drag_diameter_is_told_only_under_a_curve() -> None:
    assert found(FLEXIBLE + ON_CLAY, "GEO003") == [("GEO003", 12, 22)]
    assert found(FLEXIBLE + PROPERTIES + " STIFFNESS=5E4\n", "GEO003") == []
    assert found(FLEXIBLE.replace("0.3\n", "0.3, 0.35\n") + ON_CLAY, "GEO003") == []
    assert found(PIPE + ON_CLAY, "GEO003") == []


def test_elements_without_length() -> None:
    text = "$MODEL\n*NODE\n 1, 1, 0\n 2, 1, 0\n 3, 1, 1E-9\n*ELEMENT\n 1, 1, 2\n 2, 2, 3\n 3, 3, 3\n 4, 3, 9\n"
    assert found(text, "GEO004") == [("GEO004", 7, 2), ("GEO004", 9, 2)]
    assert "both its ends are node 3" in messages(text, "GEO004")[1]
    finding = lint_bytes((text + "*FLEX JOINTS\n x\n").encode(), "deck.keyxm", select(["GEO004"]))[0]
    assert finding.severity == "warning"


def test_a_generator_of_elements_without_length_is_told_once() -> None:
    text = "$MODEL\n*NODE\n 1, 1, 0\n 9, 1, 0\n GEN=1, 9\n*ELEMENT\n 1, 1, 2\n GEN=1, 8\n"
    assert found(text, "GEO004") == [("GEO004", 7, 2), ("GEO004", 8, 2)]
