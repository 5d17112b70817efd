"""Systems of units: names of units, and their sizes in SI.

A dimension is written with the letters F (force), L (length), M (mass) and T (time): F/L2 is N/m2 in metric units, and
1/L is 1/m.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

FOOT = 0.3048
POUND = 4.4482216152605

_DIMENSION = re.compile(r"(?:[FLMT]\d?|deg|1/|/)+")
_FACTOR = re.compile(r"([FLMT]|deg)(\d?)")


@dataclass(frozen=True, eq=False)
class UnitSystem:
    """System of units; the unit of time is the second.

    Attributes:
        names: names of the base units by the letters of a dimension.
        force, length, mass: sizes of these units in SI; 1 if they are not known.
        known: False for user units, whose names are words.
    """

    names: Mapping[str, str]
    force: float = 1.0
    length: float = 1.0
    mass: float = 1.0
    known: bool = True

    @lru_cache(256)  # noqa: B019 - there are few units
    def size(self, dimension: str) -> float:
        """Return the size of a unit in SI; 1 if it is not known, or `dimension` is not a dimension."""
        if not _DIMENSION.fullmatch(dimension):
            return 1.0
        sizes = {"F": self.force, "L": self.length, "M": self.mass, "T": 1.0, "deg": 1.0}
        product = 1.0
        for side, sign in zip(dimension.split("/"), (1, -1), strict=False):
            for letter, power in _FACTOR.findall(side):
                product *= sizes[letter] ** (sign * int(power or 1))
        return product

    def text(self, dimension: str) -> str:
        """Return the name of a unit, in words if it is not known; a text that is not a dimension stays."""
        if not _DIMENSION.fullmatch(dimension):
            return dimension
        names = {**self.names, "deg": "deg"}
        sides = map(_FACTOR.findall, dimension.split("/"))
        return "/".join(" ".join(names[letter] + power for letter, power in side) or "1" for side in sides)

    def unit(self, dimension: str) -> str:
        """Return the name of a unit; "" if it is not known, or for "-", a number without one."""
        return self.text(dimension) if self.known and dimension != "-" else ""

    def behind(self, dimension: str) -> str:
        """Return a unit as written after a number, with a leading space; "" without a unit."""
        unit = "degrees" if dimension == "deg" else self.unit(dimension)
        return f" {unit}" if unit else ""


class _Systems(dict[str, UnitSystem]):
    """Systems by name; any other name, as a contact input made by hand may have, is that of units not known."""

    def __missing__(self, name: str) -> UnitSystem:
        return self["user"]


UNITS = _Systems(
    {
        "metric": UnitSystem({"F": "N", "L": "m", "M": "kg", "T": "s"}),
        "imperial": UnitSystem({"F": "lbf", "L": "ft", "M": "slug", "T": "s"}, POUND, FOOT, POUND / FOOT),
        "user": UnitSystem({"F": "force", "L": "length", "M": "mass", "T": "time"}, known=False),
    }
)
"""Unit systems that a deck may have, by their names."""
TONNES = UnitSystem({"F": "kN", "L": "m", "M": "t", "T": "s"}, force=1e3, mass=1e3)
"""Units of a deck whose system is "user", but whose water and gravity show them."""
