"""`*PARA ANGLE ELEMENT`: the angle between two elements in the summary."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.summary import SummaryRequest
from mudline.language.keywords.values import Ident, Names


class ParaAngleElement(SummaryRequest):
    """An angle."""

    rule = "para_angle_element"
    page = "kwd_summarypostprocessing_paraangleelement"
    summary = "The angle between two elements, in the summary."
    example = "*PARA ANGLE ELEMENT\n TITLE=Flex joint\n DATA1=12\n DATA2={Vessel End}\n"

    keyword: Literal["PARA ANGLE ELEMENT"] = "PARA ANGLE ELEMENT"
    first: Annotated[Ident, setting("DATA1", "element number, or its label", names=Names.ELEMENT)]
    second: Annotated[Ident, setting("DATA2", "element number, or its label", names=Names.ELEMENT)]


BLOCK = ParaAngleElement
