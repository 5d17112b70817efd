"""`*VESSEL VELOCITY`: vessels that move on at one speed."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.usual import DIRECTION, Usual
from mudline.language.keywords.values import Real
from mudline.language.keywords.vessels import Vessel


class Velocity(Record):
    """The velocity of a vessel."""

    rule = "velocity"
    vessel: Vessel
    axis: Annotated[
        Literal["GLOBAL", "LOCAL"] | None,
        setting("AXIS", "axis from which the direction counts: global Y or surge", default="GLOBAL", inline=True),
    ] = None
    speed: Annotated[Real, about("speed", unit="L/T", usual=Usual(-30.0, 30.0, "ships are no faster"))]
    angle: Annotated[Real | None, about("direction, anticlockwise", unit="deg", default="0", usual=DIRECTION)] = None


class VesselVelocity(Block):
    """Velocities."""

    rule = "vessel_velocity"
    sections = ("LOAD CASE",)
    subject = "vessels"
    page = "kwd_loadcase_vesselvelocity"
    summary = "Vessels that move on at one speed, beside their other motions; not with *VESSEL TIMETRACE."
    example = "*VESSEL VELOCITY\n VESSEL=FPSO, AXIS=LOCAL\n 0.5, 0.0\n"

    keyword: Literal["VESSEL VELOCITY"] = "VESSEL VELOCITY"
    velocities: list[Velocity] = []


BLOCK = VesselVelocity
