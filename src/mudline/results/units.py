"""Names of the units of a deck, for headings and axes."""

from __future__ import annotations

from typing import NamedTuple


class UnitNames(NamedTuple):
    """Names of units; empty where the deck's units are the user's own."""

    length: str
    force: str
    line_force: str
    """Force per length of pipe."""
    stiffness: str
    """Force per length of pipe and length of penetration."""


_METRIC = UnitNames("m", "N", "N/m", "N/m2")
_IMPERIAL = UnitNames("ft", "lbf", "lbf/ft", "lbf/ft2")
_NONE = UnitNames("", "", "", "")


def unit_names(units: str) -> UnitNames:
    """The names of "metric", "imperial" or "user" units."""
    return {"metric": _METRIC, "imperial": _IMPERIAL}.get(units, _NONE)


def headed(name: str, unit: str) -> str:
    """A heading: the name, and below it the unit in brackets if it has one."""
    return f"{name}\n[{unit}]" if unit else name
