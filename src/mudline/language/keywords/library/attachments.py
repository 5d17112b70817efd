"""Masses and drag chains at nodes."""

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.assigning import Records
from mudline.language.keywords.common import Node
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, ListRow, Record
from mudline.language.keywords.usual import ALONG, COUNT, LIFT, Usual
from mudline.language.keywords.values import Ident, Names, Real, Whole


class PointMass(Record):
    """Mass at a node."""

    rule = "point_mass"
    node: Node
    mass: Annotated[
        Real,
        about(
            "mass, or rotary inertia",
            unit="M",
            at_least=0,
            usual=Usual(high=1e7, why="heavier is a hull", remark=True),
            written_in=("M", "ML2"),
        ),
    ]
    type_: Annotated[
        Literal["MASS", "NO WEIGHT MASS", "ROTARY INERTIA"] | None,
        setting("TYPE", "mass, mass without weight, or rotary inertia (ML2)", default="MASS", inline=True),
    ] = Field(default=None, alias="type")


class Masses(Block):
    """Masses."""

    rule = "mass"
    page = "kwd_model_mass"
    summary = "Masses and rotary inertias at nodes."
    example = "*MASS\n 12, 2500.0\n {Hang-off}, 400.0, TYPE=NO WEIGHT MASS\n 12, 900.0, TYPE=ROTARY INERTIA\n"

    keyword: Literal["MASS"] = "MASS"
    masses: Records[PointMass] = Records()


class Chain(Record):
    """Chain at a node."""

    rule = "chain"
    node: Node
    length: Annotated[Real, about("total length of the chain", unit="L", above=0, usual=ALONG)]
    mass: Annotated[
        Real,
        about(
            "mass per unit length",
            unit="M/L",
            at_least=0,
            usual=Usual(0.01, 2000.0, "the largest chains, of 0.22 m, have 960 kg/m", remark=True),
        ),
    ]
    lift: Annotated[Real | None, about("lift coefficient", unit="-", usual=LIFT)] = None


class ChainRange(ListRow):
    """Chains like that of a master node, which is defined above them."""

    master: Annotated[Ident, about("node with the chain that is repeated", names=Names.NODE)]
    number: Annotated[Whole, about("number of chains, including the master", at_least=1, usual=COUNT)]
    increment: Annotated[Whole | None, about("step between node numbers", default="1", usual=COUNT)] = None


class ChainGenerate(Record):
    """More chains."""

    rule = "chain_generate"
    generate: Annotated[ChainRange, setting("GEN", "chains at further nodes")]


class DragChains(Block):
    """Chains."""

    rule = "drag_chain"
    page = "kwd_model_dragchain"
    summary = "Chains that hang from nodes and drag on the seabed."
    example = "*DRAG CHAIN\n 12, 20.0, 140.0\n GEN=12, 5, 2\n"

    keyword: Literal["DRAG CHAIN"] = "DRAG CHAIN"
    chains: Records[Chain | ChainGenerate] = Records()
