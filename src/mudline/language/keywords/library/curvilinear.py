"""Cables, and the nodes placed along them (superseded, still legal)."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *

_LINE = "one line with these four data in this order, as the page names the data and not the line; others are kept"


class CableLine(OpenRecord):
    """Cable."""

    rule = "cable_line"
    cable: Annotated[Whole, about("number of the cable", defines=Names.CABLE, inferred=_LINE)]
    start: Annotated[Ident, about("node where it starts", names=Names.NODE)]
    end: Annotated[Ident, about("node where it ends", names=Names.NODE)]
    length: Annotated[Real, about("length", unit="L", above=0, usual=ALONG)]


class Cables(OpenBlock):
    """Cables."""

    rule = "cable"
    page = "theory_geomety_cables_data"
    summary = "Cables between two nodes, along which *NODE,CURVILINEAR places nodes (older than *LINES)."
    example = "*CABLE\n 1, 1, 41, 565.6\n"

    keyword: Literal["CABLE"] = "CABLE"
    cables: Records[CableLine] = Records()


class CurvilinearNode(Row):
    """Node on a cable."""

    node: Annotated[Whole, about("node number", usual=NUMBER)]
    cable: Annotated[Whole, about("number of the cable", names=Names.CABLE)]
    distance: Annotated[Real, about("distance along it", unit="L", at_least=0, usual=ALONG)]


class CurvilinearRange(ListRow):
    """First and last node, and the step of the numbers between them."""

    start: Annotated[Ident, about("node that the others start from", names=Names.NODE)]
    end: Annotated[Ident, about("node that they end at", names=Names.NODE)]
    increment: Annotated[Whole | None, about("step between the node numbers", default="1", at_least=1, usual=COUNT)] = (
        None
    )


class CurvilinearRows(Record):
    """Nodes by distances."""

    rule = "curvilinear_rows"
    nodes: Annotated[Table, rows(CurvilinearNode, "nodes: number, cable and distance")]


class CurvilinearGenerate(Record):
    """Equally spaced nodes between two on a cable."""

    rule = "curvilinear_generate"
    generate: Annotated[CurvilinearRange, setting("CURV", "equally spaced nodes between two")]
    cable: Annotated[Whole, setting("CABLE", "number of the cable", names=Names.CABLE, inline=True)]


class CurvilinearNodes(Block):
    """Nodes on cables."""

    rule = "node_curvilinear"
    page = "kwd_model_nodecurvilinear"
    facts = Facts(makes=("NODE",), out_of_sight=True)
    summary = "Nodes by their distance along a *CABLE; their coordinates are not computed here (older than *LINES)."
    tabular = True
    example = "*NODE,CURVILINEAR\n 2, 1, 14.1\n 41, 1, 565.6\n CURV=2, 41, CABLE=1\n"

    keyword: Literal["NODE,CURVILINEAR"] = "NODE,CURVILINEAR"
    entries: Records[CurvilinearRows | CurvilinearGenerate] = Records()
