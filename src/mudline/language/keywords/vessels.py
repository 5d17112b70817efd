"""What the keywords of vessels and of bodies share: names, positions and motions."""

from __future__ import annotations

from typing import Annotated

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Row
from mudline.language.keywords.usual import (
    DIRECTION,
    HEEL,
    OFFSET,
    POSITION,
    VERTICAL_OFFSET,
    VESSEL_HEIGHT,
    VESSEL_SIZE,
)
from mudline.language.keywords.values import Name, Names, Real

Vessel = Annotated[Name, setting("VESSEL", "vessel of *VESSEL or *VESSEL,INTEGRATED", names=Names.VESSEL)]
Body = Annotated[Name, setting("FLOATING BODY", "floating body", names=Names.BODY)]


class Position(Row):
    """Where a vessel is at first."""

    x: Annotated[Real, about("vertical coordinate of its reference point", unit="L", usual=VESSEL_HEIGHT)]
    y: Annotated[Real, about("horizontal coordinate Y", unit="L", usual=POSITION)]
    z: Annotated[Real, about("horizontal coordinate Z", unit="L", usual=POSITION)]
    yaw: Annotated[
        Real | None, about("heading, anticlockwise from the global Y axis", unit="deg", default="0", usual=DIRECTION)
    ] = None


class Motion(Row):
    """Six displacements of a vessel."""

    x: Annotated[Real, about("shift along the global X axis", unit="L", usual=VERTICAL_OFFSET)]
    y: Annotated[Real | None, about("shift along the global Y axis", unit="L", default="0", usual=OFFSET)] = None
    z: Annotated[Real | None, about("shift along the global Z axis", unit="L", default="0", usual=OFFSET)] = None
    yaw: Annotated[Real | None, about("turn about the vertical axis", unit="deg", default="0", usual=DIRECTION)] = None
    roll: Annotated[
        Real | None, about("turn about the surge axis of the vessel", unit="deg", default="0", usual=HEEL)
    ] = None
    pitch: Annotated[
        Real | None, about("turn about the sway axis of the vessel", unit="deg", default="0", usual=HEEL)
    ] = None


class LocalDistance(Row):
    """A distance in the axes of a vessel."""

    heave: Annotated[Real, about("along its heave axis", unit="L", usual=VESSEL_SIZE)]
    surge: Annotated[Real, about("along its surge axis", unit="L", usual=VESSEL_SIZE)]
    sway: Annotated[Real, about("along its sway axis", unit="L", usual=VESSEL_SIZE)]


class Dimensions(Row):
    """The size of a profile."""

    height: Annotated[Real, about("height", unit="L", above=0, usual=VESSEL_SIZE)]
    length: Annotated[Real, about("length", unit="L", above=0, usual=VESSEL_SIZE)]
    width: Annotated[Real, about("width", unit="L", above=0, usual=VESSEL_SIZE)]
