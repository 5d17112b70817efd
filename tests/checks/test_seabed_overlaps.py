"""SBD008 and SBD021: sets that overlap, and nodes held in one direction on a sloping rigid seabed."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from tests.checks.findings import PIPE, PROPERTIES, RESTART, found, messages
from tests.helpers.builders.decks import CLAY

SETS = "*ELEMENT SETS\n SET=A\n GEN=1, 4\n SET=B\n GEN=3, 6\n SET=C\n GEN=3, 4\n SET=D\n GEN=1, 4\n"
MODEL = PIPE + SETS + "*SEABED PROPERTIES\n TYPE=ELASTIC\n"
CURVES = PIPE + SETS + "*ELASTIC SURFACE\n 5000\n*EMBEDMENT\n"


def soil(name: str, stiffness: int = 5000, more: str = "") -> str:
    return f" SET={name}\n STIFFNESS={stiffness}\n{more}"


def points(name: str, force: int) -> str:
    return f" SET={name}\n 0, 0\n 1, {force}\n"


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        (soil("ALL") + soil("A", 6000) + soil("C", 7000), 0),  # each refines the one before
        (soil("ALL") + soil("A") + soil("B"), 0),  # an overlap of equals changes nothing
        (soil("ALL") + soil("A", 6000) + soil("B", 7000), 1),
        (soil("A") + soil("B", 5000, " FRICTION=0.3, 0.6\n"), 1),
        (soil("C") + soil("A", 6000), 1),  # the larger one behind the smaller one
        (soil("A") + soil("D", 6000), 1),  # the same elements
        (soil("A") + soil("A"), 1),
        (soil("A") + "*SEABED PROPERTIES\n" + soil("ALL"), 1),
        (soil("A") + "*SEABED PROPERTIES\n SET=B\n STIFFNESS=6000\n", 1),
        (soil("Nowhere") + soil("A"), 0),
    ],
)
def test_definitions_of_which_one_is_lost(lines: str, expected: int) -> None:
    assert len(found(MODEL + lines, "SBD008")) == expected


@pytest.mark.parametrize(("force", "expected"), [(100, 0), (200, 1)])
def test_curves_of_the_same_points_give_the_same(force: int, expected: int) -> None:
    curves = "".join(f" CURVE={name}\n 0, 0\n 1, {force}\n" for name, force in (("one", 100), ("other", force)))
    text = PIPE + SETS + "*SEABED STIFFNESS\n" + curves + "*SEABED PROPERTIES\n TYPE=ELASTIC\n"
    text += " SET=A\n STIFFNESS=one\n SET=B\n STIFFNESS=other\n"
    assert len(found(text, "SBD008")) == expected
    assert len(found(text.replace("STIFFNESS=other", "STIFFNESS=5000"), "SBD008")) == 1


def test_a_lost_definition_is_told_at_the_later_set() -> None:
    text = MODEL + soil("Nowhere") + soil("A", 6000) + soil("ALL")
    assert found(text, "SBD008") == [("SBD008", text.count("\n") - 1, 6)]
    assert messages(text, "SBD008")[0] == (
        "the earlier definition of SET='A' is overridden by this one for all its elements: put the larger set first, "
        "or remove one"
    )
    assert "the earlier definition of this set" in messages(MODEL + soil("A") + soil("A"), "SBD008")[0]
    assert "4 elements" not in messages(MODEL + soil("A") + soil("B", 6000), "SBD008")[0]
    assert "of SET='A' for 2 elements (first: 3):" in messages(MODEL + soil("A") + soil("B", 6000), "SBD008")[0]


def test_sets_of_unknown_elements_are_compared_by_name() -> None:
    for lines, expected in ((soil("ALL") + soil("A"), 0), (soil("A") + soil("A"), 1), (soil("ALL") + soil("all"), 1)):
        laid = "$MODEL\n*LINES\n LINE=A\n" + "*SEABED PROPERTIES\n TYPE=ELASTIC\n" + lines
        assert len(found(laid, "SBD008")) == expected


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        (points("A", 10) + points("B", 20), 1),
        (points("ALL", 10) + points("A", 20), 1),
        (points("A", 10) + points("B", 10), 0),
        (points("A", 10), 0),
        (points("A", 10) + points("B", 20) + "*SEABED PROPERTIES\n TYPE=ELASTIC\n" + soil("C"), 1),
        (points("A", 10) + points("B", 20) + CLAY + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=C\n STIFFNESS=clay\n", 0),
    ],
)
def test_curves_of_embedment_may_not_overlap(lines: str, expected: int) -> None:
    findings = lint_bytes((CURVES + lines).encode(), "deck.keyxm", select(["SBD008"]))
    assert [str(one.severity) for one in findings] == ["warning"] * expected


RIGID = "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"
SLOPE = "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=0.001\n"
HELD = "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n"
PROFILE = "*RIGID SURFACE\n 0.3, 0.6\n 0.0, 0.0\n 50.0, 0.0\n 100.0, -0.1\n"


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        (RIGID + SLOPE + HELD + " 1, 2\n", 1),
        (RIGID + SLOPE + HELD + " 1, 1, 0.5\n", 1),
        (RIGID + SLOPE + HELD + " 1, 2\n 1, 1\n", 0),
        (RIGID + SLOPE + HELD + " 1, 3\n 99, 2\n {End}, 2\n", 0),
        (RIGID + SLOPE + HELD + " GEN=1, 5\n", 0),
        (RIGID + SLOPE + HELD + " GEN=1, 5, 2\n", 1),
        (RIGID + SLOPE + HELD + " GEN=1, 5, 2, 2, 0.0\n", 1),
        (RIGID + SLOPE + HELD + " GEN=1, 5, 0, 2, 0.0\n GEN=1, 5, 1, 3, 0.0\n", 0),
        (RIGID + SLOPE + HELD + " GEN=1, 5, 2\n GEN=1, 5, 1\n", 0),
        (RIGID + SLOPE + HELD + " 1, 2\n" + RESTART, 0),
        (RIGID + HELD + " 1, 2\n", 0),
        (PROPERTIES + " STIFFNESS=5000\n" + SLOPE + HELD + " 1, 2\n", 0),
        (PROFILE + HELD + " 1, 2\n", 0),
        (PROFILE + HELD + " 11, 2\n", 1),
        (RIGID + "*SEABED PROFILE\n TYPE=2D\n FILE=nowhere.txt\n" + HELD + " 11, 2\n", 0),
        (RIGID + "*SEABED PROFILE\n DIRECTION=north\n" + HELD + " 1, 2\n", 0),  # nobody knows its direction
    ],
)
def test_one_of_two_degrees_of_freedom(lines: str, expected: int) -> None:
    assert len(found(PIPE + lines, "SBD021")) == expected


def test_nodes_above_the_bed_are_free_to_be_held() -> None:
    assert found(PIPE.replace("-0.05", "5.0") + RIGID + SLOPE + HELD + " 1, 2\n", "SBD021") == []


def test_nodes_that_are_held_alone_are_counted() -> None:
    told = messages(PIPE + RIGID + SLOPE + HELD + " GEN=1, 5, 2\n 3, 1\n", "SBD021")
    assert len(told) == 1
    assert told[0] == (
        "of degrees of freedom 1 and 2 only 2 is constrained at 4 nodes (first: 1) on a sloping rigid seabed, and both "
        "are held there: give both, or remove this one"
    )


LINEAR = PROPERTIES + " STIFFNESS=5000\n"
PLANES = "*SEABED PLANES\n PLANE=a\n POINT={0}, 0, 0\n SLOPE=0\n BOUNDS=-1, 1000, -1, 1\n"


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        (LINEAR + PLANES.format(0.0), 0),
        (LINEAR + PLANES.format(30.0), 1),
        (LINEAR + PLANES.format(30.0).replace("-1, 1000", "500, 1000"), 0),
        (LINEAR + PLANES.format(30.0).replace("SLOPE=0", "SLOPE=95"), 0),
        (LINEAR + PLANES.format(30.0) + SLOPE, 0),
        ("*ELASTIC SURFACE\n 5000\n 0.0, 0.0\n 100.0, -1.0\n", 0),
        ("*ELASTIC SURFACE\n 5000\n 100.0, 30.0\n 0.0, 10.0\n", 1),
        ("*ELASTIC SURFACE\n 5000\n 5.0\n", 1),
    ],
)
def test_deep_nodes_below_any_bed(lines: str, expected: int) -> None:
    assert len(found(PIPE + lines, "SBD022")) == expected


def test_five_times_a_diameter_may_overflow() -> None:
    huge = PIPE.replace("0.25, 0.22", "1.0E308, 0.22").replace("-0.05", "-1.0E100")
    assert found(huge + PROPERTIES + " STIFFNESS=5000.0\n", "SBD022") == []


@pytest.mark.parametrize(
    ("type_", "points_", "expected"),
    [
        ("2D", "0.0, 30.0\n100.0, 30.0\n", 1),
        ("2D", "0.0, 30.0\n0.0, 0.0\n", 0),  # a wall: the depth is not known
        ("2D\n INTERPOLATION=CUBIC SPLINE", "0.0, 30.0\n100.0, 30.0\n", 0),
        ("3D", "30.0, 0.0, 0.0\n31.0, 100.0, 0.0\n30.0, 0.0, 9.0\n", 1),
        ("3D", "30.0, 0.0, 0.0\n-1.0, 100.0, 0.0\n30.0, 0.0, 9.0\n", 0),
    ],
)
def test_deep_nodes_below_the_points_of_a_file(tmp_path: Path, type_: str, points_: str, expected: int) -> None:
    (tmp_path / "bed.txt").write_text(points_, encoding="ascii")
    text = PIPE + LINEAR + f"*SEABED PROFILE\n TYPE={type_}\n FILE=bed.txt\n"
    findings = lint_bytes(text.encode(), "deck.keyxm", select(["SBD022"]), folder=tmp_path)
    assert len(findings) == expected


FRICTION = "*SEABED FRICTION\n SET={0}\n COEFFICIENTS=0.3, 0.6\n STIFFNESS=5000\n"
SPRINGS = " FRICTION=0.0, 0.6, , 0.000001, , 500.0\n LATERAL=5.0\n"


@pytest.mark.parametrize("code", ["SBD007", "SBD014"])
@pytest.mark.parametrize(("replacing", "expected"), [("ALL", 0), ("A", 1), ("C", 1)])
def test_friction_that_is_replaced_is_not_told(code: str, replacing: str, expected: int) -> None:
    text = PIPE + SETS + LINEAR + SPRINGS + FRICTION.format(replacing)
    assert len(found(text, code)) == expected


def test_friction_is_replaced_set_by_set_or_by_name() -> None:
    text = MODEL + " SET=A\n STIFFNESS=5000\n" + SPRINGS
    assert found(text + FRICTION.format("A"), "SBD007", "SBD014") == []
    assert len(found(text + FRICTION.format("C"), "SBD007")) == 1
    laid = "$MODEL\n*LINES\n LINE=Pipe\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=Pipe\n STIFFNESS=5000\n" + SPRINGS
    assert found(laid + FRICTION.format("Pipe"), "SBD007") == []
    legacy = "$MODEL\n*LINES\n LINE=Pipe\n*ELASTIC SURFACE\n 5000, 0.3, 0.6, 5.0, , , 3.0, , , 0.1\n"
    assert len(found(legacy + FRICTION.format("Pipe"), "SBD007", "SBD020")) == 2
    assert found(legacy + FRICTION.format("ALL"), "SBD007", "SBD020") == []


def test_short_mobilisation_of_friction_that_acts() -> None:
    short = LINEAR + " FRICTION=0.3, 0.6, 0.1, 0.000001\n"
    assert len(found(PIPE + SETS + short, "SBD019")) == 1
    assert len(found(PIPE + SETS + short + FRICTION.format("A"), "SBD019")) == 1
    assert found(PIPE + SETS + short + FRICTION.format("ALL"), "SBD019") == []
    assert found(PIPE + short + " LATERAL=5.0\n", "SBD019") == []


@pytest.mark.parametrize("section", ["LOAD CASE", "MODES"])
@pytest.mark.parametrize(
    ("friction", "expected"),
    [(" FRICTION=0.3, 0.6\n", 0), (" FRICTION=0.3, 0.0\n", 1), ("", 2), (" FRICTION=x, 0.0\n", 1)],
)
def test_stiffness_of_a_load_case_needs_a_coefficient(section: str, friction: str, expected: int) -> None:
    text = PIPE + LINEAR + friction + f"${section}\n*FRICTION\n 500.0, 250.0\n"
    assert len(found(text, "SBD014")) == expected


def test_friction_of_a_load_case_beside_an_extension_a_restart_or_no_seabed() -> None:
    load = "$LOAD CASE\n*FRICTION\n 500.0, 250.0\n"
    assert found(PIPE + LINEAR + FRICTION.format("ALL") + load, "SBD014") == []
    assert found(PIPE + LINEAR + load + "*RESTART\n LAST=static\n", "SBD014") == []
    assert found(PIPE + load, "SBD014") == []
