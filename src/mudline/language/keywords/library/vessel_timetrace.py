"""`*VESSEL TIMETRACE`: motions of vessels that are read from files."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.values import Contents, Facts, Name, Names
from mudline.language.keywords.vessels import Vessel


class VesselMotion(Record):
    """The motion of a vessel."""

    rule = "vessel_motion"
    vessel: Vessel
    option: Annotated[
        Literal["GLOBAL", "LOCAL"] | None,
        setting("OPTION", "axes of the displacements", default="GLOBAL", inline=True),
    ] = None
    file: Annotated[
        Name,
        setting(
            "FILE", "text file of seven columns: time, six displacements", names=Names.FILE, holds=Contents.MOTIONS
        ),
    ]


class VesselTimetrace(Block):
    """Motions from files."""

    rule = "vessel_timetrace"
    sections = ("LOAD CASE",)
    subject = "vessels"
    facts = Facts(moves_vessels=True)
    page = "kwd_loadcase_vesseltimetrace"
    summary = "Motions of vessels, of low and high frequency together, from files; not with *RAO or *DRIFT."
    example = "*VESSEL TIMETRACE\n VESSEL=FPSO\n FILE=motion.dat\n"

    keyword: Literal["VESSEL TIMETRACE"] = "VESSEL TIMETRACE"
    motions: list[VesselMotion] = []


BLOCK = VesselTimetrace
