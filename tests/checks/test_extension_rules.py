"""Rules over extension keywords: combinations, units, and where they find nothing."""

from __future__ import annotations

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from tests.checks.findings import CLAY, PIPE, PROPERTIES, RESTART, found

LINEAR = PROPERTIES + " STIFFNESS=5000\n"
UNLOADING = "*SEABED UNLOADING\n SET=ALL\n STIFFNESS=9000\n"
SUCTION = "*SEABED SUCTION\n SET=ALL\n"
OCEAN = "*OCEAN\n 500, 1025, 9.81\n"
HEAVY_WATER = "*OCEAN\n 500, 9000, 9.81\n"
FLEXIBLE = "*GEOMETRIC SETS\n OPTION=FLEXIBLE\n SET=ALL\n 1E4, 1E4, 1E6, 1E8, 92.0, 0.9, 0.2, 0.3, 0.3, 0.3\n"
AREA = "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.25, 0.22, 7850.0, 0.001\n"
CHAIN = "*GEOMETRIC SETS\n OPTION=MOORING\n SET=ALL\n 1E8, 200.0, 0.1\n"
PLANE = "*SEABED PLANES\n PLANE=a\n POINT=0, 0, 0\n SLOPE=0\n"
PULLING = "*SEABED STIFFNESS\n CURVE=c\n 0, 0\n 1, -5\n" + PROPERTIES + " STIFFNESS=c\n"
SOIL = "*SEABED SOIL\n SET=ALL\n STRENGTH=5000, 1500\n"
SPRING = "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0.3, 0.5\n STIFFNESS=5\n"
EXT003 = select(["EXT003"])
TRENCH = "*SEABED TRENCH\n SET=ALL\n GEOMETRY=0.5, 1.0, 3.0\n PEAK=2000\n"


@pytest.mark.parametrize(
    ("code", "lines", "expected"),
    [
        ("EXT001", "*ELASTIC SURFACE\n 100\n" + UNLOADING, 0),
        ("EXT001", UNLOADING, 1),
        ("EXT001", "*RIGID SURFACE\n 0.3\n" + UNLOADING + TRENCH, 1),
        ("EXT001", "*SEABED PROPERTIES\n SET=ALL\n" + UNLOADING, 0),
        ("EXT002", "*ELASTIC SURFACE\n 100\n 2.0\n*SEABED PLANES\n PLANE=a\n POINT=0, 0, 0\n SLOPE=0\n", 1),
        ("EXT002", "*ELASTIC SURFACE\n 100\n*SEABED PLANES\n PLANE=a\n POINT=0, 0, 0\n SLOPE=0\n", 0),
        ("EXT003", LINEAR + TRENCH, 1),
        ("EXT003", LINEAR + TRENCH + RESTART, 1),
        ("EXT003", LINEAR + " FRICTION=0.3, 0.5\n" + TRENCH, 0),
        ("EXT003", LINEAR + "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=1, 1\n STIFFNESS=5\n" + TRENCH, 0),
        ("EXT003", LINEAR + "*SEABED FRICTION\n SET=SCR\n COEFFICIENTS=1, 1\n STIFFNESS=5\n" + TRENCH, 0),
        ("EXT004", SUCTION + " CUTOFF=0.01, 0.99\n", 0),
        ("EXT004", SUCTION + " CUTOFF=0.009, 0.99\n", 1),
        ("EXT004", SUCTION + " CUTOFF=0.2, =[unknown]\n", 0),
        ("EXT005", SUCTION, 1),
        ("EXT005", SUCTION + " COHESION=x\n", 0),
        ("EXT005", SUCTION + " COHESION=5000\n FORCE=1, 1\n", 0),
        ("EXT006", LINEAR + " SUCTION=0\n" + SUCTION, 0),
        ("EXT006", "*ELASTIC SURFACE\n 100, , , , 50\n" + SUCTION, 1),
        ("EXT006", "*SEABED STIFFNESS\n CURVE=c\n 0, 0\n 1, -5\n" + PROPERTIES + " STIFFNESS=c\n" + SUCTION, 1),
        ("EXT006", "*SEABED STIFFNESS\n" + CLAY + PROPERTIES + " STIFFNESS=Clay\n" + SUCTION, 0),
        ("EXT006", PULLING + SUCTION + "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=50\n", 0),
        ("EXT007", "*SEABED PLANES\n PLANE=a\n POINT=0, 0, 0\n", 1),
        ("EXT007", "*SEABED PLANES\n PLANE=a\n POINT=0, 0, 0\n SLOPE=x\n", 0),
        ("EXT007", "*SEABED PLANES\n PLANE=a\n POINT=0, 0, 0\n SLOPE=-90\n", 1),
        ("EXT007", PLANE + " BOUNDS=50.0, 50.0\n", 1),
        ("EXT007", PLANE + " BOUNDS=, , 10.0, 10.0\n", 1),
        ("EXT007", PLANE + " BOUNDS=, 50.0, 50.0\n", 0),
        ("EXT007", PLANE + PLANE[PLANE.index("\n") + 1 :].replace("=a", "=A"), 1),
        ("EXT007", PLANE + PLANE.replace("=a", "=A"), 1),
        ("EXT007", PLANE + PLANE.replace("=a", "=b"), 0),
        ("EXT007", PLANE + PLANE.replace("=a", "="), 0),
        ("EXT008", LINEAR + UNLOADING, 0),
        ("EXT008", "*SEABED STIFFNESS\n" + CLAY + PROPERTIES + " STIFFNESS=Clay\n" + UNLOADING, 1),
        ("EXT008", PROPERTIES + " STIFFNESS=9999\n" + UNLOADING, 1),
        ("EXT008", PROPERTIES + " STIFFNESS==[unknown]\n" + UNLOADING, 0),
        ("EXT008", PROPERTIES + " STIFFNESS=9999\n*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=5\n" + UNLOADING, 0),
        ("EXT009", LINEAR + UNLOADING + "*SEABED CONTACT\n SET=ALL\n", 0),
        ("EXT010", LINEAR + SOIL, 0),
        ("EXT010", LINEAR + SOIL + UNLOADING, 1),
        ("EXT010", LINEAR + SOIL + SUCTION + " COHESION=5000\n", 1),
        ("EXT010", LINEAR + SOIL + "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=50\n", 1),
        ("EXT010", LINEAR + SOIL + "*SEABED CONTACT\n SET=ALL\n SMOOTHING=0.01\n", 0),
        ("EXT010", "*SEABED STIFFNESS\n" + CLAY + PROPERTIES + " STIFFNESS=Clay\n" + SOIL, 1),
        ("EXT011", LINEAR + SOIL + " STIFFNESS=0\n BEARING=0, 0.25\n SUCTION=-0.1, 0\n", 4),
        ("EXT011", LINEAR + SOIL + " STIFFNESS==[unknown]\n REPENETRATION=0\n SUCTION=0, 1E12\n", 0),
        ("EXT012", LINEAR + SOIL + " STIFFNESS=50\n BEARING=5, 0.3\n SUCTION=1, 1\n", 0),
        ("EXT012", LINEAR + SOIL + " STIFFNESS=49\n BEARING=7.5, 0.31\n SUCTION=1.1, 1\n", 4),
        ("EXT009", OCEAN + LINEAR + UNLOADING + "*SEABED CONTACT\n SET=ALL\n", 1),
        ("EXT009", OCEAN + LINEAR + UNLOADING + "*SEABED CONTACT\n SET=ALL\n SMOOTHING=AUTO\n", 1),
        ("EXT009", LINEAR + UNLOADING + "*SEABED CONTACT\n SET=ALL\n SMOOTHING=0.01\n", 1),
        ("EXT009", LINEAR + UNLOADING + "*SEABED CONTACT\n SET=ALL\n SMOOTHING=0.0\n", 0),
        ("EXT009", OCEAN + AREA + LINEAR + UNLOADING + "*SEABED CONTACT\n SET=ALL\n", 0),
        ("EXT009", HEAVY_WATER + LINEAR + UNLOADING + "*SEABED CONTACT\n SET=ALL\n", 0),
        ("EXT009", OCEAN + FLEXIBLE + LINEAR + UNLOADING + "*SEABED CONTACT\n SET=ALL\n", 1),
        ("EXT009", OCEAN + CHAIN + LINEAR + UNLOADING + "*SEABED CONTACT\n SET=ALL\n", 1),
        ("EXT009", LINEAR + UNLOADING + "*SEABED CONTACT\n SET=ALL\n SMOOTHING=NONE\n", 0),
        ("EXT009", LINEAR + UNLOADING, 0),
    ],
)
def test_findings_of_a_rule(code: str, lines: str, expected: int) -> None:
    assert len(found(PIPE + lines, code)) == expected


@pytest.mark.parametrize(
    ("points", "severity"), [("0, 0\n 1, -5", "error"), ("0, 0\n 1, 5\n 2, 4", "warning"), ("1, -5\n 2, 5", "error")]
)
def test_a_curve_that_pulls_is_an_error_unless_it_does_so_only_where_it_is_extrapolated(
    points: str, severity: str
) -> None:
    deck = PIPE + PULLING.replace("0, 0\n 1, -5", points) + SUCTION + " COHESION=5000\n"
    found_ = lint_bytes(deck.encode(), "deck.keyxm", select(["EXT006"]))
    assert [(str(one.severity), one.blocks) for one in found_] == [(severity, severity == "error")]
    assert "--tension cut" in found_[0].message


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ("", "2:6: MODEL=PEAK needs a resistance: give PEAK="),
        (" MODEL=PEAK\n", "2:6: MODEL=PEAK needs a resistance: give PEAK="),
        (" PEAK=x\n", ""),
        (" PEAK=TABLE\n", "4:7: PEAK=TABLE needs two rows or more"),
        (" PEAK=TABLE\n 0.0, 5.0\n", "4:7: PEAK=TABLE needs two rows or more"),
        (" PEAK=TABLE\n 0.0, 5.0\n 1.0, 5.0\n", ""),
        (" PEAK=TABLE\n -0.1, 5.0\n 1.0, 5.0\n", "5:2: the offset from the centreline is negative"),
        (" PEAK=TABLE\n 0.0, 5.0\n 1.0, 5.0\n 1.0, 6.0\n", "7:2: the offset is not larger than that of the row"),
        (" PEAK=TABLE\n 0.0, 5.0\n 2.0, 5.0\n 1.0, 6.0\n", "7:2: the offset is not larger than that of the row"),
        (" PEAK=TABLE\n 0.0, 5.0\n =[unknown], 5.0\n", ""),
        (" MODEL=WALL\n", ""),
        (" MODEL=WALL\n PEAK=2000\n", "5:7: PEAK= has no effect under MODEL=WALL"),
        (" MODEL=WALL\n PEAK=TABLE\n", "5:7: PEAK= has no effect under MODEL=WALL"),
    ],
)
def test_the_resistance_of_a_trench(lines: str, expected: str) -> None:
    trench = TRENCH.replace(" PEAK=2000\n", lines)
    above = (PIPE + LINEAR + SPRING).count("\n")
    told = [f"{line - above}:{column}: {message}" for line, column, message in placed(LINEAR + SPRING + trench)]
    assert [one[: len(expected)] for one in told] == ([expected] if expected else [])
    severities = [
        str(one.severity) for one in lint_bytes((PIPE + LINEAR + SPRING + trench).encode(), "d.keyxm", EXT003)
    ]
    assert severities == (["warning" if "no effect" in expected else "error"] if expected else [])


@pytest.mark.parametrize(
    ("depth", "friction", "expected"),
    [
        ("1.0", "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=1, 0.99\n STIFFNESS=5\n", 0),
        ("1.0", "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0, 1\n STIFFNESS=5\n", 10),
        ("0.5", "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0, 1\n STIFFNESS=5\n", 0),
        ("2.0", " FRICTION=0.9, 0.5\n", 10),
        ("2.0", " FRICTION=0.9, 0.5\n LATERAL=1\n*SEABED FRICTION\n SET=Left\n COEFFICIENTS=1, 1\n STIFFNESS=5\n", 0),
        ("2.0", " FRICTION=0.9, 0.5\n*SEABED FRICTION\n SET=Two\n COEFFICIENTS=1, 0.4\n STIFFNESS=5\n", 8),
        ("2.0", " FRICTION=0.9, 0.5\n*SEABED FRICTION\n SET=Lost\n COEFFICIENTS=1, 0.4\n STIFFNESS=5\n", 0),
        ("-2.0", " FRICTION=0.9, 0.5\n", 0),
    ],
)
def test_a_wall_that_locks_itself(depth: str, friction: str, expected: int) -> None:
    sets = "*ELEMENT SETS\n SET=Left\n GEN=1, 10\n SET=Two\n GEN=1, 2\n"
    trench = TRENCH.replace("0.5,", f"{depth},").replace("PEAK=2000", "MODEL=WALL")
    told = [message for *_, message in placed(sets + LINEAR + friction + trench) if "locks" in message]
    assert [int(one.partition("itself: ")[2].split()[0]) for one in told] == ([expected] if expected else [])


def placed(lines: str) -> list[tuple[int, int, str]]:
    told = lint_bytes((PIPE + lines).encode(), "deck.keyxm", EXT003)
    return [(one.line, one.column, one.message) for one in told]


def test_an_unloading_stiffness_is_told_once() -> None:
    assert len(found(PIPE + "*OCEAN\n -5, 1025, 9.81\n", "SBD010")) == 1
    lines = PIPE + LINEAR + UNLOADING.replace("9000", "0.0")
    assert [one[0] for one in found(lines, "EXT009", "SBD010")] == ["EXT009"]
    assert [one[0] for one in found(lines + TRENCH.replace("2000", "-1"), "SBD010")] == ["SBD010"]


def test_user_units_need_all_values() -> None:
    for lines, expected in ((" COHESION=5000\n", 2), (" FORCE=1, 1\n DEPTH=1, 1\n REGULARISATION=0.1\n", 0)):
        text = PIPE + LINEAR + SUCTION + lines
        assert len(lint_bytes(text.encode(), "deck.keyx", select(["EXT005"]))) == expected


def test_decks_without_extensions_give_nothing() -> None:
    assert found(PIPE + LINEAR, "EXT") == []
