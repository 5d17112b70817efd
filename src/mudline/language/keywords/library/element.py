"""`*ELEMENT`: elements by their two nodes, or stepped from a master."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, ListRow, Record, Row, rows
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import COMPONENT, COUNT
from mudline.language.keywords.values import Facts, Ident, Names, Real, Whole

_AXIS = "component {} of the vector that orients the local {} axis of the undeformed element"


class ElementRow(Row):
    """Columns of the table of elements."""

    element: Annotated[Whole, about("element number", defines=Names.ELEMENT)]
    node1: Annotated[Ident, about("first node", names=Names.NODE)]
    node2: Annotated[Ident, about("second node", names=Names.NODE)]
    v1: Annotated[Real | None, about(_AXIS.format(1, "y"), unit="-", usual=COMPONENT)] = None
    v2: Annotated[Real | None, about(_AXIS.format(2, "y"), unit="-", usual=COMPONENT)] = None
    v3: Annotated[Real | None, about(_AXIS.format(3, "y"), unit="-", usual=COMPONENT)] = None
    w1: Annotated[Real | None, about(_AXIS.format(1, "z"), unit="-", usual=COMPONENT)] = None
    w2: Annotated[Real | None, about(_AXIS.format(2, "z"), unit="-", usual=COMPONENT)] = None
    w3: Annotated[Real | None, about(_AXIS.format(3, "z"), unit="-", usual=COMPONENT)] = None


class ElementPattern(ListRow):
    """Master, number of elements with it, and the step of element and node numbers."""

    master: Annotated[Whole, about("existing element whose pattern is repeated", names=Names.ELEMENT)]
    count: Annotated[Whole, about("number of elements, the master included", at_least=1, usual=COUNT)]
    increment: Annotated[Whole | None, about("step of element and node numbers", default="1", usual=COUNT)] = None


class ElementRows(Record):
    """Elements by their nodes."""

    rule = "element_rows"
    elements: Annotated[Table, rows(ElementRow, "elements: number and two nodes")]


class ElementGenerate(Record):
    """Elements stepped from a master."""

    rule = "element_generate"
    generate: Annotated[ElementPattern, setting("GEN", "elements stepped from a master defined before")]


class Elements(Block):
    """Elements."""

    rule = "element"
    facts = Facts(defines="elements", beside=("NODE",))
    page = "kwd_model_element"
    summary = "Elements by number and their two nodes."
    tabular = True
    example = "*ELEMENT\n 1, 1, 2\n GEN=1, 10\n"

    keyword: Literal["ELEMENT"] = "ELEMENT"
    entries: list[ElementRows | ElementGenerate] = []


BLOCK = Elements
