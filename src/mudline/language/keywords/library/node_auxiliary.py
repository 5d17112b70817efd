"""`*NODE,AUXILIARY`: nodes of auxiliary bodies (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about
from mudline.language.keywords.model import Block, Row, rows
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import NUMBER, POSITION
from mudline.language.keywords.values import Real, Whole


class AuxiliaryNode(Row):
    """An auxiliary node."""

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


BLOCK = AuxiliaryNodes
