"""UNT001 to UNT003: gravity, forces and friction of other units."""

from __future__ import annotations

import pytest

from mudline.deck.loading import load_bytes
from tests.linting.findings import ON_CLAY, PIPE, PROPERTIES, curve, found, in_units


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
    text += PROPERTIES + " STIFFNESS=499.0\n"
    assert in_units(text, "keyxm", "UNT002") == [(14, 2), (20, 12)]
    assert in_units(text, "keyxi", "UNT002") == in_units(text, "keyx", "UNT002") == []
    kips = text.replace("1, 9.9", "1, 0.69").replace("=499.0", "=9.99")
    assert in_units(kips, "keyxi", "UNT002") == [(14, 2), (20, 12)]
    assert in_units(kips, "keyx", "UNT002") == []
    at_limits = text.replace("1, 9.9", "1, 0.7").replace("=499.0", "=10.0")
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
