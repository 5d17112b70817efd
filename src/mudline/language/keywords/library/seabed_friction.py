"""`*SEABED FRICTION`: friction in two directions, each with its own limit (extension)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import ANY, DIRECTION, FRICTION, Usual
from mudline.language.keywords.values import Facts, Name, Names, Real


class Coefficients(Row):
    """Values of COEFFICIENTS=."""

    first: Annotated[Real, about("friction coefficient along u1", unit="-", at_least=0, usual=FRICTION)]
    second: Annotated[Real, about("friction coefficient along u2", unit="-", at_least=0, usual=FRICTION)]


class TangentialStiffness(Row):
    """Values of STIFFNESS=."""

    first: Annotated[Real, about("tangential spring of a node along u1", unit="F/L", above=0, usual=ANY)]
    second: Annotated[
        Real | None,
        about("tangential spring of a node along u2", unit="F/L", default="as along u1", above=0, usual=ANY),
    ] = None


class Peak(Row):
    """Values of PEAK=."""

    factor: Annotated[
        Real,
        about(
            "lateral resistance over the normal force at breakout",
            unit="-",
            above=0,
            usual=Usual(high=10.0, why="a buried pipe has 1 to 5", remark=True),
        ),
    ]
    displacement: Annotated[
        Real | None,
        about(
            "displacement from the place of first contact at which it is reached",
            unit="L",
            above=0,
            default="none",
            usual=Usual(high=5.0, why="soil yields within a few diameters", remark=True),
        ),
    ] = None


class Residual(Row):
    """Values of RESIDUAL=."""

    factor: Annotated[
        Real,
        about(
            "lateral resistance over the normal force after breakout",
            unit="-",
            at_least=0,
            usual=Usual(high=10.0, why="a buried pipe has 1 to 5", remark=True),
        ),
    ]
    displacement: Annotated[
        Real,
        about(
            "displacement at which it is reached",
            unit="L",
            above=0,
            usual=Usual(high=5.0, why="soil yields within a few diameters", remark=True),
        ),
    ]


class FrictionSet(Record):
    """What one SET= gets, taken whole."""

    rule = "friction_set"
    set_name: Annotated[Name, setting("SET", "element set", names=Names.SET)] = Field(alias="set")
    coefficients: Annotated[Coefficients, setting("COEFFICIENTS", "Coulomb coefficients")]
    stiffness: Annotated[TangentialStiffness, setting("STIFFNESS", "tangential springs below the limit")]
    directions: Annotated[
        Real | Literal["AXIAL"] | None,
        setting(
            "DIRECTIONS",
            "AXIAL: u1 along the line in the plane of the seabed; an angle: u1 from +Y about its normal",
            unit="deg",
            default="AXIAL",
            usual=DIRECTION,
        ),
    ] = None
    criterion: Annotated[
        Literal["BOX", "ELLIPSE"] | None,
        setting("CRITERION", "each direction by itself, or both on one ellipse", default="BOX"),
    ] = None
    lateral: Annotated[
        Literal["COULOMB", "PEAK-RESIDUAL", "F114"] | None,
        setting(
            "LATERAL",
            "across the line: the limit of COEFFICIENTS=; a breakout that is had once and a residual, by PEAK= and "
            "RESIDUAL=; or by PEAK= and the embedment after DNV-RP-F114",
            default="COULOMB",
        ),
    ] = None
    peak: Annotated[Peak | None, setting("PEAK", "breakout")] = None
    residual: Annotated[Residual | None, setting("RESIDUAL", "resistance after breakout")] = None


class SeabedFriction(Block):
    """Friction by set."""

    rule = "seabed_friction"
    subject = "seabed"
    facts = Facts(extension=True, later_wins=True, computed_in="friction")
    summary = "Friction in two directions with constant tangential springs, by element set (extension)."
    example = "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0.3, 0.6\n STIFFNESS=20000.0, 40000.0\n DIRECTIONS=AXIAL\n"

    keyword: Literal["SEABED FRICTION"] = "SEABED FRICTION"
    sets: list[FrictionSet] = []


BLOCK = SeabedFriction
