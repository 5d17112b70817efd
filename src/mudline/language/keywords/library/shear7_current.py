"""`*CURRENT` of SHEAR7: current profiles for vortex-induced vibration."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Row, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import COUNT, CURRENT, MODEL, POSITION
from mudline.language.keywords.values import Real, Whole


class VelocityPoint(Row):
    """The velocity at an elevation."""

    elevation: Annotated[
        Real, about("elevation; of XL the place along the line over its length", unit="L", usual=POSITION)
    ]
    velocity: Annotated[Real, about("velocity there", unit="L/T", usual=CURRENT)]


class ShearCurrent(Block):
    """A current profile."""

    rule = "shear7_current"
    sections = ("SHEAR7",)
    subject = "loads"
    page = "kwd_shear7_current"
    summary = "A current profile for vortex-induced vibration, and how probable it is."
    tabular = True
    example = "*CURRENT\n PROBABILITY=0.25, ID=1, OPTION=ASCEND\n 0.0, 0.1\n 300.0, 0.9\n"

    keyword: Literal["CURRENT"] = "CURRENT"
    probability: Annotated[
        Real | None, setting("PROBABILITY", "how probable it is", default="1", at_least=0, at_most=1, usual=MODEL)
    ] = None
    number: Annotated[Whole | None, setting("ID", "number of the profile", inline=True, usual=COUNT)] = None
    option: Annotated[
        Literal["ASCEND", "DESCEND", "XL"] | None,
        setting("OPTION", "up from X = 0, down from the water line, or along the line", default="ASCEND", inline=True),
    ] = None
    profile: Annotated[
        Table, curve_points(VelocityPoint, "profile; at least two points", "current profile", abscissa="elevation")
    ]


BLOCK = ShearCurrent
