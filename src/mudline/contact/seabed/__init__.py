"""Seabed shapes: for points in space the signed gap to the seabed and its unit normal out of the soil.

Angles are in degrees, X is up. A profile is imported when it is first asked for; the shape of scattered points needs
scipy and has a module of its own: `mudline.contact.seabed.scattered`.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from mudline.contact.seabed.base import FlatSeabed, PlanesSeabed, Seabed, SeabedError, SlopingSeabed

if TYPE_CHECKING:
    from mudline.contact.seabed.profile import ProfileSeabed

__all__ = ["FlatSeabed", "PlanesSeabed", "ProfileSeabed", "Seabed", "SeabedError", "SlopingSeabed"]

_ON_DEMAND = {"ProfileSeabed": "profile"}


def __getattr__(name: str) -> object:
    """The shape that most scenes do without."""
    if name not in _ON_DEMAND:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found: object = getattr(import_module(f"{__name__}.{_ON_DEMAND[name]}"), name)
    return found
