"""Seabed shapes: for points in space the signed gap to the seabed and its unit normal out of the soil.

Angles are in degrees, X is up. Shapes that are neither flat nor a uniform slope are imported when they are first asked
for; that of scattered points needs scipy and stands in a module of its own: `mudline.contact.seabed.scattered`.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from mudline.contact.seabed.base import FlatSeabed, Seabed, SeabedError, SlopingSeabed

if TYPE_CHECKING:
    from mudline.contact.seabed.base import PlanesSeabed
    from mudline.contact.seabed.profile import ProfileSeabed

__all__ = ["FlatSeabed", "PlanesSeabed", "ProfileSeabed", "Seabed", "SeabedError", "SlopingSeabed"]

_ON_DEMAND = {"PlanesSeabed": "planes", "ProfileSeabed": "profile"}


def __getattr__(name: str) -> object:
    """The shapes that are not needed by most scenes."""
    if name not in _ON_DEMAND:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found: object = getattr(import_module(f"{__name__}.{_ON_DEMAND[name]}"), name)
    return found
