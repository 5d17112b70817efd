"""Which unit system a deck is in."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING, cast

from mudline.deck.model import Deck
from mudline.deck.parameters import Parameters

if TYPE_CHECKING:
    from mudline.keywords.library.ocean import Ocean
    from mudline.keywords.library.units import Units

_SUFFIXES = {".keyxm": "metric", ".keyxi": "imperial"}
GRAVITIES = {"metric": 9.81, "imperial": 32.2}
_NEAR = 0.02


def units_of(deck: Deck) -> str:
    """The system, "metric", "imperial" or "user": by suffix, else `*UNITS`, else the gravity of `*OCEAN` within 2 %."""
    suffix = PurePath(deck.source).suffix.lower()
    if suffix in _SUFFIXES:
        return _SUFFIXES[suffix]
    for _, block in deck.blocks("UNITS", "ANALYSIS"):
        if units := cast("Units", block).units:
            return units.lower()
    gravity = gravity_of(deck)
    return next((name for name, g in GRAVITIES.items() if gravity and abs(gravity - g) <= _NEAR * g), "user")


def gravity_of(deck: Deck) -> float | None:
    """Gravity of the last `*OCEAN` that gives one, evaluated; None when there is none."""
    parameters = Parameters(deck)
    found: float | None = None
    for _, ocean in deck.blocks("OCEAN"):
        value = parameters.number(cast("Ocean", ocean).gravity)
        found = value if value is not None else found
    return found
