"""`*PIP CONNECTION`: what holds pipes in or on each other."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.lists import Node
from mudline.language.keywords.model import Block, ListRow, Record
from mudline.language.keywords.usual import ANY, COUNT
from mudline.language.keywords.values import Ident, Name, Names, Real, Whole

_CURVES = "the curve is one of *PIP STIFFNESS, as of *LINES PIP"
_SLIDING = "the form of many sliding connections: that of one, with GEN= in place of its node"
Stiffness = Annotated[
    Real | None, setting("STIFFNESS", "stiffness, or give CURVE=", unit="F/L", inline=True, usual=ANY)
]
CurveName = Annotated[
    Name | None,
    setting(
        "CURVE", "curve of *PIP STIFFNESS, or give STIFFNESS=", inline=True, inferred=_CURVES, names=Names.PIP_STIFFNESS
    ),
]
AxialStiffness = Annotated[
    Real | None,
    setting("AXIAL_STIFF", "of sliding ones: axial stiffness", unit="F/L", at_least=0, inline=True, usual=ANY),
]
AxialCurve = Annotated[Name | None, setting("AXIAL_NONLINEAR", "of sliding ones: axial curve", inline=True)]


class PipRange(ListRow):
    """First and last node, and the step between them."""

    start: Annotated[Ident, about("first node", names=Names.NODE)]
    end: Annotated[Ident, about("last node", names=Names.NODE)]
    increment: Annotated[Whole | None, about("step", default="1", at_least=1, usual=COUNT)] = None


class PipPair(Record):
    """A node that is held at another one, or slides along a set."""

    rule = "pip_pair"
    primary: Node
    secondary: Annotated[Ident | None, about("node that it is held at, or give SET=", names=Names.NODE)] = None
    set_name: Annotated[Name | None, setting("SET", "set that it slides along", names=Names.SET, inline=True)] = Field(
        default=None, alias="set"
    )
    stiffness: Stiffness = None
    curve: CurveName = None
    axial_stiffness: AxialStiffness = None
    axial_curve: AxialCurve = None


class PipPairs(Record):
    """Many of them."""

    rule = "pip_pairs"
    generate: Annotated[PipRange, setting("GEN", "primary nodes")]
    second: Annotated[PipRange | None, setting("GEN", "secondary nodes, or give SET=", inline=True)] = None
    set_name: Annotated[
        Name | None, setting("SET", "set that they slide along", names=Names.SET, inline=True, inferred=_SLIDING)
    ] = Field(default=None, alias="set")
    stiffness: Stiffness = None
    curve: CurveName = None
    axial_stiffness: AxialStiffness = None
    axial_curve: AxialCurve = None


class PipConnections(Block):
    """Connections."""

    rule = "pip_connection"
    page = "kwd_model_pipconnection"
    summary = "Connections of pipes in or on each other: between two nodes, or sliding along a set."
    example = "*PIP CONNECTION\n 12, 112, STIFFNESS=1.0E6\n GEN=13, 20, GEN=113, 120, CURVE=Spacer\n"

    keyword: Literal["PIP CONNECTION"] = "PIP CONNECTION"
    orientation: Annotated[Name | None, setting("ORIENTATION", "from present or from initial positions")] = None
    bandwidth: Annotated[Literal["UPDATED"] | None, setting("BANDWIDTH", "renumbered as the pipes slide")] = None
    tolerance: Annotated[
        Real | None, setting("PENETRATION_TOLERANCE", "tolerance of penetration", at_least=0, usual=ANY)
    ] = None
    connections: list[PipPair | PipPairs] = []


BLOCK = PipConnections
