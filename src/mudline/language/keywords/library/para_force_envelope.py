"""`*PARA FORCE ENVELOPE`: extremes of a force over a set in the summary."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.summary import ForceVariable, SummaryRequest
from mudline.language.keywords.values import Name, Names


class ParaForceEnvelope(SummaryRequest):
    """Extremes of a force."""

    rule = "para_force_envelope"
    page = "kwd_summarypostprocessing_paraforceenvelope"
    summary = "Statistics of a force over the elements of a set, in the summary."
    example = "*PARA FORCE ENVELOPE\n TITLE=Tension\n DATA1=ALL\n DATA2=EFFECTIVE TENSION\n"

    keyword: Literal["PARA FORCE ENVELOPE"] = "PARA FORCE ENVELOPE"
    set_name: Annotated[Name, setting("DATA1", "element set, or ALL", names=Names.SET)]
    variable: Annotated[ForceVariable, setting("DATA2", "output variable, and its place")]


BLOCK = ParaForceEnvelope
