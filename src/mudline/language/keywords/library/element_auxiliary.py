"""`*ELEMENT,AUXILIARY`: elements of auxiliary bodies (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about
from mudline.language.keywords.model import Block, Row, rows
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import NUMBER
from mudline.language.keywords.values import Whole

_FORM = "the line: a number and 2 nodes; the manual page was not seen"


class AuxiliaryElement(Row):
    """An auxiliary element."""

    element: Annotated[Whole, about("number", inferred=_FORM, usual=NUMBER)]
    first: Annotated[Whole, about("its first auxiliary node", usual=NUMBER)]
    second: Annotated[Whole, about("its second auxiliary node", usual=NUMBER)]


class AuxiliaryElements(Block):
    """Auxiliary elements."""

    rule = "element_auxiliary"
    summary = "Elements of auxiliary bodies, each between 2 auxiliary nodes."
    tabular = True
    example = "*ELEMENT,AUXILIARY\n 1, 1001, 1002\n"

    keyword: Literal["ELEMENT,AUXILIARY"] = "ELEMENT,AUXILIARY"
    elements: Annotated[Table | None, rows(AuxiliaryElement, "auxiliary elements")] = None


BLOCK = AuxiliaryElements
