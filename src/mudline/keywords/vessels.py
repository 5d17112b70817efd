"""What the keywords of vessels and of bodies share: positions, motions, and files of coefficients."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import model_validator

from mudline.keywords.model import Record, Row, about, require_one, rows, setting
from mudline.keywords.table import Table
from mudline.keywords.values import Contents, Name, Names, Real

COEFFICIENTS = "coefficients by heading"
TAG = "a line of this word alone: the block is that of a mooring analysis, which has one vessel"

Vessel = Annotated[Name, setting("VESSEL", "vessel of *VESSEL or *VESSEL,INTEGRATED", names=Names.VESSEL)]
Body = Annotated[Name, setting("FLOATING BODY", "floating body", names=Names.BODY)]


class Position(Row):
    """Where a vessel is at first."""

    x: Annotated[Real, about("vertical coordinate of its reference point", unit="L")]
    y: Annotated[Real, about("horizontal coordinate Y", unit="L")]
    z: Annotated[Real, about("horizontal coordinate Z", unit="L")]
    yaw: Annotated[Real | None, about("heading, anticlockwise from the global Y axis", unit="deg", default="0")] = None


class Motion(Row):
    """Six displacements of a vessel."""

    x: Annotated[Real, about("along the global X axis", unit="L")]
    y: Annotated[Real | None, about("along the global Y axis", unit="L", default="0")] = None
    z: Annotated[Real | None, about("along the global Z axis", unit="L", default="0")] = None
    yaw: Annotated[Real | None, about("about the vertical axis", unit="deg", default="0")] = None
    roll: Annotated[Real | None, about("about the surge axis of the vessel", unit="deg", default="0")] = None
    pitch: Annotated[Real | None, about("about the sway axis of the vessel", unit="deg", default="0")] = None


class LocalDistance(Row):
    """A distance in the axes of a vessel."""

    heave: Annotated[Real, about("along its heave axis", unit="L")]
    surge: Annotated[Real, about("along its surge axis", unit="L")]
    sway: Annotated[Real, about("along its sway axis", unit="L")]


class Dimensions(Row):
    """The size of a profile."""

    height: Annotated[Real, about("height", unit="L", above=0)]
    length: Annotated[Real, about("length", unit="L", above=0)]
    width: Annotated[Real, about("width", unit="L", above=0)]


class Coefficients(Row):
    """Coefficients at a heading."""

    heading: Annotated[Real, about("heading", unit="deg")]
    surge: Annotated[Real, about("coefficient in surge")]
    sway: Annotated[Real, about("coefficient in sway")]
    yaw: Annotated[Real, about("coefficient in yaw")]


class BodyCoefficients(Record):
    """The coefficients of a floating body."""

    rule = "body_coefficients"
    body: Body
    file: Annotated[
        Name | None,
        setting("FILE", "file with the coefficients, instead of rows", names=Names.FILE, holds=Contents.NUMBERS),
    ] = None
    headings: Annotated[Table | None, rows(Coefficients, COEFFICIENTS)] = None

    @model_validator(mode="after")
    def _fits(self) -> BodyCoefficients:
        """A file, or rows."""
        require_one(self, "file", "headings")
        return self


class VesselCoefficients(Record):
    """The coefficients of the moored vessel."""

    rule = "vessel_coefficients"
    tag: Annotated[Literal["MOORED VESSEL"], about(TAG)]
    file: Annotated[
        Name | None,
        setting("FILE", "file with the coefficients, instead of rows", names=Names.FILE, holds=Contents.NUMBERS),
    ] = None
    headings: Annotated[Table | None, rows(Coefficients, COEFFICIENTS)] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """The first line is the tag."""
        return "tag" if number == 0 else "headings"

    @model_validator(mode="after")
    def _fits(self) -> VesselCoefficients:
        """A file, or rows."""
        require_one(self, "file", "headings")
        return self
