"""Rules over friction, slopes and families: thresholds, both families, and where they find nothing."""

from __future__ import annotations

import pytest

from mudline.linting.engine import lint_bytes
from mudline.linting.registry import select
from tests.lint.findings import PIPE, PROPERTIES, found

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


def test_a_steep_slope_is_a_warning_and_a_vertical_one_an_error() -> None:
    for slope, severity in ((45.1, "warning"), (-89.9, "warning"), (90.0, "error")):
        text = f"{PIPE}*SEABED PROFILE\n TYPE=SLOPING\n SLOPE={slope}\n"
        assert [one.severity for one in lint_bytes(text.encode(), "deck.keyxm", select(["SBD012"]))] == [severity]


def test_extension_keywords_are_faults_of_decks_for_flexcom_only() -> None:
    text = f"{PIPE}{PROPERTIES}*SEABED UNLOADING\n SET=ALL\n STIFFNESS=5\n"
    chosen = select(["SBD018"])
    assert lint_bytes(text.encode(), "deck.keyxm", chosen) == []
    assert [one.line for one in lint_bytes(text.encode(), "deck.keyxm", chosen, dialect="flexcom")] == [16]
