"""GEO005, GEO006, GEO017, SBD023, SBD024, SBD025: lines off the seabed, repeated sections, values without effect."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from tests.checks.findings import PIPE, PROPERTIES, RESTART, found, messages
from tests.helpers.builders import decks

LAW = PROPERTIES + " STIFFNESS=60000.0\n"
OCEAN = "*OCEAN\n 420.0, 1025.0, 9.81\n"


def line(start: str, end: str, more: str = LAW + OCEAN) -> str:
    return PIPE.replace("-0.05, 0.0", start).replace("-0.05, 100.0", end) + more


@pytest.mark.parametrize(
    ("start", "end", "expected"),
    [
        ("-0.05, 0.0", "-0.05, 100.0", ""),
        ("25.0, 0.0", "25.0, 100.0", ""),  # 100 diameters
        ("25.1, 0.0", "25.1, 100.0", "lies level"),
        ("30.0, 0.0", "39.9, 100.0", "lies level"),
        ("30.0, 0.0", "40.1, 100.0", ""),  # a jumper
        ("3.0, 0.0", "450.0, 0.0", ""),  # a riser on a wellhead
        ("200.0, 0.0", "419.0, 100.0", ""),  # a riser to a buoy
        ("420.0, 0.0", "840.0, 0.0", ""),
        ("420.1, 0.0", "840.0, 0.0", "in water 420 deep"),
        ("0.0, 0.0, 0.0", "0.0, 0.0, 420.0", "as if it were the height"),
        ("0.0, 0.0, 20.0", "0.0, 300.0, 440.0", "as if it were the height"),
        ("4.0, 0.0, -420.0", "0.0, 0.0, 0.0", "as if it were the height"),
        ("0.0, 0.0, 0.0", "0.0, 0.0, 398.0", ""),
        ("0.0, 0.0, 0.0", "0.0, 0.0, 442.0", ""),
        ("0.0, 0.0, 100.0", "0.0, 0.0, 520.0", ""),
        ("0.0, 0.0, 0.0", "4.3, 0.0, 420.0", ""),
    ],
)
def test_where_a_line_lies(start: str, end: str, expected: str) -> None:
    told = messages(line(start, end), "GEO005")
    assert len(told) == bool(expected)
    assert all(expected in message for message in told)


PROFILE = "*SEABED PROFILE\n TYPE=2D\n FILE=bed.txt\n"
SURFACE = "*SEABED PROFILE\n TYPE=3D\n FILE=bed.xyz\n"
PLANE = "*SEABED PLANES\n PLANE=Shelf\n POINT=0.0, 0.0, 0.0\n SLOPE=10.0\n DIRECTION=0.0\n BOUNDS=-5.0, 80.0\n"


@pytest.mark.parametrize(
    ("seabed", "end", "expected"),
    [
        (PLANE, "-0.05, 80.0", ""),
        (PLANE, "14.0, 80.1", "node 11 lies outside of the bounds of all planes of the seabed: no seabed holds"),
        (PLANE, "60.0, 100.0", ""),  # over 100 diameters above its border
        (PROFILE, "-0.05, 100.0", ""),
        (PROFILE, "-0.05, 100.1", "beyond the ends of the seabed profile (Y = 0 to 100): it is taken as level there"),
        (PROFILE + " DIRECTION=180.0\n", "-0.05, 50.0", "10 nodes (first: 11) lie beyond the ends"),
        (PROFILE, "40.0, 150.0", ""),
        (SURFACE, "-0.05, 100.0", ""),
        (SURFACE, "-0.05, 100.1", "node 11 lies outside of the hull of the seabed's 4 points: no seabed holds"),
        (SURFACE, "40.0, 150.0", ""),  # over 100 diameters above the highest point
    ],
)
def test_line_that_goes_on_beyond_the_survey(seabed: str, end: str, expected: str, tmp_path: Path) -> None:
    (tmp_path / "bed.txt").write_text("0.0, -1.0\n50.0, 1.0\n100.0, 0.0\n")
    (tmp_path / "bed.xyz").write_text("0.0, 0.0, -9.0\n1.0, 0.0, 9.0\n0.0, 100.0, -9.0\n0.0, 100.0, 9.0\n")
    deck = line("-0.05, 0.0", end, LAW + seabed).encode()
    chosen = select(("GEO017",))
    told = [one.message for one in lint_bytes(deck, "deck.keyxm", chosen, folder=tmp_path)]
    assert len(told) == bool(expected)
    assert all(expected in message for message in told)


@pytest.mark.parametrize(
    ("level", "x", "centreline", "count"),
    [
        ("LOWERED", -1.85, "", 0),
        ("UNCHANGED", -1.85, "", 1),
        ("LOWERED", -3.45, "", 1),  # 1.65 m below its bottom
        ("LOWERED", -1.85, " CENTRELINE=0.0, 0.5, 100.0, 0.5\n", 0),
        ("LOWERED", -1.85, " CENTRELINE=0.0, 4.0, 100.0, 4.0\n", 1),  # beside it
    ],
)
def test_a_pipe_in_a_trench_lies_on_its_bottom(level: str, x: float, centreline: str, count: int) -> None:
    trench = f"*SEABED TRENCH\n SET=ALL\n GEOMETRY=1.8, 1.5, 6.0\n PEAK=4000.0\n LEVEL={level}\n{centreline}"
    assert len(messages(line(f"{x}, 0.0", f"{x}, 100.0", LAW + trench), "SBD022")) == count


HIGH = ("500.0, 0.0", "500.0, 100.0")


@pytest.mark.parametrize(
    "more",
    [
        OCEAN,  # no seabed
        "*LINES\n LINE=Riser\n" + LAW + OCEAN,
        LAW + OCEAN + RESTART,
        LAW + OCEAN + "*P-Y\n SET=ALL\n DEPTH=0.0\n 0.0, 0.0\n 5.0, 0.1\n",
        LAW + OCEAN + "*SEABED PROFILE\n TYPE=2D\n FILE=gone.txt\n",
        LAW + OCEAN + "*SEABED PROFILE\n TYPE=2D\n FILE=shelf.fcsbd\n",
        "*ELEMENT SETS\n SET=Lower\n SUBSET=Nothing\n" + LAW.replace("ALL", "Lower") + OCEAN,
        "*ELASTIC SURFACE\n 60000.0, 0.3, 0.6\n 0.0, 500.0\n 100.0, 500.0\n" + OCEAN,
    ],
)
def test_lines_of_which_nothing_is_said(more: str) -> None:
    assert found(line(*HIGH, more), "GEO005") == []


def test_a_line_above_a_bed_of_another_shape_and_without_a_depth() -> None:
    slope = "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=2.0\n"
    assert found(line(*HIGH, LAW + slope), "GEO005") == [("GEO005", 4, 2)]  # the nearest
    assert found(line(*HIGH, "*RIGID SURFACE\n 0.3, 0.6\n"), "GEO005") == [("GEO005", 3, 2)]
    assert found(line("500.0, 0.0", "900.0, 0.0", LAW), "GEO005") == []


def test_only_elements_with_a_law_have_to_reach_the_seabed() -> None:
    parts = "*ELEMENT SETS\n SET=Lower\n GEN=1, 3\n" + LAW.replace("ALL", "Lower") + OCEAN
    assert found(line("0.0, 0.0", "500.0, 0.0", parts), "GEO005") == []
    assert len(found(line("421.0, 0.0", "0.0, 0.0", parts.replace("1, 3", "1, 1")), "GEO005")) == 0
    assert len(found(line("700.0, 0.0", "0.0, 0.0", parts), "GEO005")) == 1


# ------------------------------------------------------------------------------------------------------------ sections

SETS = "*ELEMENT SETS\n SET=A\n GEN=1, 5\n SET=B\n GEN=6, 10\n"
BARE = PIPE[: PIPE.index("*GEOMETRIC")] + SETS + "*GEOMETRIC SETS\n OPTION=RIGID\n"
STEEL = " SET={}\n 207.0E9, 79.6E9, 0.25, 0.22, 7850.0\n"


@pytest.mark.parametrize(
    ("names", "more", "expected"),
    [
        (("A", "A"), "", 1),
        (("A", " a ", "A"), "", 2),
        (("A", "B", "A"), "", 0),
        (("A", "A", "ALL"), "", 0),
        (("A",), "", 1),
        (("A",), "*FLEX JOINTS\n SET=B\n", 0),
        (("A",), "*SPRING ELEMENT\n SET=B\n TYPE=LINEAR\n 5000.0\n", 0),
        (("A",), "*HINGE\n 6\n 7\n 8\n 9\n 10\n", 0),
        (("A",), "*HINGE\n 6\n", 1),
        (("A",), "*HYDRODYNAMIC SETS\n SET=B, TYPE=CONSTANT\n 1.2, 0.0, 2.0, 1.0, 0.0\n", 1),
        (("A",), "*LINES\n LINE=C\n", 0),
        (("A", "A"), RESTART, 0),
        (("A", "A"), "*LINES\n LINE=B\n", 0),
        (("A", "A"), "*GEOMETRIC SETS\n OPTION=TRUSS\n SET=B\n , 5.0, 0.1\n", 0),
        (("A", "A", "Nowhere"), "", 0),
    ],
)
def test_a_set_with_two_sections(names: tuple[str, ...], more: str, expected: int) -> None:
    text = BARE + "".join(STEEL.format(name) for name in names) + more
    assert len(found(text, "GEO006")) == expected


# ------------------------------------------------------------------------------------------------------------ friction


def test_the_second_section_is_reported_also_in_another_block() -> None:
    text = BARE + STEEL.format("A") + "*GEOMETRIC SETS\n OPTION=TRUSS\n SET=A\n , 5.0, 0.1\n"
    assert found(text, "GEO006") == [("GEO006", text.count("\n") - 1, 6)]
    assert messages(text, "GEO006") == [
        "SET='A' already has a section, and SET='B' has none: correct one of the two names"
    ]


@pytest.mark.parametrize(
    ("lines", "place"),
    [
        (PROPERTIES + " STIFFNESS=5E4\n FRICTION=0.6\n", (17, 11)),
        (PROPERTIES + " STIFFNESS=5E4\n FRICTION=0.6, , 0.03\n", (17, 11)),
        (PROPERTIES + " STIFFNESS=5E4\n FRICTION==[0.3*2]\n", (17, 11)),
        (PROPERTIES + " STIFFNESS=5E4\n FRICTION=0.6, 0.0\n", None),
        (PROPERTIES + " STIFFNESS=5E4\n FRICTION=0.6, =[nothing]\n", None),
        (PROPERTIES + " STIFFNESS=5E4\n FRICTION=0.6, x\n", None),
        (PROPERTIES + " STIFFNESS=5E4\n FRICTION=0.0\n", None),
        (PROPERTIES + " STIFFNESS=5E4\n FRICTION=, 0.6\n", None),
        (PROPERTIES + " STIFFNESS=5E4\n FRICTION=0.6\n LATERAL=500.0\n", None),
        (PROPERTIES + " STIFFNESS=5E4\n FRICTION=0.6\n LATERAL=0.0\n", (17, 11)),
        ("*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n FRICTION=0.6\n LATERAL=500.0\n", (16, 11)),
        ("*ELASTIC SURFACE\n 5E4, 0.3\n", (14, 7)),
        ("*ELASTIC SURFACE\n 5E4, 0.3, , 2000.0\n", None),
        ("*ELASTIC SURFACE\n 5E4\n", None),
        ("*RIGID SURFACE\n 0.3\n", (14, 2)),
        ("*RIGID SURFACE\n 0.3, 0.0\n", None),
    ],
)
def test_one_friction_coefficient(lines: str, place: tuple[int, int] | None) -> None:
    assert found(PIPE + lines, "SBD024") == ([] if place is None else [("SBD024", *place)])


# ------------------------------------------------------------------------------------------------ values without effect

MODEL = PIPE + SETS + "*SEABED PROPERTIES\n TYPE=ELASTIC\n"


def soil(name: str, stiffness: int = 5000) -> str:
    return f" SET={name}\n STIFFNESS={stiffness}\n"


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        (soil("ALL") + soil("A", 6000) + soil("B", 7000), [20]),
        (soil("ALL") + soil("A", 6000), []),
        (soil("A") + soil("ALL", 6000), []),  # SBD008
        (soil("A") + soil("A", 6000), []),  # SBD008
        (soil("ALL") + soil("A") + soil("B") + "*LINES\n LINE=C\n", []),
        (soil("ALL") + soil("A") + soil("B") + RESTART, []),
        (soil("ALL", -1) + soil("A") + soil("B"), []),  # SBD010
        (soil("Nowhere"), []),  # REF001
        (soil("ALL") + "*SEABED PROPERTIES\n" + soil("A") + "*SEABED PROPERTIES\n" + soil("B"), [20]),
    ],
)
def test_a_definition_that_no_element_gets(lines: str, expected: list[int]) -> None:
    assert found(MODEL + lines, "SBD025") == [("SBD025", line, 6) for line in expected]


def test_a_set_without_elements() -> None:
    empty = MODEL.replace(" SET=B\n GEN=6, 10\n", " SET=B\n SET=C\n SUBSET=B\n")
    assert found(empty + soil("B"), "SBD025") == []  # REF010 speaks of the set
    assert found(empty + soil("B"), "REF010") == [("REF010", 16, 2)]
    (message,) = messages(empty + soil("C"), "SBD025")
    assert "as no subset of SET='C' has any" in message


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ("*ELASTIC SURFACE\n 5E4, 0.3, 0.6\n*ELASTIC SURFACE\n 6E4, 0.3, 0.6\n", [(14, 2)]),
        ("*RIGID SURFACE\n 0.3, 0.6\n*RIGID SURFACE\n 0.3, 0.5\n*RIGID SURFACE\n 0.3, 0.4\n", [(14, 2), (16, 2)]),
        ("*RIGID SURFACE\n 0.3, 0.6\n*ELASTIC SURFACE\n 6E4, 0.3, 0.6\n", []),  # SBD002
        ("*ELASTIC SURFACE\n 5E4, 0.3, 0.6\n*EMBEDMENT\n SET=ALL\n 0.0, 0.0\n 0.5, 4000.0\n", []),
        ("*ELASTIC SURFACE\n 5E4, 0.3, 0.6\n", []),
    ],
)
def test_a_legacy_surface_that_is_replaced(lines: str, expected: list[tuple[int, int]]) -> None:
    assert found(PIPE + lines, "SBD025") == [("SBD025", *place) for place in expected]


# ------------------------------------------------------------------------------------------------------------ profiles


@pytest.mark.parametrize(
    ("name", "content", "expected"),
    [
        ("shelf.fcsbd", b"\x00", [("SBD023", "info")]),
        ("shelf.fcsbd", None, [("REF015", "warning")]),
        ("shelf.txt", b"Y, X\n", [("SBD023", "warning")]),
        ("shelf.txt", b"0, 0\n0, 1\n", [("SBD023", "error")]),
        ("shelf.txt", None, [("REF015", "warning")]),
    ],
)
def test_a_profile_has_one_finding(
    name: str, content: bytes | None, expected: list[tuple[str, str]], tmp_path: Path
) -> None:
    if content is not None:
        (tmp_path / name).write_bytes(content)
    text = PIPE + LAW + f"*SEABED PROFILE\n TYPE=2D\n FILE={name}\n"
    chosen = select(["SBD023", "REF015"])
    for folder, told in ((tmp_path, expected), (None, [("SBD023", "info")] if name.endswith("fcsbd") else [])):
        findings = lint_bytes(text.encode(), "deck.keyxm", chosen, folder=folder)
        assert [(one.code, str(one.severity)) for one in findings] == told


def test_nodes_beyond_a_steep_profile_are_deep() -> None:
    """The bed rises by 12 from Y = -1 to 0 and is level from there on: nodes at Y > 0 lie 12.05 below it."""
    steep = "*ELASTIC SURFACE\n 50000.0\n -1.0, 0.0\n 0.0, 12.0\n"
    assert len(found(PIPE + steep, "SBD022")) == 1
    assert found(PIPE + steep.replace("0.0, 12.0", "0.0, 1.1"), "SBD022") == []  # 1.15 of 1.25


# ------------------------------------------------------------------------------------------- what lies where it should

INNER = "*ELEMENT SETS\n SET=Outer\n GEN=1, 5\n SET=Inner\n GEN=6, 10\n"
OUTER_LAW = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=Outer\n STIFFNESS=50000.0\n"


@pytest.mark.parametrize(
    ("pipes", "expected"), [("", 1), ("*PIP SECTION\n OUTER=Outer, INNER=Inner\n", 0), ("*PIP SECTION\n INNER=X\n", 1)]
)
def test_the_seabed_does_not_touch_an_inner_pipe(pipes: str, expected: int) -> None:
    assert len(found(PIPE + INNER + pipes + OUTER_LAW, "SBD006")) == expected


def test_a_stiffness_of_zero_supports_no_element_on_the_seabed() -> None:
    zero = LAW.replace("60000.0", "0.0")
    assert [line for _, line, _ in found(PIPE + zero, "SBD006")] == [(PIPE + zero).count("\n")]
    assert found(PIPE.replace("-0.05", "1.0") + zero, "SBD006") == []


def test_the_lines_of_a_law_under_another_keyword_are_reported_there() -> None:
    law = "*HYDRODYNAMIC SETS\n SET=ALL, TYPE=CONSTANT\n 1.2, 0.0, 2.0, 1.0, 0.0\n" + LAW.partition("\n")[2]
    assert [line for _, line, _ in found(PIPE + law, "SBD006")] == [PIPE.count("\n") + 4]
    assert found(PIPE + law.replace("HYDRODYNAMIC SETS", "UNHEARD OF"), "SBD006")[0][1] != PIPE.count("\n") + 4


# ------------------------------------------------------------------------------------------- datum at the sea surface


def riser(*nodes: str) -> str:
    """A line of nodes given by their coordinates, in water 420 deep."""
    rows = "".join(f" {number}, {place}\n" for number, place in enumerate(nodes, 1))
    elements = "".join(f" {number}, {number}, {number + 1}\n" for number in range(1, len(nodes)))
    return f"$MODEL\n*NODE\n{rows}*ELEMENT\n{elements}{decks.STEEL}" + LAW + OCEAN


LAID = tuple(f"{10.0 * number}, 0.0, -420.02" for number in range(4))


@pytest.mark.parametrize(
    ("nodes", "expected"),
    [
        ((*LAID, "90.0, 0.0, -200.0", "120.0, 0.0, -5.0"), "minus the water depth"),
        (("0.01, 0.0, -400.0", *LAID[2:], "90.0, 0.0, -200.0"), ""),  # the lowest are two
        (("0.01, 0.0, -400.0", "0.0, 9.0, -350.0", *LAID[1:], "90.0, 0.0, -200.0"), ""),  # two lie at X = 0
        ((*LAID, "90.0, 0.0, -420.0"), ""),  # the line does not rise along Z
        ((*(place.replace("420.02", "500.0") for place in LAID), "90.0, 0.0, -5.0"), ""),
        (tuple(f"-0.02, {10.0 * number}, -420.0" for number in range(4)), ""),  # a pipe on the seabed, 420 aside
    ],
)
def test_heights_above_the_sea_surface(nodes: tuple[str, ...], expected: str) -> None:
    told = messages(riser(*nodes), "GEO005")
    assert len(told) == bool(expected)
    assert all(expected in message for message in told)


def test_x_above_the_sea_surface_names_the_depth() -> None:
    (message,) = messages(line("-420.05, 0.0", "-420.05, 100.0"), "SBD022")
    assert message.endswith("correct the datum of X, which is 0 at the mudline and not at the sea surface: add 420")
    (message,) = messages(line("-300.0, 0.0", "-300.0, 100.0"), "SBD022")
    assert message.endswith("correct the datum of X")
