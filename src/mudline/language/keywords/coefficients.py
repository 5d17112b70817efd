"""What the keywords of wind and current share: coefficients of bodies by heading."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import model_validator

from mudline.language.keywords.common import require_one
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, rows
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import ANY, DIRECTION
from mudline.language.keywords.values import Contents, Name, Names, Real
from mudline.language.keywords.vessels import Body

COEFFICIENTS = "coefficients by heading"
TAG = "a line of this word alone: the block is that of a mooring analysis, which has one vessel"


class Coefficients(Row):
    """Coefficients at a heading."""

    heading: Annotated[Real, about("heading", unit="deg", usual=DIRECTION)]
    surge: Annotated[Real, about("coefficient in surge", usual=ANY)]
    sway: Annotated[Real, about("coefficient in sway", usual=ANY)]
    yaw: Annotated[Real, about("coefficient in yaw", usual=ANY)]


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


class CoefficientBlock(Block):
    """Coefficients of floating bodies, or of the moored vessel."""

    bodies: list[BodyCoefficients | VesselCoefficients] = []

    @model_validator(mode="after")
    def _alone(self) -> Self:
        """A mooring analysis has one vessel, and nothing else."""
        if len(self.bodies) > 1 and any(isinstance(body, VesselCoefficients) for body in self.bodies):
            raise ValueError("MOORED VESSEL stands alone: remove the other bodies")
        return self
