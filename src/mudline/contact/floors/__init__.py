"""Sea floors: for points in space the signed gap to the bed and its unit normal out of the soil.

Angles are in degrees, X is up. A bed is imported when it is first asked for; that of scattered points needs scipy and
stands in a module of its own: `mudline.contact.floors.scattered`.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from mudline.contact.floors.base import Floor
from mudline.contact.floors.errors import FloorError
from mudline.contact.floors.flat import FlatFloor

if TYPE_CHECKING:
    from mudline.contact.floors.planes import PlanesFloor
    from mudline.contact.floors.profile import ProfileFloor
    from mudline.contact.floors.sloping import SlopingFloor

__all__ = ["FlatFloor", "Floor", "FloorError", "PlanesFloor", "ProfileFloor", "SlopingFloor"]

_WHEN_ASKED = {"PlanesFloor": "planes", "ProfileFloor": "profile", "SlopingFloor": "sloping"}


def __getattr__(name: str) -> object:
    """The beds that are not flat."""
    if name not in _WHEN_ASKED:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found: object = getattr(import_module(f"{__name__}.{_WHEN_ASKED[name]}"), name)
    return found
