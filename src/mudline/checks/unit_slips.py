"""Units that a deck has, and those that people slip into."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

from mudline.checks.context import LintContext
from mudline.language.keywords.usual import Usual
from mudline.model.scene.deck_values import FOOT, POUND, number

_INCH = FOOT / 12
_POUND_MASS = 0.45359237
_GRAVITY = 9.80665
_SLUG = POUND / FOOT
_KIP = 1e3 * POUND
_GALLON = 231 * _INCH**3
_KNOT = 1852 / 3600

SLIPS = {
    "L": {"mm": 1e-3, "inches": _INCH, "ft": FOOT, "m": 1.0, "cm": 1e-2},
    "F": {"N": 1.0, "kN": 1e3, "MN": 1e6, "lbf": POUND, "kip": _KIP, "tonnes": 1e3 * _GRAVITY},
    "F/L": {"N/m": 1.0, "kN/m": 1e3, "MN/m": 1e6, "lbf/ft": POUND / FOOT, "kip/ft": _KIP / FOOT},
    "F/L2": {
        "N/m2": 1.0,
        "kPa (kN/m2)": 1e3,
        "MPa": 1e6,
        "GPa": 1e9,
        "lbf/ft2": POUND / FOOT**2,
        "psi": POUND / _INCH**2,
        "ksi": _KIP / _INCH**2,
        "bar": 1e5,
    },
    "FL": {"N m": 1.0, "kN m": 1e3, "MN m": 1e6, "lbf ft": POUND * FOOT, "kip ft": _KIP * FOOT},
    "FL2": {
        "N m2": 1.0,
        "kN m2": 1e3,
        "MN m2": 1e6,
        "N mm2": 1e-6,
        "lbf ft2": POUND * FOOT**2,
        "lbf in2": POUND * _INCH**2,
        "kip ft2": _KIP * FOOT**2,
    },
    "M": {"kg": 1.0, "t": 1e3, "lb": _POUND_MASS, "slug": _SLUG},
    "M/L": {"kg/m": 1.0, "t/m": 1e3, "lb/ft": _POUND_MASS / FOOT, "slug/ft": _SLUG / FOOT},
    "M/L3": {
        "kg/m3": 1.0,
        "t/m3 or g/cm3": 1e3,
        "slug/ft3": _SLUG / FOOT**3,
        "lb/ft3": _POUND_MASS / FOOT**3,
        "lb/gal": _POUND_MASS / _GALLON,
        "lb/in3": _POUND_MASS / _INCH**3,
        "t/mm3": 1e12,
        "N/m3": 1 / _GRAVITY,
        "kN/m3": 1e3 / _GRAVITY,
    },
    "L/T": {"m/s": 1.0, "cm/s": 1e-2, "knots": _KNOT, "ft/s": FOOT},
    "L/T2": {"m/s2": 1.0, "ft/s2": FOOT, "cm/s2": 1e-2},
    "L2/T": {"m2/s": 1.0, "mm2/s": 1e-6, "ft2/s": FOOT**2},
    "T": {"s": 1.0, "ms": 1e-3, "minutes": 60.0, "hours": 3600.0},
    "deg": {"degrees": 1.0, "radians": 57.29577951308232},
}
"""The names of units by what they measure, with their size in SI (angles in degrees); specific weights as densities."""


class Units(NamedTuple):
    """The units of a deck: the name that `unit_text` knows, and sizes in SI; those that are not `known` have 1."""

    name: str
    length: float = 1.0
    force: float = 1.0
    mass: float = 1.0
    known: bool = True

    def compares(self, unit: str) -> bool:
        """Whether numbers of a unit can be compared with those in SI."""
        return self.known or unit in ("", "-", "%", "deg", "T", "Hz")

    @lru_cache(256)  # noqa: B019 - there are few units
    def size(self, unit: str) -> float:
        """A unit of a field in SI; 1 of what is no dimension."""
        if not re.fullmatch(r"(?:[FLMT]\d?|1|/)+", unit):
            return 1.0
        sizes = {"F": self.force, "L": self.length, "M": self.mass, "T": 1.0}
        found = 1.0
        for side, sign in zip(unit.split("/"), (1, -1), strict=False):
            for letter, power in re.findall(r"([FLMT])(\d?)", side):
                found *= sizes[letter] ** (sign * int(power or 1))
        return found

    def behind(self, unit: str) -> str:
        """A unit of a field as it is written behind a number, with a space; "" where there is none that is known."""
        from mudline.language.keywords.format import unit_text  # noqa: PLC0415 - only for a finding

        if unit == "deg":
            return " degrees"
        return f" {unit_text(unit, self.name)}" if unit not in ("", "-") and self.known else ""


_KNOWN = {
    "metric": Units("metric"),
    "imperial": Units("imperial", FOOT, POUND, _SLUG),
}
_TONNES = Units("tonnes", force=1e3, mass=1e3)
_LIGHT = (0.9, 1.3)
"""Densities of water in t/m3."""


def units_of(context: LintContext) -> Units:
    """The units of a deck; user units are those of tonnes and kilonewtons where the last *OCEAN says so."""
    if known := _KNOWN.get(context.scene.units):
        return known
    for _, ocean in reversed(context.blocks("OCEAN")):
        density, gravity = number(ocean, "density"), number(ocean, "gravity")
        if _LIGHT[0] <= density <= _LIGHT[1] and abs(gravity - _GRAVITY) < 0.02 * _GRAVITY:
            return _TONNES
    return Units("user", known=False)


_STRICT = 1.2
"""Factor within which a number in another unit is what the field mostly holds."""
_POINTS = (0.1, 10.0, 0.01, 100.0, 0.001, 1000.0)
"""What a decimal point that is lost or misplaced does."""
_MOST = 3
"""Units that are proposed for a number of which it is not known what it mostly is."""
Measured = Callable[[float], float]
"""The quantity that is compared, of a number in SI."""


def is_placeholder(value: float) -> bool:
    """Whether a value is 0 or a power of ten, as people write for a property that does not matter."""
    if not 0.0 < value < math.inf:
        return True
    exponent = math.log10(value)
    return abs(exponent - round(exponent)) < 1e-9


def meant_unit(
    usual: Usual, value: float, unit: str, units: Units, measured: Measured = float, *, strict: bool = False
) -> str:
    """The other unit in which a number (as the deck has it) is what the field mostly holds, or "".

    With `strict` it is within 20 % of that.
    """
    away: dict[str, float] = {}
    for name, size in SLIPS.get(unit, {}).items():
        quantity = measured(value * size)
        if abs(size / units.size(unit) - 1.0) > 1e-3 and quantity / usual.typical > 0.0:
            away[name] = abs(math.log(quantity / usual.typical))
    nearest = min(away, key=away.__getitem__, default="")
    if nearest and away[nearest] <= math.log(min(_STRICT, usual.within)):
        return nearest
    within = 0.0 if strict else math.log(usual.within)
    return next((name for name, distance in away.items() if distance <= within), "")


def likely_slips(usual: Usual, value: float, unit: str, units: Units, measured: Measured = float) -> str:
    """The other units in which a number (as the deck has it) would be usual, in words; "" for none, or too many."""
    own = units.size(unit)
    known = SLIPS.get(unit, {}) if math.isnan(usual.typical) else {}
    found = [name for name, size in known.items() if size != own and usual.holds(measured(value * size))]
    return " or ".join(found[:_MOST])


def lacks_point(usual: Usual, value: float, measured: Measured = float) -> bool:
    """Whether a number (in SI) would be usual with its decimal point elsewhere."""
    quantities = [measured(value * factor) for factor in _POINTS]
    if math.isnan(usual.typical):
        return any(map(usual.holds, quantities))
    return any(usual.typical / _STRICT <= each <= usual.typical * _STRICT for each in quantities)
