"""`*TIMETRACE` of postprocessing: what is plotted in time."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import setting
from mudline.language.keywords.keeping import OpenBlock
from mudline.language.keywords.values import Other

_PAGE = "no page of the manual was found: one type is named by a page on theory, all lines are passed through unchanged"


class Timetrace(OpenBlock):
    """Plots in time."""

    rule = "timetrace"
    sections = ("DATABASE POSTPROCESSING", "POSTPROCESSING")
    subject = "post-processing"
    page = "theory_postprocessing_advanced_angles_elements"
    summary = "What is plotted in time from the database of a run."
    example = "*TIMETRACE\n TYPE=ELEMENT_ELEMENT_ANGLE\n"

    keyword: Literal["TIMETRACE"] = "TIMETRACE"
    type_: Annotated[
        Literal["ELEMENT_ELEMENT_ANGLE"] | Other | None,
        setting("TYPE", "what is plotted", inferred=_PAGE, opaque=("ELEMENT_ELEMENT_ANGLE",)),
    ] = Field(default=None, alias="type")


BLOCK = Timetrace
