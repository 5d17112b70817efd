"""Auxiliary bodies, which are drawn and have no stiffness (superseded, still legal)."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *


class AuxiliaryRange(ListRow):
    """First and last auxiliary element, and the step between them."""

    start: Annotated[Whole, about("first auxiliary element")]
    end: Annotated[Whole, about("last auxiliary element")]
    increment: Annotated[Whole | None, about("step", default="1", at_least=1, usual=COUNT)] = None


class AuxiliaryList(Record):
    """Auxiliary elements, at most 20 on a line."""

    rule = "auxiliary_list"
    elements: Annotated[list[Whole], about("numbers of auxiliary elements", usual=NUMBER)]


class AuxiliaryGenerate(Record):
    """Range of auxiliary elements."""

    rule = "auxiliary_generate"
    generate: Annotated[AuxiliaryRange, setting("GEN", "range of auxiliary elements")]


class AuxiliaryBody(Record):
    """Body."""

    rule = "auxiliary_body"
    body: Annotated[Name, setting("BODY", "vessel or node that it moves with; NONE: it does not move")]
    members: Records[AuxiliaryList | AuxiliaryGenerate] = Records()


class Auxiliary(Block):
    """Bodies."""

    rule = "auxiliary"
    page = "kwd_model_auxiliary"
    summary = "Auxiliary elements that are drawn as bodies, and the objects that they move with."
    example = "*AUXILIARY\n BODY=FPSO\n 1, 2, 3\n GEN=10, 20, 2\n"

    keyword: Literal["AUXILIARY"] = "AUXILIARY"
    bodies: Records[AuxiliaryBody] = Records()


class AuxiliaryNode(Row):
    """Auxiliary node."""

    node: Annotated[Whole, about("number, that of no node of the structure", usual=NUMBER)]
    x: Annotated[Real, about("vertical coordinate", unit="L", usual=POSITION)]
    y: Annotated[Real, about("horizontal coordinate", unit="L", usual=POSITION)]
    z: Annotated[Real | None, about("horizontal coordinate", unit="L", default="0", usual=POSITION)] = None


class AuxiliaryNodes(Block):
    """Nodes."""

    rule = "node_auxiliary"
    page = "kwd_model_nodeauxiliary"
    summary = "Nodes of auxiliary bodies, which are drawn and have no stiffness."
    tabular = True
    example = "*NODE,AUXILIARY\n 1001, 1000.0, 900.0\n 1002, 1020.0, 900.0, 5.0\n"

    keyword: Literal["NODE,AUXILIARY"] = "NODE,AUXILIARY"
    nodes: Annotated[Table | None, rows(AuxiliaryNode, "auxiliary nodes")] = None


_ELEMENT_FORM = "the line: a number and 2 nodes; the manual page was not seen"


class AuxiliaryElement(Row):
    """Auxiliary element."""

    element: Annotated[Whole, about("number", inferred=_ELEMENT_FORM, usual=NUMBER)]
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


_PANEL_FORM = "the line: a number and 3 nodes; the manual page was not seen"


class AuxiliaryPanel(Row):
    """Auxiliary panel."""

    panel: Annotated[Whole, about("number", inferred=_PANEL_FORM, usual=NUMBER)]
    first: Annotated[Whole, about("its first auxiliary node", usual=NUMBER)]
    second: Annotated[Whole, about("its second auxiliary node", usual=NUMBER)]
    third: Annotated[Whole, about("its third auxiliary node", usual=NUMBER)]


class AuxiliaryPanels(Block):
    """Auxiliary panels."""

    rule = "panel_auxiliary"
    summary = "Panels of auxiliary bodies, each between 3 auxiliary nodes."
    tabular = True
    example = "*PANEL,AUXILIARY\n 1, 1001, 1002, 1003\n"

    keyword: Literal["PANEL,AUXILIARY"] = "PANEL,AUXILIARY"
    panels: Annotated[Table | None, rows(AuxiliaryPanel, "auxiliary panels")] = None
