"""Rules over the seabed: where they find something, and above all where they do not."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from mudline.language.deck.loading import load_bytes
from tests.checks.findings import ON_CLAY, PIPE, PROPERTIES, RESTART, curve, found, in_units


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ("*SEABED PROPERTIES\n SET=ALL\n STIFFNESS=1\n*SEABED PROPERTIES\n SET=ALL\n", [2]),
        ("*SEABED PROPERTIES\n SET=ALL\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=1\n", [2]),
        ("*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=1\n*SEABED PROPERTIES\n SET=ALL\n STIFFNESS=1\n", []),
        ("*SEABED PROPERTIES\n TYPE=ELASTC\n SET=ALL\n STIFFNESS=1\n", []),
        ("*SEABED PROPERTIES\n TYPE=\n SET=ALL\n STIFFNESS=1\n", []),
        ("*SEABED PROPERTIES\n TYPE=ELASTIC\n STIFFNESS=1\n SET=ALL\n STIFFNESS=2\n", [4]),
        ("*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=\n STIFFNESS=2\n", []),
        ("*ELASTIC SURFACE\n 1\n*EMBEDMENT\n 0, 0\n 1, 1\n SET=ALL\n 0, 0\n 1, 2\n", [5]),
        ("*ELASTIC SURFACE\n 1\n*EMBEDMENT\n SET=\n 0, 0\n 1, 2\n", []),
    ],
)
def test_types_and_sets_that_are_missing(lines: str, expected: list[int]) -> None:
    assert [line for _, line, _ in found("$MODEL\n" + lines, "SBD003")] == expected


def restraint(text: str) -> list[tuple[int, str]]:
    """Line of each finding of SBD006, and the elements it counts."""
    findings = lint_bytes(text.encode(), "deck.keyxm", select(["SBD006"]))
    return [(finding.line, finding.message.partition(")")[0]) for finding in findings]


def test_blocks_without_stiffness_are_told_each_with_their_elements() -> None:
    sets = "*ELEMENT SETS\n SET=a\n GEN=1, 4\n SET=b\n 4, 5\n SET=c\n 5\n"
    text = PIPE + sets + PROPERTIES + " STIFFNESS=1\n SET=a\n FRICTION=1\n SET=b\n LATERAL=1\n SET=c\n STIFFNESS=2\n"
    assert restraint(text) == [
        (24, "3 elements (first: 1"),
        (
            26,
            (
                "element 4 gets no stiffness from this block, which overrides earlier ones as a whole: give "
                "STIFFNESS= here too"
            ),
        ),
    ]


def test_elements_on_the_bed_without_a_law_are_counted_once() -> None:
    sets = "*ELEMENT SETS\n SET=a\n GEN=1, 4\n"
    text = PIPE + sets + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=a\n STIFFNESS=1\n"
    assert restraint(text) == [(8, "6 elements (first: 5")]
    assert restraint(text.replace("-0.05", "0.0")) == [(8, "6 elements (first: 5")]
    assert restraint(text.replace("-0.05", "0.05")) == []
    assert restraint(text.replace("11, -0.05", "11, 0.05")) == [(8, "element 5 lies at or below the seabed (X = 0")]


def test_a_slope_or_a_profile_hides_no_gap() -> None:
    gap = PIPE + "*ELEMENT SETS\n SET=a\n GEN=1, 4\n SET=b\n GEN=5, 10\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=a\n"
    gap += " STIFFNESS=1\n*SEABED PROFILE\n TYPE="
    assert restraint(gap + "SLOPING\n SLOPE=0.0\n") == [(18, "6 elements (first: 5")]
    assert restraint(gap + "SLOPING\n SLOPE=3.0\n") == [(18, "6 elements (first: 5")]
    assert restraint(gap + "SLOPING\n SLOPE=-3.0\n") == []
    assert restraint(gap + "SLOPING\n SLOPE=-3.0\n".replace("-0.05", "-9.0")) == []


def test_without_a_seabed_only_elements_below_it_count() -> None:
    assert restraint(PIPE) == [(7, "10 elements (first: 1")]
    assert restraint(PIPE.replace("-0.05", "0.0")) == []


@pytest.mark.parametrize(
    "lines",
    [
        "*RIGID SURFACE\n 0.3\n",
        "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n FRICTION=0.3\n",
        "*ELASTIC SURFACE\n 100\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n FRICTION=0.3\n",
        "*P-Y\n SET=ALL\n DEPTH=0\n 0, 0\n 100, 0.1\n",
        "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=5\n",
        "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=5\n" + PROPERTIES + " FRICTION=0.3\n",
        "*ELASTIC SURFACE\n x, 0.3\n",
        "*ELASTIC SURFACE\n",
        "*ELASTIC SURFAC\n 100\n",
        PROPERTIES + " STIFFNESS=\n",
        PROPERTIES + " STIFNESS=100\n",
        PROPERTIES + " STIFFNESS=Clay\n",
        PROPERTIES + " FRICTION=0.3\n SEET=ALL\n STIFFNESS=5\n",
        "*SEABED PROPERTIES\n TYPE=ELASTIC\n SEET=ALL\n STIFFNESS=5\n",
        "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=b\n STIFFNESS=5\n",
        PROPERTIES + " FRICTION=0.3\n SET=b\n STIFFNESS=5\n",
        "*SEABED PROPERTIES\n SET=ALL\n FRICTION=0.3\n",
        "*EMBEDMENT\n SET=ALL\n 0, 0\n",
        "*EMBEDMENT\n SET=b\n 0, 0\n 1, 1\n*ELASTIC SURFACE\n ,\n" + PROPERTIES + " FRICTION=0.3\n",
        "*LINES\n LINE=SCR\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=SCR\n STIFFNESS=5\n",
        "*LINES\n LINE=SCR\n" + PROPERTIES + " FRICTION=0.3\n SET=SCR\n STIFFNESS=5\n",
        RESTART,
        "$LOAD CASE\n" + PROPERTIES + " STIFFNESS=5\n",
    ],
)
def test_elements_that_are_held_or_may_be(lines: str) -> None:
    assert restraint(PIPE + lines) == []


def test_a_block_before_those_that_are_not_known_may_be_the_last() -> None:
    """The law of the set that is not defined stands before: whatever it holds for, the later block wins."""
    text = PIPE + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=b\n STIFFNESS=5\n SET=ALL\n FRICTION=0.3\n"
    assert restraint(text) == [(17, "10 elements (first: 1")]


RIGID = "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"


@pytest.mark.parametrize(
    ("code", "lines", "expected"),
    [
        ("SBD007", "*ELASTIC SURFACE\n 100, 0.3, 0.6, 50\n", 1),
        ("SBD007", PROPERTIES + " FRICTION=0.3, =[unknown]\n LATERAL=5\n", 0),
        ("SBD007", RIGID + " FRICTION=0.3, 0.6\n LATERAL=5\n", 0),
        ("SBD013", PROPERTIES + " FRICTION=0.3, 0.6, 10\n", 1),
        ("SBD013", PROPERTIES + " FRICTION=0.3, 0.6, 3.05\n", 0),
        ("SBD013", "*RIGID SURFACE\n 0.3, 0.6, 3.048\n", 0),
        ("SBD014", PROPERTIES + " FRICTION=, , , , , 5, 5\n", 2),
        ("SBD014", PROPERTIES + " FRICTION==[unknown], 0.5, , , , 5, 5\n", 0),
        ("SBD015", "*ELASTIC SURFACE\n 100, , , , , 0.5\n", 1),
        ("SBD015", "*ELASTIC SURFACE\n 100, , , , =[unknown], 0.5\n", 0),
        ("SBD020", "*RIGID SURFACE\n 0.3, 0.6, 3, 3, , 0.1\n", 1),
        ("SBD020", "*RIGID SURFACE\n 0.3, 0.6, 3, , , , 0.1\n", 0),
        ("SBD011", RIGID + "*SEABED PROFILE\n TYPE=3D\n INTERPOLATION=CUBIC\n FILE=a.fcsbd\n", 2),
        ("SBD011", RIGID + "*SEABED PROFILE\n TYPE=SLOPING\n DIRECTION=0\n SLOPE=1\n", 0),
        ("SBD011", PROPERTIES + "*SEABED PROFILE\n TYPE=3D\n FILE=a.fcsbd\n", 0),
        ("SBD012", "*ELASTIC SURFACE\n 100\n -90\n", 1),
        ("SBD012", "*ELASTIC SURFACE\n 100\n 45\n", 0),
        ("SBD012", "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE==[unknown]\n", 0),
        ("SBD016", "*SEABED PROPERTIES\n TYPE=ELASTIC\n*EMBEDMENT\n SET=ALL\n 0, 0\n 1, 1\n", 1),
        ("SBD016", "*ELASTIC SURFACE\n 100\n*SEABED UNLOADING\n SET=ALL\n STIFFNESS=5\n", 0),
        ("SBD017", "*SEABED STIFFNESS\n CURVE=1e3\n 0, 0\n 1, 1\n", 1),
        ("SBD017", "*SEABED STIFFNESS\n CURVE=Clay 3\n 0, 0\n 1, 1\n", 0),
    ],
)
def test_findings_of_a_rule(code: str, lines: str, expected: int) -> None:
    assert len(found(PIPE + lines, code)) == expected


def test_both_families_say_which_law_each_set_gets() -> None:
    sets = "*ELEMENT SETS\n SET=West\n 1\n SET=East\n 2\n"
    new = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=West\n STIFFNESS=30000\n SET=East\n STIFFNESS=clay\n"
    legacy = "*EMBEDMENT\n SET=West\n 0, 0\n 1, 1\n SET=East\n 0, 0\n 1, 2\n"
    curve = "*SEABED STIFFNESS\n CURVE=clay\n 0, 0\n 1, 5\n"
    text = PIPE + sets + curve + legacy + new
    (finding,) = lint_bytes(text.encode(), "deck.keyxm", select(["SBD016"]))
    assert finding.message == (
        "*EMBEDMENT and *SEABED STIFFNESS are in one model (partly inferred: SET='West' gets the curve of *EMBEDMENT "
        "for SET='West', SET='East' gets curve 'clay', no element gets the curve of *EMBEDMENT for SET='East'): "
        "keep one family"
    )


def test_a_steep_slope_is_a_warning_and_a_vertical_one_an_error() -> None:
    for slope, severity in ((45.1, "warning"), (-89.9, "warning"), (90.0, "error")):
        text = f"{PIPE}*SEABED PROFILE\n TYPE=SLOPING\n SLOPE={slope}\n"
        assert [one.severity for one in lint_bytes(text.encode(), "deck.keyxm", select(["SBD012"]))] == [severity]


@pytest.mark.parametrize(
    ("points", "expected"),
    [
        ([(0.0, 0.0), (-0.8, 60.0), (-1.2, 120.0)], "rises by 120 and is 1.2 wide in Y"),
        ([(0.0, 0.0), (60.0, -0.8), (120.0, -1.2)], ""),
        ([(0.0, 0.0), (60.0, 60.0)], ""),
    ],
)
def test_a_profile_that_is_higher_than_wide(points: list[tuple[float, float]], expected: str) -> None:
    lines = "".join(f" {y}, {elevation}\n" for y, elevation in points)
    text = PIPE + "*ELASTIC SURFACE\n 50000.0\n" + lines
    findings = lint_bytes(text.encode(), "deck.keyxm", select(["SBD012"]))
    assert len(findings) == bool(expected)
    assert all(expected in one.message for one in findings)


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        ("0, 0, 0\n100, 0.5, -40\n200, -0.5, 40\n", 1),  # Y, elevation, Z: it spans 1 by 80
        ("0, 0, 0\n0.5, 100, -40\n-0.5, 200, 40\n", 0),
    ],
)
def test_a_surface_that_is_higher_than_wide(files: str, expected: int, tmp_path: Path) -> None:
    (tmp_path / "bed.txt").write_text(files, encoding="utf-8")
    text = PIPE + PROPERTIES + "*SEABED PROFILE\n TYPE=3D\n FILE=bed.txt\n"
    assert len(lint_bytes(text.encode(), "deck.keyxm", select(["SBD012"]), folder=tmp_path)) == expected


# ----------------------------------------------------------------------------------------------------- uNT001 to UNT003


@pytest.mark.parametrize(
    ("suffix", "gravity", "fires"),
    [
        ("keyxm", "9.80665", False),
        ("keyxm", "10.01", True),
        ("keyxm", "32.2", True),
        ("keyxi", "32.174", False),
        ("keyxi", "9.81", True),
        ("keyx", "1.62", False),
        ("keyxm", "=[4.905*2]", False),
        ("keyxm", "=[nothing]", False),
        ("keyxm", "", False),
    ],
)
def test_gravity(suffix: str, gravity: str, fires: bool) -> None:
    text = f"$MODEL\n*OCEAN\n 500.0, 1025.0, {gravity}\n"
    assert in_units(text, suffix, "UNT001") == ([(3, 17)] if fires else [])


def test_magnitudes_by_unit_system() -> None:
    text = PIPE + "*SEABED STIFFNESS\n" + curve("a", (0, 0), (1, 9.9))
    text += PROPERTIES + " STIFFNESS=477.0\n"
    assert in_units(text, "keyxm", "UNT002") == [(14, 2), (20, 12)]
    assert in_units(text, "keyxi", "UNT002") == in_units(text, "keyx", "UNT002") == []
    kips = text.replace("1, 9.9", "1, 0.68").replace("=477.0", "=9.9")
    assert in_units(kips, "keyxi", "UNT002") == [(14, 2), (20, 12)]
    assert in_units(kips, "keyx", "UNT002") == []
    at_limits = text.replace("1, 9.9", "1, 0.7").replace("=477.0", "=10.0")
    assert in_units(at_limits, "keyxi", "UNT002") == []


def test_the_least_force_falls_with_the_diameter_of_a_cable() -> None:
    text = PIPE.replace("0.25, 0.22", "0.017, 0.0") + ON_CLAY.replace("4000.0", "{}")
    assert found(text.format(1.71), "UNT002") == []
    assert len(found(text.format(1.69), "UNT002")) == 1


def test_magnitudes_at_their_limits() -> None:
    text = PIPE + "*SEABED STIFFNESS\n" + curve("a", (0, 0), (1, 10)) + curve("b", (0, 0), (1, 0))
    assert found(text + PROPERTIES + " STIFFNESS=500\n SET=ALL\n STIFFNESS=0\n", "UNT002") == []
    assert found("$MODEL\n*ELASTIC SURFACE\n 50\n", "UNT002") == [("UNT002", 3, 2)]


def test_friction_of_every_keyword() -> None:
    text = "$MODEL\n*ELASTIC SURFACE\n 5E4, 2.0, 2.1\n*RIGID SURFACE\n 3, 0.5\n" + PROPERTIES + " FRICTION=, 5\n"
    text += "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0.5, 2.5\n STIFFNESS=1E5\n"
    text += "$LOAD CASE\n*FRICTION\n 500.0, 250.0\n"
    assert [(line, column) for _, line, column in found(text, "UNT003")] == [(3, 12), (5, 2), (9, 13), (12, 20)]


def test_lateral_springs_and_suction() -> None:
    law = PIPE + PROPERTIES + " STIFFNESS=50000.0\n LATERAL={}\n SUCTION={}, 0.1\n"
    assert found(law.format(100.0, 100.0), "UNT002") == []
    assert [line for _, line, _ in found(law.format(20.0, 15.0), "UNT002")] == [17, 18]
    assert in_units(law.format(2.0, 0.0), "keyxi", "UNT002") == []
    assert in_units(law.format(20.0, 15.0), "keyx", "UNT002") == []


@pytest.mark.parametrize(
    ("suffix", "density", "units"),
    [("keyx", "1.025", "user"), ("keyx", "1025.0", "metric"), ("keyxm", "1.025", "metric"), ("keyx", "", "metric")],
)
def test_a_deck_of_user_units_may_be_in_tonnes(suffix: str, density: str, units: str) -> None:
    text = f"$MODEL\n*OCEAN\n 500.0, {density}, 9.81\n"
    assert load_bytes(text.encode(), f"deck.{suffix}").units == units
