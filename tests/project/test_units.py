"""Unit systems: names and sizes of units, by their dimensions."""

from __future__ import annotations

import pytest

from mudline.basics.units import FOOT, POUND, TONNES, UNITS


def test_a_pound_is_the_weight_of_its_mass_in_standard_gravity() -> None:
    assert pytest.approx(0.45359237 * 9.80665, rel=1e-15) == POUND
    assert UNITS["imperial"].mass == POUND / FOOT  # a slug: lbf s2/ft


@pytest.mark.parametrize("dimension", ["F", "L", "M", "F/L", "F/L2", "FL2", "M/L3", "1/L", "L/T2", "FT/L2"])
def test_sizes_are_consistent(dimension: str) -> None:
    """In a consistent system F = M L / T2, so that every power of the three units is that of its parts."""
    powers = {"F": 0, "L": 0, "M": 0}
    for sign, side in zip((1, -1), dimension.split("/"), strict=False):
        for at, letter in enumerate(side):
            if letter in powers:
                power = side[at + 1 : at + 2]
                powers[letter] += sign * (int(power) if power.isdigit() else 1)
    for system in (*UNITS.values(), TONNES):
        size = system.force ** powers["F"] * system.length ** powers["L"] * system.mass ** powers["M"]
        assert system.size(dimension) == pytest.approx(size, rel=1e-15)
        assert system.force == pytest.approx(system.mass * system.length, rel=1e-15)


@pytest.mark.parametrize(
    ("dimension", "texts"),
    [
        ("F/L2", ("N/m2", "lbf/ft2", "force/length2")),
        ("FL2", ("N m2", "lbf ft2", "force length2")),
        ("1/L", ("1/m", "1/ft", "1/length")),
        ("L/T2", ("m/s2", "ft/s2", "length/time2")),
        ("deg/L", ("deg/m", "deg/ft", "deg/length")),
        ("Hz", ("Hz", "Hz", "Hz")),
    ],
)
def test_names_of_units(dimension: str, texts: tuple[str, ...]) -> None:
    assert tuple(system.text(dimension) for system in UNITS.values()) == texts
    assert tuple(system.unit(dimension) for system in UNITS.values()) == (*texts[:2], "")


def test_a_unit_behind_a_number() -> None:
    assert [system.behind("F/L") for system in UNITS.values()] == [" N/m", " lbf/ft", ""]
    assert [system.behind("deg") for system in UNITS.values()] == [" degrees"] * 3
    assert [system.behind(none) for system in UNITS.values() for none in ("", "-")] == [""] * 6
    assert TONNES.behind("M/L3") == " t/m3"


def test_what_is_no_dimension_has_no_size() -> None:
    assert [system.size(each) for system in UNITS.values() for each in ("", "-", "%", "Hz", "deg", "F L")] == [1.0] * 18


def test_units_of_another_name_are_not_known() -> None:
    assert UNITS["SI"] is UNITS["user"]
    assert "SI" not in UNITS
