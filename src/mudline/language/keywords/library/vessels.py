"""Vessels at their initial positions, their moonpools, and bodies that are only drawn."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *


class Position(Row):
    """Initial position of a vessel."""

    x: Annotated[Real, about("vertical coordinate of its reference point", unit="L", usual=VESSEL_HEIGHT)]
    y: Annotated[Real, about("horizontal coordinate Y", unit="L", usual=POSITION)]
    z: Annotated[Real, about("horizontal coordinate Z", unit="L", usual=POSITION)]
    yaw: Annotated[
        Real | None, about("heading, anticlockwise from the global Y axis", unit="deg", default="0", usual=DIRECTION)
    ] = None


class LocalDistance(Row):
    """Distance in the axes of a vessel."""

    heave: Annotated[Real, about("along its heave axis", unit="L", usual=VESSEL_SIZE)]
    surge: Annotated[Real, about("along its surge axis", unit="L", usual=VESSEL_SIZE)]
    sway: Annotated[Real, about("along its sway axis", unit="L", usual=VESSEL_SIZE)]


class Dimensions(Row):
    """Size of a profile."""

    height: Annotated[Real, about("height", unit="L", above=0, usual=VESSEL_SIZE)]
    length: Annotated[Real, about("length", unit="L", above=0, usual=VESSEL_SIZE)]
    width: Annotated[Real, about("width", unit="L", above=0, usual=VESSEL_SIZE)]


class VesselPosition(Record):
    """Vessel."""

    rule = "vessel_position"
    vessel: Annotated[Name, setting("VESSEL", "name of the vessel", defines=Names.VESSEL)]
    position: Annotated[Position, setting("INITIAL POSITION", "its reference point and heading")]


class Vessels(Block):
    """Vessels."""

    rule = "vessel"
    subject = "vessels"
    page = "kwd_model_vessel"
    summary = "Vessels: initial positions of their reference points, and headings (older than *VESSEL,INTEGRATED)."
    example = "*VESSEL\n VESSEL=FPSO\n INITIAL POSITION=1005.0, 0.0, 0.0, 90.0\n"

    keyword: Literal["VESSEL"] = "VESSEL"
    angles: Annotated[
        Literal["LARGE", "SMALL"] | None, setting("ANGLES", "how rotations are combined", default="LARGE")
    ] = None
    vessels: Records[VesselPosition] = Records()


_MORE = "more lines follow, of which the manual page was not seen: they are passed through unchanged"


class IntegratedVessel(OpenRecord):
    """Vessel."""

    rule = "integrated_vessel"
    vessel: Annotated[Name, setting("VESSEL", "name of the vessel", inferred=_MORE, defines=Names.VESSEL)]
    angles: Annotated[
        Literal["LARGE", "SMALL"] | None, setting("ANGLES", "how rotations are combined", default="LARGE")
    ] = None
    position: Annotated[Position, setting("INITIAL POSITION", "its reference point and heading")]
    rao: Annotated[
        Name | None, setting("RAO", "file of response amplitude operators", names=Names.FILE, holds=DataFile.OPERATORS)
    ] = None
    format: Annotated[
        Name | None,
        setting("FORMAT", "format of that file, as WAMIT, AQWA, MOSES or ORCAFLEX", inline=True, behind="RAO"),
    ] = None
    units: Annotated[Name | None, setting("UNITS", "units of that file", inline=True, behind="RAO")] = None
    reference: Annotated[
        LocalDistance | None, setting("REF", "point that the operators hold for, from the reference point")
    ] = None
    profile: Annotated[Name | None, setting("PROFILE", "shape that is drawn")] = None
    file: Annotated[Name | None, setting("FILE", "file with a user-defined shape", names=Names.FILE)] = None
    dimensions: Annotated[Dimensions | None, setting("DIMENSIONS", "size of the shape")] = None


class IntegratedVessels(OpenBlock):
    """Vessels."""

    rule = "vessel_integrated"
    subject = "vessels"
    page = "kwd_model_vesselintegrated"
    known_forms = True
    summary = "Vessels: initial positions, response amplitude operators, and shapes for drawings."
    example = (
        "*VESSEL,INTEGRATED\n VESSEL=FPSO\n INITIAL POSITION=1005.0, 0.0, 0.0, 90.0\n"
        " RAO=fpso.rao\n REF=2.0, 0.0, 0.0\n DIMENSIONS=30.0, 280.0, 55.0\n"
    )

    keyword: Literal["VESSEL,INTEGRATED"] = "VESSEL,INTEGRATED"
    vessels: Records[IntegratedVessel] = Records()


class MoonpoolPlace(Row):
    """Initial position of a moonpool."""

    x: Annotated[Real, about("vertical coordinate of the centre of its lower face", unit="L", usual=VESSEL_HEIGHT[1])]
    y: Annotated[Real, about("horizontal coordinate Y", unit="L", usual=POSITION)]
    z: Annotated[Real, about("horizontal coordinate Z", unit="L", usual=POSITION)]
    yaw: Annotated[Real, about("heading, anticlockwise from the global Y axis", unit="deg", usual=DIRECTION)]
    width: Annotated[
        Real, about("width of the square, and height of its transition", unit="L", above=0, usual=VESSEL_SIZE)
    ]


class Moonpool(Record):
    """Moonpool."""

    rule = "vessel_moonpool"
    vessel: Annotated[Name, setting("VESSEL", "vessel that it moves with", names=Names.VESSEL, unique=True)]
    place: Annotated[MoonpoolPlace, about("its place and width")]


class Moonpools(Block):
    """Moonpools."""

    rule = "moonpool"
    subject = "vessels"
    page = "kwd_model_moonpool"
    summary = "Moonpools, in which the water moves with the vessel: one square moonpool per vessel."
    example = "*MOONPOOL\n VESSEL=FPSO\n 990.0, 0.0, 0.0, 0.0, 9.0\n"

    keyword: Literal["MOONPOOL"] = "MOONPOOL"
    moonpools: Records[Moonpool] = Records()


class Location(Row):
    """Position of a drawn body."""

    x: Annotated[Real, about("vertical coordinate", unit="L", usual=POSITION)]
    y: Annotated[Real, about("horizontal coordinate Y", unit="L", usual=POSITION)]
    z: Annotated[Real, about("horizontal coordinate Z", unit="L", usual=POSITION)]


class DrawnBody(Record):
    """Body."""

    rule = "drawn_body"
    body: Annotated[Name, setting("BODY", "name of the body")]
    location: Annotated[Location, setting("LOCATION", "where it is")]
    node: Annotated[Ident | None, setting("NODE", "node that it moves with", names=Names.NODE)] = None
    profile: Annotated[
        Literal["BOP", "CALMBUOY", "PLET", "ROV", "USER"], setting("PROFILE", "its shape; USER: of a file")
    ]
    file: Annotated[Name | None, setting("FILE", "of USER: file with the shape; mandatory", names=Names.FILE)] = None
    dimensions: Annotated[Dimensions | None, setting("DIMENSIONS", "its size")] = None


class DrawnBodies(Block):
    """Bodies."""

    rule = "body_integrated"
    page = "kwd_model_bodyintegrated"
    summary = "Bodies for drawings: their positions, shapes, and the nodes that they move with."
    example = "*BODY,INTEGRATED\n BODY=Manifold\n LOCATION=0.0, 10.0, 0.0\n NODE=1\n PROFILE=PLET\n"

    keyword: Literal["BODY,INTEGRATED"] = "BODY,INTEGRATED"
    bodies: Records[DrawnBody] = Records()
