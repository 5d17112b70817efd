"""`*NODE SPRING`: springs from nodes to the ground."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about
from mudline.language.keywords.lists import Freedom, Node
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.usual import OF_A_KIND
from mudline.language.keywords.values import Real


class NodeSpring(Record):
    """A spring at a node."""

    rule = "node_spring_line"
    node: Node
    dof: Freedom
    stiffness: Annotated[
        Real, about("stiffness: force per length, of a rotation moment per degree", at_least=0, usual=OF_A_KIND)
    ]


class NodeSprings(Block):
    """Springs."""

    rule = "node_spring"
    page = "kwd_model_nodespring"
    summary = "Springs at nodes, each in one degree of freedom; their direction stays as it is."
    example = "*NODE SPRING\n 12, 2, 25000.0\n {Hang-off}, 4, 300.0\n"

    keyword: Literal["NODE SPRING"] = "NODE SPRING"
    springs: list[NodeSpring] = []


BLOCK = NodeSprings
