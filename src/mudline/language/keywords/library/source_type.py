"""`*SOURCE TYPE`: what fatigue takes its stresses from."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block


class SourceType(Block):
    """The source of stresses."""

    rule = "source_type"
    sections = ("LIFETIME FATIGUE",)
    subject = "post-processing"
    page = "kwd_lifetimefatigue_sourcetype"
    summary = "What fatigue in the time domain takes its stresses from: time traces, or databases."
    example = "*SOURCE TYPE\n SOURCE=DATABASE\n"

    keyword: Literal["SOURCE TYPE"] = "SOURCE TYPE"
    source: Annotated[
        Literal["TIMETRACE", "DATABASE"] | None,
        setting(
            "SOURCE",
            "time traces, or databases",
            default="TIMETRACE",
            inferred="the name of the section, from the name of the page",
        ),
    ] = None


BLOCK = SourceType
