"""UNT004 to UNT006: densities, moduli and lengths of other units, at their limits and in every unit system."""

from __future__ import annotations

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from tests.checks.findings import PIPE, PROPERTIES, curve
from tests.helpers.builders.decks import STEEL

CODES = ("UNT002", "UNT004", "UNT005", "UNT006")
IMPERIAL = PIPE.replace("207.0E9, 79.6E9, 0.25, 0.22, 7850.0", "4.32E9, 1.66E9, 0.82, 0.72, 15.23")


def told(text: str, suffix: str = "keyxm") -> list[tuple[str, int, int, str]]:
    """Code, line, column and message of what the rules of magnitudes find."""
    findings = lint_bytes(text.encode(), f"deck.{suffix}", select(CODES))
    return [(one.code, one.line, one.column, one.message) for one in findings]


def section(row: str, option: str = "RIGID") -> str:
    return PIPE.replace("RIGID", option).replace("207.0E9, 79.6E9, 0.25, 0.22, 7850.0", row)


def ocean(row: str) -> str:
    return f"$MODEL\n*OCEAN\n {row}\n"


def only(text: str, suffix: str, code: str, place: tuple[int, int], words: str) -> None:
    """Assert that there is one finding, at this place and with these words."""
    found = told(text, suffix)
    assert [one[:3] for one in found] == [(code, *place)], found
    assert words in found[0][3]


# ---------------------------------------------------------------------------------------------------------- densities


@pytest.mark.parametrize(
    ("suffix", "density", "words"),
    [
        ("keyxm", "1.025", "looks like t/m3 or g/cm3"),
        ("keyxm", "64.0", "looks like lb/ft3"),
        ("keyxm", "1.9888", "looks like slug/ft3"),
        ("keyxm", "8.55", "looks like lb/gal"),
        ("keyxm", "10055.0", "looks like N/m3"),
        ("keyxm", "10.05", "looks like kN/m3"),
        ("keyxm", "1.025E-9", "looks like t/mm3"),
        ("keyxm", "1.0", "looks like t/m3 or g/cm3"),
        ("keyxm", "899.0", "expected 900 to 2500 kg/m3 (fresh water to heavy brine): correct it"),
        ("keyxm", "2501.0", "expected 900 to 2500 kg/m3 (fresh water to heavy brine): correct it"),
        ("keyxm", "=[1025/1000]", "looks like t/m3 or g/cm3"),
        ("keyxi", "1025.0", "looks like kg/m3"),
        ("keyxi", "64.0", "looks like lb/ft3"),
        ("keyxi", "1.025", "looks like t/m3 or g/cm3"),
        ("keyxi", "5.0", "expected 1.75 to 4.85 slug/ft3 (fresh water to heavy brine): correct it"),
    ],
)
def test_water_in_another_unit(suffix: str, density: str, words: str) -> None:
    only(ocean(f"500.0, {density}"), suffix, "UNT004", (3, 9), words)


@pytest.mark.parametrize(
    ("suffix", "density"),
    [
        *(("keyxm", value) for value in ("900.0", "1000.0", "1025.0", "1240.0", "2500.0", "0.0", "1.225", "", "100.0")),
        *(("keyxi", value) for value in ("1.94", "1.9888", "2.4", "0.0", "0.00238", "")),
        *(("keyx", value) for value in ("1.0", "64.0", "1025.0", "7.85")),
    ],
)
def test_water_fresh_salt_or_heavy_and_air(suffix: str, density: str) -> None:
    assert told(ocean(f"500.0, {density}"), suffix) == []


@pytest.mark.parametrize(("suffix", "row"), [("keyxm", "1025.0, 350.0"), ("keyxi", "1.99, 1200.0")])
def test_depth_and_density_exchanged(suffix: str, row: str) -> None:
    place = row.index(",") + 4
    only(ocean(row), suffix, "UNT004", (3, place), "depth and density seem to be exchanged, write depth first")


@pytest.mark.parametrize("row", ["1025.0, 1025.0", "1000.0, 1000.0", "1025.0"])
def test_a_depth_like_a_density_is_legal(row: str) -> None:
    assert told(ocean(row)) == []


@pytest.mark.parametrize(
    ("suffix", "row", "words"),
    [
        ("keyxm", "207.0E9, 79.6E9, 0.25, 0.22, 7.85", "7.85 looks like t/m3 or g/cm3"),
        ("keyxm", "207.0E9, 79.6E9, 0.25, 0.22, 490.0", "490.0 looks like lb/ft3"),
        ("keyxm", "207.0E9, 79.6E9, 0.25, 0.22, 15.23", "looks like slug/ft3"),
        ("keyxm", "207.0E9, 79.6E9, 0.25, 0.22, 0.2836", "looks like lb/in3"),
        ("keyxm", "207.0E9, 79.6E9, 0.25, 0.22, 76980.0", "looks like N/m3"),
        ("keyxm", "110.0E9, 42.0E9, 0.25, 0.22, 4.43", "looks like t/m3 or g/cm3"),
        ("keyxm", "207.0E9, 79.6E9, 0.25, 0.22, 0.5", "expected 10 to 40000 kg/m3"),
        ("keyxm", "207.0E9, 79.6E9, 0.25, 0.22, =[78.5/10]", "7.85 looks like t/m3"),
        ("keyxi", "4.32E9, 1.66E9, 0.82, 0.72, 490.0", "looks like lb/ft3"),
        ("keyxi", "4.32E9, 1.66E9, 0.82, 0.72, 7850.0", "looks like kg/m3"),
        ("keyxi", "4.32E9, 1.66E9, 0.82, 0.72, 7.85", "looks like t/m3 or g/cm3"),
    ],
)
def test_steel_in_another_unit(suffix: str, row: str, words: str) -> None:
    only(section(row), suffix, "UNT004", (12, row.rindex(",") + 4), words)


@pytest.mark.parametrize(
    ("density", "expected"), [("7.85", 1), ("7850.0", 0), ("1.025", 0), ("7850000.0", 1), ("8.4", 1), ("8.7", 0)]
)
def test_in_user_units_only_the_ratio_of_steel_to_water_counts(density: str, expected: int) -> None:
    text = section(f"207.0, 79.6, 0.25, 0.22, {density}") + "*OCEAN\n 500.0, 1025.0, 981.0\n"
    assert [one[0] for one in told(text, "keyx")] == ["UNT004"] * expected
    assert told(text.replace("1025.0", ""), "keyx") == []


# ------------------------------------------------------------------------------------------------------------- moduli


@pytest.mark.parametrize(
    ("suffix", "row", "words"),
    [
        ("keyxm", "207.0, 79.6, 0.25, 0.22, 7850.0", "207.0 looks like GPa"),
        ("keyxm", "70.0, 26.5, 0.25, 0.22, 2700.0", "70.0 looks like GPa"),
        ("keyxm", "7.0E4, 26500.0, 0.25, 0.22, 2700.0", "looks like MPa"),
        ("keyxm", "30000.0, 11500.0, 0.25, 0.22, 7850.0", "looks like ksi"),
        ("keyxm", "30.0E6, 11.5E6, 0.25, 0.22, 7850.0", "looks like psi"),
        ("keyxm", "207.0E6, 79.6E6, 0.25, 0.22, 7850.0", "looks like kPa"),
        ("keyxm", "4.32E9, 1.66E9, 0.25, 0.22, 7850.0", "looks like lbf/ft2"),
        ("keyxm", "=[0.207*1000], =[79.6], 0.25, 0.22, 7850.0", "207.0 looks like GPa"),
        ("keyxm", "99999.0, 33000.0, 0.25, 0.22, 1100.0", "expected at least 100000 N/m2"),
        ("keyxi", "30.0E6, 11.5E6, 0.82, 0.72, 15.23", "looks like psi"),
        ("keyxi", "29000.0, 11200.0, 0.82, 0.72, 15.23", "looks like ksi"),
        ("keyxi", "207.0E9, 79.6E9, 0.82, 0.72, 15.23", "looks like N/m2"),
        ("keyxi", "207.0, 79.6, 0.82, 0.72, 15.23", "looks like GPa"),
    ],
)
def test_a_modulus_in_another_unit(suffix: str, row: str, words: str) -> None:
    only(section(row), suffix, "UNT005", (12, 2), words)


def test_young_and_shear_modulus_exchanged() -> None:
    words = "E and G seem to be exchanged, write E first"
    only(section("79.6E9, 207.0E9, 0.25, 0.22, 7850.0"), "keyxm", "UNT005", (12, 10), words)
    only(section("79.6, 207.0, 0.25, 0.22, 7.85"), "keyx", "UNT005", (12, 8), words)


def test_the_shear_modulus_alone() -> None:
    only(
        section("207.0E9, 79.6, 0.25, 0.22, 7850.0"),
        "keyxm",
        "UNT005",
        (12, 11),
        "shear modulus G is 79.6 N/m2",
    )
    only(section(", 79.6, 0.25, 0.22, 7850.0"), "keyxm", "UNT005", (12, 4), "79.6 looks like GPa")


@pytest.mark.parametrize(
    ("row", "suffix", "expected"),
    [
        ("207.0E9, 69.0E9, 0.25, 0.22, 7850.0", "keyxm", 0),  # 0.5
        ("207.0E9, 68.0E9, 0.25, 0.22, 7850.0", "keyxm", 1),
        ("207.0E9, 103.5E9, 0.25, 0.22, 7850.0", "keyxm", 0),  # 0
        ("207.0E9, 106.0E9, 0.25, 0.22, 7850.0", "keyxm", 1),
        ("207.0, 68.0, 0.25, 0.22, 7.85", "keyx", 1),
        ("207.0, 106.0, 0.25, 0.22, 7.85", "keyx", 1),
        ("207.0, 79.6, 0.25, 0.22, 7.85", "keyx", 0),
        ("60.0E9, 10.5E9, 0.25, 0.22, 1600.0", "keyxm", 0),  # a composite: ratio 2
        ("140.0E9, 5.0E9, 0.25, 0.22, 1550.0", "keyxm", 0),
        ("25.0E9, 5.0E9, 0.25, 0.22, 2900.0", "keyxm", 0),  # a composite that carries the mass of its contents
        ("70.0E9, 20.0E9, 0.25, 0.22, 2700.0", "keyxm", 1),
    ],
)
def test_poissons_ratio(row: str, suffix: str, expected: int) -> None:
    found = told(section(row), suffix)
    assert [one[0] for one in found] == ["UNT005"] * expected
    assert all("Poisson's ratio" in one[3] and one[2] > 2 for one in found)


def test_poissons_ratio_of_user_units_uses_the_density_against_water() -> None:
    text = section("60.0, 10.5, 0.25, 0.22, 1.6")
    assert len(told(text, "keyx")) == 1
    assert told(text + "*OCEAN\n 100.0, 1.025, 981.0\n", "keyx") == []


# ------------------------------------------------------------------------------------------------------------ lengths


@pytest.mark.parametrize(
    ("suffix", "row", "column", "words"),
    [
        (
            "keyxm",
            "207.0E9, 79.6E9, 323.9, 288.9, 7850.0",
            19,
            "at most 60 m (the hull of a spar has 37 m): 323.9 looks like mm",
        ),
        ("keyxm", "207.0E9, 79.6E9, 12.75, 11.75, 7850.0", 19, "12.75 looks like inches"),
        ("keyxm", "207.0E9, 79.6E9, 48.3, 41.0, 7850.0", 19, "48.3 looks like mm"),
        ("keyxi", "4.32E9, 1.66E9, 12.75, 11.75, 15.23", 18, "12.75 looks like inches"),
        ("keyxi", "4.32E9, 1.66E9, 323.9, 288.9, 15.23", 18, "expected at most 197 ft"),
        ("keyxm", "207.0E9, 79.6E9, 0.3239, 0.0175, 7850.0", 27, "a smaller bore is a wall thickness"),
        ("keyxi", "4.32E9, 1.66E9, 1.0625, 0.0625, 15.23", 26, "a smaller bore is a wall thickness"),
    ],
)
def test_a_diameter_of_a_steel_pipe(suffix: str, row: str, column: int, words: str) -> None:
    only(section(row), suffix, "UNT006", (12, column), words)


@pytest.mark.parametrize(
    ("option", "row", "column", "words"),
    [
        (
            "FLEXIBLE",
            ", , , 3.5E8, 95.0, 0.9, 152.4, 262.0, 262.0",
            26,
            "looks like mm, write it in m; also unusual: drag diameter Dd, buoyancy diameter Db",
        ),
        ("FLEXIBLE", ", , , 3.5E8, 95.0, 0.9, 6.0, 10.3, 10.3", 37, "inches"),
        (
            "FLEXIBLE",
            ", , , 3.5E8, 2800.0, 0.9, 0.1524, 0.262, 0.262, 0.262",
            43,
            "0.14 times the diameter of",
        ),
        ("FLEXIBLE", ", , , 3.5E8, 95.0, 0.9, 0.1524, 0.262, 0.262, 2.62", 48, "10 times the drag and"),
        ("RIGID", "207.0E9, 79.6E9, 0.25, 0.22, 7850.0, , , , 350.0, 350.0", 45, "1400 times Do"),
        ("FLEXIBLE", ", , , 3.5E6, 0.5, 0.001, 0.0, 0.02, 17.0, 17.0", 38, "mm"),
        ("MOORING", "493.0E6, 126.5, 600.0", 18, "600.0 looks like mm"),
        ("TRUSS", "493.0E6, 20.0, 17.0", 17, "as much water as its mass"),
    ],
)
def test_a_diameter_beside_the_mass(option: str, row: str, column: int, words: str) -> None:
    only(section(row, option), "keyxm", "UNT006", (12, column), words)


def test_a_diameter_beside_the_mass_in_user_units_needs_the_density_of_water() -> None:
    text = section("1.0E8, 0.35, 65.0", "MOORING")
    assert told(text, "keyx") == []
    only(
        text + "*OCEAN\n 240.0, 1.0, 981.0\n",
        "keyx",
        "UNT006",
        (12, 15),
        "97.4 times the diameter of",
    )


LAW = PROPERTIES + " STIFFNESS=60000.0\n FRICTION=0.4, 0.7, {}\n"


@pytest.mark.parametrize(
    ("lengths", "columns"),
    [
        ("0.03, 0.2", []),
        ("3.048, 3.048", []),  # the first is SBD013's
        ("10.0, 10.0", []),
        ("3.2, 3.2", []),
        ("3.3, 3.3", [21]),
        ("30, 200", [21]),  # also unusual
        ("=[30*1.0], 0.2", [21]),
    ],
)
def test_a_mobilisation_length(lengths: str, columns: list[int]) -> None:
    assert [one[:3] for one in told(PIPE + LAW.format(lengths))] == [("UNT006", 17, column) for column in columns]


def test_the_mobilisation_length_of_wide_pipes_may_be_longer() -> None:
    wide = PIPE.replace("0.25, 0.22", "1.2, 1.15")
    assert told(wide + LAW.format("12.0")) == []
    assert len(told(wide + LAW.format("12.1"))) == 1
    imperial = IMPERIAL + LAW.format("{}").replace("60000.0", "1200.0")
    assert told(imperial.format("10.4"), "keyxi") == []
    assert len(told(imperial.format("10.6"), "keyxi")) == 1
    assert told(PIPE + LAW.format("25.0"), "keyx") == []
    assert len(told(PIPE + LAW.format("25.1"), "keyx")) == 1


def test_the_mobilisation_length_of_a_legacy_surface_and_of_replaced_friction() -> None:
    surface = "*ELASTIC SURFACE\n 60000, 0.4, 0.7, , , , , , , 30.0\n"
    assert [one[:3] for one in told(PIPE + surface)] == [("UNT006", 14, 31)]
    friction = "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0.5, 0.5\n STIFFNESS=1E5\n"
    assert told(PIPE + LAW.format("30.0") + friction) == []


RATIOS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5)


@pytest.mark.parametrize("suffix", ["keyxm", "keyx"])
@pytest.mark.parametrize(
    ("diameter", "scale", "expected"),
    [(0.3239, 0.3239, 1), (0.3239, 1.0, 0), (0.25, 0.25, 0), (0.2191, 0.2191, 1), (0.2191, 0.3239, 0)],
)
def test_a_curve_over_metres(suffix: str, diameter: float, scale: float, expected: int) -> None:
    points = [(0.0, 0.0), *((round(ratio * scale, 6), 1000.0 * ratio) for ratio in RATIOS)]
    text = PIPE.replace("0.25, 0.22", f"{diameter}, 0.19") + "*SEABED STIFFNESS\n" + curve("Clay", *points)
    found = told(text + PROPERTIES + " STIFFNESS=Clay\n", suffix)
    assert [one[:3] for one in found] == [("UNT006", 14, 2)] * expected


NODES = "$MODEL\n*NODE\n" + "".join(f" {node}, 0.0, {{{node}}}\n" for node in range(5))
CHAIN = "*ELEMENT\n 1, 0, 1\n 2, 1, 2\n 3, 2, 3\n 4, 3, 4\n"


@pytest.mark.parametrize(
    ("y", "lines"),
    [
        ((0, 10, 260, 270, 280), []),  # 25 times as long
        ((0, 10, 270, 280, 290), [10]),
        ((0, 10, 270, 530, 540), []),  # two of them
        ((0, 260, 270, 280, 290), []),  # at the end of the line
        ((0, 1, 20, 40, 41), []),
    ],
)
def test_an_element_longer_than_its_neighbours(y: tuple[int, ...], lines: list[int]) -> None:
    text = NODES.format(*y) + CHAIN + STEEL
    for suffix in ("keyxm", "keyx"):
        assert [one[:3] for one in told(text, suffix)] == [("UNT006", line, 2) for line in lines]


@pytest.mark.parametrize(
    ("y", "expected"),
    [
        ((0, 10, 250, 30, 40), [5]),
        ((0, 10, 32, 30, 40), [5]),
        ((0, 10, 29, 30, 40), []),
        ((0, 10, 20, 12, 5), [5]),  # it goes back, and on
    ],
)
def test_a_line_that_turns_back_and_forward_again(y: tuple[int, ...], expected: list[int]) -> None:
    found = told(NODES.format(*y) + CHAIN + STEEL)
    assert [one[:2] for one in found] == [("UNT006", line) for line in expected]


@pytest.mark.parametrize(
    ("ends", "expected"), [("1, 3", [10]), ("1, 4", []), ("1, 2", [])], ids=["the next one", "far", "right"]
)
def test_an_element_that_leaves_out_a_node(ends: str, expected: list[int]) -> None:
    listed = f"*ELEMENT\n 1, 0, 1\n 2, {ends}\n 3, 2, 3\n 4, 3, 4\n"
    found = told(NODES.format(0, 10, 20, 30, 40) + listed + STEEL)
    assert [one[1] for one in found] == expected


ROWS = {
    "x": (" 2, -0,05, 20.0", [5]),
    "y": (" 2, 0.0, 20,5", [5]),
    "y of zeros": (" 2, 0.0, 20,00", [5]),
    "three coordinates": (" 2, 0.0, 20.0, 0", []),
    "whole numbers": (" 2, 0, 20, 0", []),
    "a node aside": (" 2, 0, 20, 5.0", []),
}


def test_whole_numbers_with_zeros_in_front_are_no_decimal_commas() -> None:
    rows = "".join(f" {node:03}, 000, {10 * node:03}, {5 * (node > 2):02}\n" for node in range(5))
    assert told("$MODEL\n*NODE\n" + rows + CHAIN + STEEL) == []


def test_a_long_element_may_end_at_a_tee_where_no_node_is_nearer() -> None:
    main = "".join(f" {node}, 0.0, {5.0 * node}\n" for node in range(9))
    first = " 21, 0.0, 20.0, 55.0\n 22, 0.0, 20.0, 50.0\n 23, 0.0, 20.0, 45.0\n"
    second = " 31, 0.0, 30.0, {}\n 32, 0.0, 30.0, {}\n"
    ends = [*((node, node + 1) for node in range(8)), (21, 22), (22, 23), (23, 4), (31, 32), (32, 6)]
    listed = "".join(f" {row}, {one}, {other}\n" for row, (one, other) in enumerate(ends, 1))
    text = f"$MODEL\n*NODE\n{main}{first}{second}*ELEMENT\n{listed}{STEEL}"
    assert told(text.format(10.0, 5.0)) == []
    assert [one[0] for one in told(text.format(45.0, 40.0))] == ["UNT006"]


def test_an_element_of_another_section_may_be_long() -> None:
    text = NODES.format(0, 10, 1010, 1020, 1030) + CHAIN + "*ELEMENT SETS\n SET=Tether\n 2\n" + STEEL
    assert len(told(text)) == 1
    assert told(text + " OPTION=TRUSS\n SET=Tether\n 1E8, 12.0, 0.05\n") == []


@pytest.mark.parametrize(
    ("suffix", "depth", "top", "expected"),
    [
        ("keyxm", 250, 750.0, 0),
        ("keyxm", 250, 751.0, 1),
        ("keyxm", 30, 280.0, 0),  # the tip of a wind turbine
        ("keyxm", 0.3, 300.0, 0),
        ("keyxm", 0.5, 501.0, 1),  # km
        ("keyxi", 800, 2450.0, 1),
        ("keyxi", 800, 2400.0, 0),
        ("keyx", 250, 2500.0, 0),
        ("keyx", 250, 2501.0, 1),
    ],
)
def test_the_height_of_nodes_against_the_depth(suffix: str, depth: float, top: float, expected: int) -> None:
    text = f"$MODEL\n*OCEAN\n {depth}\n*NODE\n 1, 0.0, 0.0\n 2, {top}, 0.0\n*ELEMENT\n 1, 1, 2\n"
    assert [one[:3] for one in told(text, suffix)] == [("UNT006", 3, 2)] * expected


# ----------------------------------------------------------------------------------------------------- legal structures

LEGAL = {
    "spar hull": ("RIGID", "207.0E9, 79.6E9, 37.0, 36.9, 7850.0"),
    "solid hull": ("RIGID", "207.0E9, 79.6E9, 37.0, 0.0, 490.0"),
    "hull by mass": ("FLEXIBLE", "1E12, 1E12, 1E12, 1E12, 1.1E6, 1E8, 0.0, 37.0, 37.0"),
    "monopile": ("RIGID", "210.0E9, 80.8E9, 8.0, 7.84, 7850.0"),
    "blowout preventer": ("RIGID", "207.0E9, 79.6E9, 4.0, 0.476, 7850.0"),
    "wellhead": ("RIGID", "207.0E9, 79.6E9, 1.0, 0.476, 7850.0"),
    "riser joint with buoyancy": ("RIGID", "207.0E9, 79.6E9, 0.5334, 0.4953, 27700.0"),
    "aluminium riser": ("RIGID", "70.0E9, 26.3E9, 0.5334, 0.45, 2780.0"),
    "titanium riser": ("RIGID", "110.0E9, 42.0E9, 0.27, 0.22, 4430.0"),
    "composite riser": ("RIGID", "38.0E9, 6.0E9, 0.3, 0.25, 1680.0"),
    "polyethylene outfall": ("RIGID", "0.9E9, 0.32E9, 1.2, 1.1, 955.0"),
    "bend stiffener": ("RIGID", "68.0E6, 23.0E6, 0.9, 0.35, 1150.0"),
    "foam": ("RIGID", "1.2E9, 0.45E9, 1.5, 0.3, 490.0"),
    "rubber": ("RIGID", "3.0E6, 1.0E6, 0.4, 0.3, 1100.0"),
    "placeholder": ("RIGID", "1.0, 1.0, 1.0, 0.0, 1.0"),
    "rigid link": ("RIGID", "2.07E14, 7.96E13, 0.5, 0.4, 1.0"),
    "section by area": ("RIGID", "207.0E9, 79.6E9, 0.6, 0.0, 490.0, 0.02, 1E-4, 2E-4"),
    "cable": ("FLEXIBLE", "5.0, 5.0, 3.0, 1.5E7, 0.9, 0.0001, 0.0, 0.017, 0.017"),
    "flexible pipe": ("FLEXIBLE", "23.5E3, 23.5E3, 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3429, 0.3429"),
    "buoyancy module": ("FLEXIBLE", "12.5E3, 12.5E3, 9.0E3, 3.5E8, 410.0, 2.1, 0.1524, 1.3, 1.1, 0.262"),
    "umbilical": ("FLEXIBLE", "12.0E3, 12.0E3, 8.0E3, 250.0E6, 36.5, 0.12, 0.0127, 0.168, 0.168"),
    "chain": ("MOORING", "493.0E6, 126.5, 0.137"),
    "chain by its bar": ("MOORING", "854.0E6, 199.0, 0.1"),
    "polyester rope": ("TRUSS", "1.5E7, 18.7, 0.152"),
    "weightless link": ("TRUSS", "1.0E10, 0.001, 1.0"),
}


@pytest.mark.parametrize("name", LEGAL)
def test_what_people_build_is_legal(name: str) -> None:
    option, row = LEGAL[name]
    law = PROPERTIES + " STIFFNESS=60000.0\n FRICTION=0.4, 0.7, 0.004, 0.2\n"
    assert told(section(row, option) + law + "*OCEAN\n 1500.0, 1025.0, 9.81\n") == []


def test_negative_and_unreadable_values_belong_to_other_rules() -> None:
    for row in ("-207.0, -79.6, -0.25, 0.22, -7.85", "x, y, z, 0.22, u", "=[nothing], 79.6E9, =[0/0], 0.22, =[1/0]"):
        assert told(section(row)) == []
    assert told(ocean("-5.0, -1.0")) == told(ocean("x, y")) == []
