"""`*VESSEL`: where vessels are at first (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.values import Name, Names
from mudline.language.keywords.vessels import Position


class VesselPosition(Record):
    """A vessel."""

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
    vessels: list[VesselPosition] = []


BLOCK = Vessels
