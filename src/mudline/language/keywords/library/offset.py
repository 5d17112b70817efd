"""`*OFFSET`: where vessels lie against their initial positions."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.vessels import Motion, Vessel


class VesselOffset(Record):
    """The offset of a vessel."""

    rule = "vessel_offset"
    vessel: Vessel
    offset: Annotated[Motion, setting("OFFSET", "displacements from the initial position")]


class Offsets(Block):
    """Offsets."""

    rule = "offset"
    sections = ("LOAD CASE",)
    subject = "vessels"
    page = "kwd_loadcase_offset"
    summary = "Offsets of vessels from their initial positions."
    example = "*OFFSET\n VESSEL=FPSO\n OFFSET=0.0, -8.0, 0.0\n"

    keyword: Literal["OFFSET"] = "OFFSET"
    offsets: list[VesselOffset] = []


BLOCK = Offsets
