"""Rules over points, columns and ends of curves: thresholds, and where they are silent."""

from __future__ import annotations

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from tests.checks.findings import (
    CURVES,
    ON_CLAY,
    PIPE,
    PROPERTIES,
    RESTART,
    curve,
    found,
    messages,
    points,
)


def test_only_the_first_point_out_of_order_is_told() -> None:
    text = CURVES + curve("a", (0, 0), (0.3, 3), (0.2, 2), (0.5, 5), (0.1, 1)) + curve("b", (1, 1), (0, 0))
    assert found(text, "CRV002") == [("CRV002", 6, 2), ("CRV002", 11, 2)]


def test_points_given_twice_are_told_at_the_later_ones() -> None:
    text = CURVES + curve("a", (0, 0), (0.3, 3), (0, 0), (0.3, 4), (0.3, 4), (0.3, 3))
    assert found(text, "CRV003", "CRV004") == [
        ("CRV004", 6, 2),
        ("CRV003", 7, 2),
        ("CRV003", 8, 2),
        ("CRV004", 9, 2),
    ]


def test_a_force_that_falls_needs_a_structure_that_holds_against_it() -> None:
    """From 3000 at 0.1 to 2400 at 0.2 the slope is -6000; over a diameter of 0.25 that is 24000 per unit length."""
    points = ((0.0, 0.0), (0.1, 3000.0), (0.2, 2400.0), (0.5, 5000.0))
    text = PIPE + "*SEABED STIFFNESS\n" + curve("Crust", *points) + PROPERTIES + " STIFFNESS=Crust\n"
    assert found(text) == [("CRV005", 17, 2)]
    (message,) = messages(text, "CRV005")
    assert "slope -6000" in message
    assert "|slope| / D = 24000 (D = 0.25)" in message


def test_the_smallest_diameter_needs_most() -> None:
    sections = "*ELEMENT SETS\n SET=thin\n 1, 2\n*GEOMETRIC SETS\n OPTION=MOORING\n SET=thin\n 1E9, 100, 0.1\n"
    text = PIPE + sections + "*SEABED STIFFNESS\n" + curve("a", (0, 0), (0.5, 9), (1, 8)) + PROPERTIES
    assert "|slope| / D = 20 (the smallest D = 0.1)" in messages(text + " STIFFNESS=a\n", "CRV005")[0]


def test_each_falling_segment_is_told_in_the_order_of_the_ratios() -> None:
    text = CURVES + curve("a", (0.4, 1), (0.3, 3), (0, 0), (0.2, 2), (0.1, 4))
    assert found(text, "CRV005") == [("CRV005", 4, 2), ("CRV005", 7, 2)]


@pytest.mark.parametrize(
    "points",
    [
        ((0, 0), (0.1, 5), (0.2, 5)),
        ((-0.5, 5), (0, 0), (0.5, 9)),
        ((0, 5), (0.5, 9), (0.5, 3), (1, 10)),
        ((0, 1.7e308), (1e-300, -1.7e308)),
    ],
)
def test_forces_that_do_not_fall_below_the_mudline(points: tuple[tuple[float, float], ...]) -> None:
    assert found(CURVES + curve("a", *points), "CRV005") == []


def test_points_above_the_mudline_are_told_each() -> None:
    text = CURVES + curve("a", (-0.5, 0), (-0.25, 10), (0, 20), (-0.0, 20), (1, 30))
    assert found(text, "CRV006") == [("CRV006", 4, 2), ("CRV006", 5, 2)]
    assert ["invert" in message for message in messages(text, "CRV006")] == [True, False]


@pytest.mark.parametrize(("first", "expected"), [((-1.0, 0.0), 0), ((-1.0, 5.0), 1), ((-1.0, -0.5), 1)])
def test_no_force_up_to_ratio_0_loses_nothing(first: tuple[float, float], expected: int) -> None:
    assert len(found(CURVES + curve("a", first, (0.0, 0.0), (0.5, 9.0)), "CRV006")) == expected
    assert len(found(CURVES + curve("a", first, (0.5, 9.0)), "CRV006")) == 1


def test_a_table_of_faults_is_told_up_to_a_limit() -> None:
    rows = "".join(f" -{row}.5, 1\n 0.5, 1\n 0.5, 1\n" for row in range(2000))
    text = CURVES + " CURVE=a\n 0, 0\n" + rows
    codes = [code for code, _, _ in found(text, "CRV004", "CRV006")]
    assert codes.count("CRV004") == codes.count("CRV006") == 1000


@pytest.mark.parametrize(
    ("given", "place"),
    [
        (((0, 10), (1, 1000)), []),
        (((0, 10.1), (1, 1000)), [(4, 2)]),
        (((-1, -1000), (1, 1000)), []),
        (((-1, 0), (1, 1000)), [(3, 2)]),
        (((0.1, 100), (1, 1000)), []),
        (((0.1, 100), (0.1, 200), (1, 1000)), []),
        (((0, 0), (1, 0)), []),
    ],
)
def test_the_force_at_zero(given: tuple[tuple[float, float], ...], place: list[tuple[int, int]]) -> None:
    assert [(line, column) for _, line, column in found(points(*given), "CRV007")] == place


def test_a_force_at_zero_that_overflows_is_not_told() -> None:
    assert found(points((1, -1e308), (2, 1e308)), "CRV007") == []


def test_curves_that_pull() -> None:
    assert found(points((0, 0), (1, -1), (2, -3), (3, 9)), "CRV012") == [("CRV012", 5, 2)]
    assert "1 more" in messages(points((0, 0), (1, -1), (2, -3), (3, 9)), "CRV012")[0]
    assert found(points((-1, -5), (0, 0), (1, 5)), "CRV012") == []
    assert found(points((0.1, 10), (0.2, 30)), "CRV012") == [("CRV012", 3, 2)]
    assert found(points((1, 3), (0, 0), (2, 2)), "CRV012") == [("CRV012", 6, 2)]


def test_a_steep_end() -> None:
    assert found(points((0, 0), (1, 1), (2, 101)), "CRV008") == []
    assert found(points((0, 0), (1, 1), (2, 101.1)), "CRV008") == [("CRV008", 6, 2)]
    assert found(points((0, 0), (1, 1), (2, 1), (3, 200)), "CRV008") == [("CRV008", 7, 2)]
    assert found(points((0, 0), (1, 1000)), "CRV008") == []
    assert found(points((0, 0), (1, 1000), (2, 1001), (3, 1201)), "CRV008") == [("CRV008", 7, 2)]
    assert found(points((0, 0), (1, 1), (2, 91), (3, 1000)), "CRV008") == []
    assert found(points((0, 0), (1, 1), (2, 1)), "CRV008", "CRV013") == [("CRV013", 6, 2)]


@pytest.mark.parametrize("given", [((0, 0), (10, 0.5)), ((0, 0), (11, 2)), ((0, 0), (0, 0)), ((0, 0), (0.1, 900))])
def test_columns_in_their_order(given: tuple[tuple[float, float], ...]) -> None:
    assert found(points(*given), "CRV009") == []


def test_columns_with_a_bad_row_or_of_a_document_are_not_exchanged() -> None:
    text = points((0, 0), (1200, 0.1), (4200, 0.5)).replace("4200, 0.5", "4200, 0.5\n 1, 2, 3\n x, y")
    assert [one.fix for one in lint_bytes(text.encode(), "deck.keyxm", select(["CRV009"]))] == [None]


def test_ratios_up_to_five() -> None:
    assert found(points((0, 0), (5, 1)), "CRV010") == []
    assert found(points((5.1, 1), (0, 0)), "CRV010") == [("CRV010", 4, 2)]
    assert found(CURVES + " CURVE=a\n", "CRV010", "CRV009") == []


def test_elements_beyond_their_curve() -> None:
    deep = PIPE.replace("-0.05", "-0.126")
    assert found(PIPE.replace("-0.05", "-0.125") + ON_CLAY, "CRV014") == []
    assert found(deep + ON_CLAY, "CRV014") == [("CRV014", 14, 2)]
    assert "10 elements lie" in messages(deep + ON_CLAY, "CRV014")[0]
    assert found(deep + ON_CLAY + "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=2\n", "CRV014") == []
    assert found(deep.replace("0.25, 0.22", "x, 0.22") + ON_CLAY, "CRV014") == []
    assert found(RESTART + ON_CLAY.join(["$MODEL\n", ""]), "CRV014") == []


# ------------------------------------------------------------------------------------- rules over sections and elements


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
