"""Rules over names and curves: where they find something, and above all where they do not."""

from __future__ import annotations

import pytest

from tests.lint.findings import CLAY, CURVES, PIPE, PROPERTIES, RESTART, curve, found, messages

# ------------------------------------------------------------------------------------------------------------ curves


def test_unused_curves_are_told_each_once() -> None:
    text = CURVES + CLAY + curve("a", (0, 0), (1, 1)) + curve("A", (0, 0), (1, 2)) + PROPERTIES + " STIFFNESS=CLAY\n"
    assert found(text, "REF003", "REF004") == [("REF003", 6, 8), ("REF004", 9, 8)]


def test_without_any_seabed_properties_no_curve_is_used() -> None:
    assert found(CURVES + CLAY, "REF003") == [("REF003", 3, 8)]


@pytest.mark.parametrize(
    "text",
    [
        CURVES + CLAY + PROPERTIES + " STIFFNESS=clay\n",
        '$PREPROCESSOR\n*PARAMETERS\n soil, "Sand"\n'
        + CURVES
        + CLAY
        + curve("Sand", (0, 0), (1, 1))
        + PROPERTIES
        + " STIFFNESS==[soil]\n",
        CURVES + CLAY + PROPERTIES + " STIFFNESS==[nothing]\n",
        CURVES + CLAY + PROPERTIES + " STIFFNESS=Caly\n",
        CURVES + CLAY + PROPERTIES + " STIFFNESS=\n",
        CURVES + CLAY + PROPERTIES + " STIFNESS=Clay\n",
        CURVES + CLAY + "*SEABED PROPERTEIS\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n",
        CURVES + CLAY + "$LOAD CASE\n" + PROPERTIES + " STIFFNESS=Clay\n",
        PROPERTIES + " STIFFNESS=Clay\n" + CURVES + CLAY,
        RESTART + CURVES + CLAY,
        "$PREPROCESSOR\n*VARIATION\n NAME=v\n ACTION=ADD, KEYWORD=SEABED PROPERTIES, FILE=x\n" + CURVES + CLAY,
        CURVES + " CURVE=\n 0, 0\n 1, 1\n",
        "$MODEL\n*ELASTIC SURFACE\n ,\n*EMBEDMENT\n SET=ALL\n 0, 0\n 1, 1\n",
    ],
)
def test_curves_that_are_used_or_may_be(text: str) -> None:
    assert found(text, "REF003") == []


def test_other_variations_use_no_curve() -> None:
    text = "$PREPROCESSOR\n*VARIATION\n NAME=v\n PARA=depth, VALUE=100, 200\n" + CURVES + CLAY
    assert found(text, "REF003") == [("REF003", 7, 8)]


def test_a_curve_whose_name_reads_as_a_number_is_not_reached() -> None:
    text = CURVES + curve("100", (0, 0), (1, 1)) + PROPERTIES + " STIFFNESS=100\n"
    assert found(text, "REF003", "SBD017") == [("SBD017", 3, 8)]


def test_a_second_curve_of_a_set_is_a_duplicate_too() -> None:
    text = "$MODEL\n*ELASTIC SURFACE\n ,\n*EMBEDMENT\n 0, 0\n 1, 1\n SET=all\n 0, 0\n 1, 1\n"
    assert found(text, "REF004") == [("REF004", 7, 6)]
    assert messages(text, "REF004")[0].startswith("set 'all' already has a curve")


def test_a_curve_and_a_set_may_share_a_name() -> None:
    text = PIPE + "*SEABED STIFFNESS\n" + curve("a", (0, 0), (1, 1)) + "*EMBEDMENT\n SET=a\n 0, 0\n 1, 1\n"
    assert found(text, "REF004") == []


def test_names_of_256_characters_are_fine() -> None:
    text = "$MODEL\n*ELEMENT SETS\n SET={}\n GEN=1, 2\n"
    assert found(text.format("x" * 256), "REF011") == []
    assert found(text.format("x" * 257), "REF011") == [("REF011", 3, 6)]


# ------------------------------------------------------------------------------------------------------------ points


def test_only_the_first_point_out_of_order_is_told() -> None:
    text = CURVES + curve("a", (0, 0), (0.3, 3), (0.2, 2), (0.5, 5), (0.1, 1)) + curve("b", (1, 1), (0, 0))
    assert found(text, "CRV002") == [("CRV002", 6, 2), ("CRV002", 11, 2)]


def test_equal_ratios_are_in_order() -> None:
    assert found(CURVES + curve("a", (0, 0), (0.3, 3), (0.3, 3), (0.5, 5)), "CRV002") == []


def test_a_row_that_could_not_be_read_is_not_out_of_order() -> None:
    text = CURVES + " CURVE=a\n 0, 0\n O.5, 1\n 0.6, 2\n 0.4, 1\n"
    assert found(text, "CRV002") == [("CRV002", 7, 2)]


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


def test_without_a_diameter_the_quotient_is_left_open() -> None:
    assert "|slope| / D = 2 / D" in messages(CURVES + curve("a", (0, 0), (0.5, 9), (1, 8)), "CRV005")[0]


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


def test_values_of_equations_are_looked_at_and_the_text_is_pointed_at() -> None:
    text = "$PREPROCESSOR\n*PARAMETERS\n r, -0.5\n" + CURVES + " CURVE=a\n 0, 0\n =[r], =[2*r]\n 1, 0\n"
    assert found(text, "CRV002", "CRV005", "CRV006") == [("CRV002", 8, 2), ("CRV006", 8, 2)]


# ---------------------------------------------------------------------------------------------------------- all rules


@pytest.mark.parametrize(
    "text",
    [
        "",
        "C nothing but a comment\n",
        RESTART + "*TIME\n 0, 100\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n",
        "$LOAD CASE\n*WAVE-REGULAR\n 2, 10\n",
        "$MODEL\n*LINES\n LINE=SCR, SECTION=TDZ\n*GEOMETRIC SETS\n SET=scr\n ,,,, 100, 1, 0.2, 0.3, 0.3\n"
        "*SEABED STIFFNESS\n" + CLAY + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=Tdz\n STIFFNESS=Clay\n",
        PIPE
        + "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n$MODEL\n*SEABED STIFFNESS\n"
        + CLAY
        + PROPERTIES
        + " STIFFNESS=Clay\n",
        "$DATABASE POSTPROCESSING\n*ELEMENT SETS\n SET=a\n 1, 2\n",
    ],
)
def test_decks_of_which_nothing_is_to_be_said(text: str) -> None:
    assert found(text) == []


def test_a_table_of_faults_is_told_up_to_a_limit() -> None:
    rows = "".join(f" -{row}.5, 1\n 0.5, 1\n 0.5, 1\n" for row in range(2000))
    text = CURVES + " CURVE=a\n 0, 0\n" + rows
    codes = [code for code, _, _ in found(text, "CRV004", "CRV006")]
    assert codes.count("CRV004") == codes.count("CRV006") == 1000
