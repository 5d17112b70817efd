"""`*SEABED PLANES`: a seabed of several plane surfaces (extension)."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import DIRECTION, MODEL, POSITION
from mudline.language.keywords.values import Facts, Name, Real


class PlanePoint(Row):
    """Values of POINT=."""

    x: Annotated[Real, about("elevation of the point", unit="L", usual=POSITION)]
    y: Annotated[Real, about("horizontal coordinate Y", unit="L", usual=POSITION)]
    z: Annotated[Real, about("horizontal coordinate Z", unit="L", usual=POSITION)]


class PlaneBounds(Row):
    """Values of BOUNDS=: a closed range; an empty field is no bound on that side."""

    y_min: Annotated[Real | None, about("smallest Y", unit="L", default="unbounded", usual=POSITION)] = None
    y_max: Annotated[Real | None, about("largest Y", unit="L", default="unbounded", usual=POSITION)] = None
    z_min: Annotated[Real | None, about("smallest Z", unit="L", default="unbounded", usual=POSITION)] = None
    z_max: Annotated[Real | None, about("largest Z", unit="L", default="unbounded", usual=POSITION)] = None


class Plane(Record):
    """A plane."""

    rule = "seabed_plane"
    name: Annotated[Name, setting("PLANE", "name of the plane")]
    point: Annotated[PlanePoint | None, setting("POINT", "a point of the plane; mandatory")] = None
    slope: Annotated[
        Real | None,
        setting(
            "SLOPE",
            "steepest slope; positive rises towards +Y turned by DIRECTION=; mandatory",
            unit="deg",
            usual=MODEL,
        ),
    ] = None
    direction: Annotated[
        Real | None,
        setting(
            "DIRECTION",
            "angle from +Y, counter-clockwise about X",
            unit="deg",
            default="0",
            inline=True,
            behind="SLOPE",
            usual=DIRECTION,
        ),
    ] = None
    bounds: Annotated[
        PlaneBounds | None, setting("BOUNDS", "horizontal extent, its edges included", default="unbounded")
    ] = None


class SeabedPlanes(Block):
    """Plane surfaces; the highest of those that hold a point is the seabed there."""

    rule = "seabed_planes"
    subject = "seabed"
    facts = Facts(extension=True, computed_in="shapes-of-the-seabed")
    summary = "A seabed of several plane surfaces: the highest one at a place holds (extension)."
    example = (
        "*SEABED PLANES\n PLANE=shelf\n POINT=0.0, 0.0, 0.0\n SLOPE=0.0\n"
        " PLANE=slope\n POINT=0.0, 200.0, 0.0\n SLOPE=5.0, DIRECTION=0.0\n BOUNDS=200.0, 900.0, -500.0, 500.0\n"
    )

    keyword: Literal["SEABED PLANES"] = "SEABED PLANES"
    planes: list[Plane] = []


BLOCK = SeabedPlanes
