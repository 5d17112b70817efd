"""`*PARA REACTION`: a reaction at a node in the summary."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.summary import AXIS, SummaryRequest
from mudline.language.keywords.usual import COUNT
from mudline.language.keywords.values import Ident, Name, Names, Whole


class ParaReaction(SummaryRequest):
    """A reaction."""

    rule = "para_reaction"
    page = "kwd_summarypostprocessing_parareaction"
    summary = "The reaction at a node in a degree of freedom, in the summary."
    example = "*PARA REACTION\n TITLE=Anchor\n SCALE=0.001, UNITS=kN\n DATA1=1\n DATA2=2\n"

    keyword: Literal["PARA REACTION"] = "PARA REACTION"
    node: Annotated[Ident, setting("DATA1", "node number, or its label", names=Names.NODE)]
    dof: Annotated[Whole, setting("DATA2", "degree of freedom", at_least=1, at_most=6, usual=COUNT)]
    axis: Annotated[Name | None, setting("DATA3", AXIS, default="global")] = None


BLOCK = ParaReaction
