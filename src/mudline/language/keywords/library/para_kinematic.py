"""`*PARA KINEMATIC`: a motion of a node in the summary."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.summary import AXIS, SummaryRequest
from mudline.language.keywords.usual import COUNT
from mudline.language.keywords.values import Ident, Name, Names, Whole


class ParaKinematic(SummaryRequest):
    """A motion."""

    rule = "para_kinematic"
    page = "kwd_summarypostprocessing_parakinematic"
    summary = "A motion, displacement, velocity or acceleration of a node, in the summary."
    example = "*PARA KINEMATIC\n TITLE=Hang-off\n PLOT=YES\n DATA1={Hang-off}\n DATA2=1\n DATA3=2\n"

    keyword: Literal["PARA KINEMATIC"] = "PARA KINEMATIC"
    node: Annotated[Ident, setting("DATA1", "node number, or its label", names=Names.NODE)]
    dof: Annotated[Whole, setting("DATA2", "degree of freedom", at_least=1, at_most=6, usual=COUNT)]
    quantity: Annotated[
        Whole,
        setting("DATA3", "1 motion, 2 displacement, 3 velocity, 4 acceleration", at_least=1, at_most=4, usual=COUNT),
    ]
    axis: Annotated[Name | None, setting("DATA4", AXIS, default="global")] = None


BLOCK = ParaKinematic
