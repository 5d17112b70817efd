"""Sea floors: for points in space the signed gap to the bed and its unit normal out of the soil.

Angles are in degrees, X is up. The bed of scattered points needs scipy and stands in a module of its own:
`mudline.contact.floors.scattered`.
"""

from __future__ import annotations

from mudline.contact.floors.base import Floor
from mudline.contact.floors.errors import FloorError
from mudline.contact.floors.flat import FlatFloor
from mudline.contact.floors.planes import PlanesFloor
from mudline.contact.floors.profile import ProfileFloor
from mudline.contact.floors.sloping import SlopingFloor

__all__ = ["FlatFloor", "Floor", "FloorError", "PlanesFloor", "ProfileFloor", "SlopingFloor"]
