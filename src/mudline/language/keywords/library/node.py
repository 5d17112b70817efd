"""`*NODE`: nodes by coordinates, or placed evenly between two others."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, ListRow, Record, Row, rows
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import POSITION
from mudline.language.keywords.values import Facts, Names, Real, Whole


class NodeRow(Row):
    """Columns of the table of nodes."""

    node: Annotated[Whole, about("node number", defines=Names.NODE)]
    x: Annotated[
        Real,
        about("vertical coordinate, positive upwards; the mudline of a flat seabed is at 0", unit="L", usual=POSITION),
    ]
    y: Annotated[Real, about("horizontal coordinate", unit="L", usual=POSITION)]
    z: Annotated[Real | None, about("horizontal coordinate", unit="L", default="0", usual=POSITION)] = None


class NodeRange(ListRow):
    """First and last node, and the step of the numbers between them."""

    start: Annotated[Whole, about("existing node that the line of nodes starts from", names=Names.NODE)]
    end: Annotated[Whole, about("existing node that it ends at", names=Names.NODE)]
    increment: Annotated[Whole | None, about("step between the node numbers", default="1")] = None


class NodeRows(Record):
    """Nodes by coordinates."""

    rule = "node_rows"
    nodes: Annotated[Table, rows(NodeRow, "nodes: number, x, y and z")]


class NodeGenerate(Record):
    """Equally spaced nodes on the straight line between two nodes."""

    rule = "node_generate"
    generate: Annotated[NodeRange, setting("GEN", "equally spaced nodes between two existing ones")]


class Nodes(Block):
    """Nodes."""

    rule = "node"
    facts = Facts(defines="nodes", beside=("ELEMENT",))
    page = "kwd_model_node"
    summary = "Nodes by number and coordinates; X is vertical."
    tabular = True
    example = "*NODE\n 1, 0.0, 0.0\n 11, 0.0, 100.0\n GEN=1, 11\n"

    keyword: Literal["NODE"] = "NODE"
    entries: list[NodeRows | NodeGenerate] = []


BLOCK = Nodes
