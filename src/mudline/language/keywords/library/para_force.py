"""`*PARA FORCE`: a force of an element in the summary."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.summary import ForceVariable, LocalNode, SummaryRequest
from mudline.language.keywords.values import Ident, Names


class ParaForce(SummaryRequest):
    """A force."""

    rule = "para_force"
    page = "kwd_summarypostprocessing_paraforce"
    summary = "A force, moment or the like of an element, in the summary."
    example = "*PARA FORCE\n TITLE=Tension\n DATA1={Hang-off}\n DATA2=1\n DATA3=EFFECTIVE TENSION\n"

    keyword: Literal["PARA FORCE"] = "PARA FORCE"
    element: Annotated[Ident, setting("DATA1", "element number, or its label", names=Names.ELEMENT)]
    node: LocalNode
    variable: Annotated[ForceVariable, setting("DATA3", "output variable, and its place")]


BLOCK = ParaForce
