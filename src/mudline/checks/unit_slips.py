"""Units of a deck, and units that its numbers may be in by mistake."""

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
"""Names of units by the quantity that they measure, with their size in SI (angles in degrees).

Specific weights are listed as densities.
"""


UNITLESS = ("", "-", "%", "deg", "T", "Hz")
"""Units of fields that are the same in every deck."""


class DeckUnits(NamedTuple):
    """Units of a deck: the name that `unit_text` knows, and sizes in SI, which are 1 if the units are not `known`."""

    name: str
    length: float = 1.0
    force: float = 1.0
    mass: float = 1.0
    known: bool = True

    @lru_cache(256)  # noqa: B019 - there are few units
    def size(self, unit: str) -> float:
        """Return a unit of a field in SI; 1 if it is not a dimension."""
        if not re.fullmatch(r"(?:[FLMT]\d?|1|/)+", unit):
            return 1.0
        sizes = {"F": self.force, "L": self.length, "M": self.mass, "T": 1.0}
        product = 1.0
        for side, sign in zip(unit.split("/"), (1, -1), strict=False):
            for letter, power in re.findall(r"([FLMT])(\d?)", side):
                product *= sizes[letter] ** (sign * int(power or 1))
        return product

    def behind(self, unit: str) -> str:
        """Return a unit of a field as it is written after a number, with a space; "" if none is known."""
        from mudline.language.keywords.format import unit_text  # noqa: PLC0415 - only for a finding

        if unit == "deg":
            return " degrees"
        return f" {unit_text(unit, self.name)}" if unit not in ("", "-") and self.known else ""


_KNOWN = {
    "metric": DeckUnits("metric"),
    "imperial": DeckUnits("imperial", FOOT, POUND, _SLUG),
}
_TONNES = DeckUnits("tonnes", force=1e3, mass=1e3)
_LIGHT = (0.9, 1.3)
"""Range of densities of water in t/m3."""


def units_of(context: LintContext) -> DeckUnits:
    """Return the units of a deck; user units are tonnes and kilonewtons if the last *OCEAN shows it."""
    if known := _KNOWN.get(context.scene.units):
        return known
    for _, ocean in reversed(context.blocks("OCEAN")):
        density, gravity = number(ocean, "density"), number(ocean, "gravity")
        if _LIGHT[0] <= density <= _LIGHT[1] and abs(gravity - _GRAVITY) < 0.02 * _GRAVITY:
            return _TONNES
    return DeckUnits("user", known=False)


_STRICT = 1.2
"""Factor within which a number in another unit equals the usual value of its field."""
_POINTS = (0.1, 10.0, 0.01, 100.0, 0.001, 1000.0)
"""Factors of a lost or misplaced decimal point."""
_MOST = 3
"""Number of units that are proposed for a number without a usual value."""
Measured = Callable[[float], float]
"""Compared quantity of a number in SI."""


def is_placeholder(value: float) -> bool:
    """Return True if a value is 0 or a power of ten, as often written for a property that does not matter."""
    if not 0.0 < value < math.inf:
        return True
    exponent = math.log10(value)
    return abs(exponent - round(exponent)) < 1e-9


def meant_unit(
    usual: Usual, value: float, unit: str, units: DeckUnits, measured: Measured = float, *, strict: bool = False
) -> str:
    """Return the other unit in which a number (as in the deck) has the usual value of its field, or "".

    With `strict` it must be within 20 % of that value.
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


def likely_slips(usual: Usual, value: float, unit: str, units: DeckUnits, measured: Measured = float) -> str:
    """Return the other units, in words, in which a number (as in the deck) would be usual; "" for none, or too many."""
    own = units.size(unit)
    known = SLIPS.get(unit, {}) if math.isnan(usual.typical) else {}
    names = [name for name, size in known.items() if size != own and usual.holds(measured(value * size))]
    return " or ".join(names[:_MOST])


def lacks_point(usual: Usual, value: float, measured: Measured = float) -> bool:
    """Return True if a number (in SI) would be usual with its decimal point elsewhere."""
    quantities = [measured(value * factor) for factor in _POINTS]
    if math.isnan(usual.typical):
        return any(map(usual.holds, quantities))
    return any(usual.typical / _STRICT <= each <= usual.typical * _STRICT for each in quantities)
