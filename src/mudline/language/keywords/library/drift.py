"""`*DRIFT`: slow motions of vessels."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from mudline.language.keywords.common import require_one
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.lists import Freedom
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import DIRECTION, DRIFT_PERIOD, OF_A_KIND
from mudline.language.keywords.values import Contents, Name, Names, Real
from mudline.language.keywords.vessels import Vessel

_SEVERAL = "several sinusoids of a vessel: the pair of lines is repeated"


class Sinusoid(Row):
    """A drift in one degree of freedom."""

    dof: Freedom
    amplitude: Annotated[Real, about("amplitude: a length, of a rotation degrees", usual=OF_A_KIND)]
    phase: Annotated[Real, about("phase", unit="deg", usual=DIRECTION)]
    period: Annotated[Real, about("period", unit="T", above=0, usual=DRIFT_PERIOD)]


class VesselDrift(Record):
    """A drift of a vessel: a sinusoid, or a file."""

    rule = "vessel_drift"
    vessel: Vessel
    type_: Annotated[
        Literal["SINUSOIDAL", "FILE"],
        setting("TYPE", "a sinusoid, or a time history", inline=True, inferred=_SEVERAL),
    ] = Field(alias="type")
    option: Annotated[
        Literal["GLOBAL", "LOCAL"] | None, setting("OPTION", "axes of the drift", default="GLOBAL", inline=True)
    ] = None
    sinusoid: Annotated[Sinusoid | None, about("of SINUSOIDAL")] = None
    file: Annotated[
        Name | None,
        setting(
            "FILE",
            "of FILE: text file of seven columns, time and six displacements",
            names=Names.FILE,
            holds=Contents.MOTIONS,
        ),
    ] = None

    @model_validator(mode="after")
    def _fits(self) -> VesselDrift:
        """A line of its type."""
        require_one(self, "sinusoid" if self.type_ == "SINUSOIDAL" else "file")
        require_one(self, "sinusoid", "file")
        return self


class Drift(Block):
    """Drifts."""

    rule = "drift"
    sections = ("LOAD CASE",)
    subject = "vessels"
    page = "kwd_loadcase_drift"
    summary = "Slow motions of vessels: sinusoids, or time histories from files."
    example = "*DRIFT\n VESSEL=FPSO, TYPE=SINUSOIDAL\n 2, 4.0, 0.0, 120.0\n"

    keyword: Literal["DRIFT"] = "DRIFT"
    drifts: list[VesselDrift] = []


BLOCK = Drift
