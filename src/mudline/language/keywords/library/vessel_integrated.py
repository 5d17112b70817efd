"""`*VESSEL,INTEGRATED`: vessels, with their response amplitude operators and profiles."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.keeping import OpenBlock, OpenRecord
from mudline.language.keywords.values import Contents, Name, Names
from mudline.language.keywords.vessels import Dimensions, LocalDistance, Position

_MORE = "more lines follow, of which the manual page was not seen: they are passed through unchanged"


class IntegratedVessel(OpenRecord):
    """A vessel."""

    rule = "integrated_vessel"
    vessel: Annotated[Name, setting("VESSEL", "name of the vessel", inferred=_MORE, defines=Names.VESSEL)]
    angles: Annotated[
        Literal["LARGE", "SMALL"] | None, setting("ANGLES", "how rotations are combined", default="LARGE")
    ] = None
    position: Annotated[Position, setting("INITIAL POSITION", "its reference point and heading")]
    rao: Annotated[
        Name | None, setting("RAO", "file of response amplitude operators", names=Names.FILE, holds=Contents.OPERATORS)
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
    file: Annotated[Name | None, setting("FILE", "file with a shape of one's own", names=Names.FILE)] = None
    dimensions: Annotated[Dimensions | None, setting("DIMENSIONS", "size of the shape")] = None


class IntegratedVessels(OpenBlock):
    """Vessels."""

    rule = "vessel_integrated"
    subject = "vessels"
    page = "kwd_model_vesselintegrated"
    known_forms = True
    summary = "Vessels: initial positions, response amplitude operators, and the shapes that are drawn."
    example = (
        "*VESSEL,INTEGRATED\n VESSEL=FPSO\n INITIAL POSITION=1005.0, 0.0, 0.0, 90.0\n"
        " RAO=fpso.rao\n REF=2.0, 0.0, 0.0\n DIMENSIONS=30.0, 280.0, 55.0\n"
    )

    keyword: Literal["VESSEL,INTEGRATED"] = "VESSEL,INTEGRATED"
    vessels: list[IntegratedVessel] = []


BLOCK = IntegratedVessels
