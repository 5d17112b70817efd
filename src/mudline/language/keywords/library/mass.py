"""`*MASS`: point masses and inertias."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.lists import Node
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.usual import Usual
from mudline.language.keywords.values import Real


class PointMass(Record):
    """A mass at a node."""

    rule = "point_mass"
    node: Node
    mass: Annotated[
        Real,
        about(
            "mass, or rotary inertia", unit="M", at_least=0, usual=Usual(high=1e7, why="heavier is a hull", remark=True)
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
    masses: list[PointMass] = []


BLOCK = Masses
