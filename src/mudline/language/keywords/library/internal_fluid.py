"""`*INTERNAL FLUID`: what flows in the pipes."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.usual import Usual
from mudline.language.keywords.values import Name, Names, Real

_ONE_LINE = "the manual prints the line over several: it is one"
_Switch = Literal["INCLUDE", "EXCLUDE"] | None


class FluidSet(Record):
    """The fluid in a set; it flows from the first element of the set to the last."""

    rule = "fluid_set"
    set_name: Annotated[Name | None, setting("SET", "element set", default="ALL", names=Names.SET)] = Field(
        default=None, alias="set"
    )
    level: Annotated[
        Real,
        about(
            "height of its free surface above the mudline",
            unit="L",
            usual=Usual(high=300.0, why="no line rises higher", of="m above the water"),
        ),
    ]
    density: Annotated[
        Real,
        about(
            "mass density",
            unit="M/L3",
            at_least=0,
            usual=Usual(1.0, 2600.0, "from gas to heavy mud", meant=850.0, within=8.0),
        ),
    ]
    pressure: Annotated[
        Real | None,
        about(
            "pressure above the hydrostatic one",
            unit="F/L2",
            default="0",
            usual=Usual(-1e7, 3e8, "wells have up to 2000 bar"),
        ),
    ] = None
    velocity: Annotated[
        Real | None,
        about(
            "velocity; a negative one turns the flow",
            unit="L/T",
            default="0",
            usual=Usual(-100.0, 100.0, "faster flow erodes steel"),
        ),
    ] = None
    coriolis: Annotated[
        _Switch, setting("CORIOLIS", "Coriolis forces", default="INCLUDE", inline=True, inferred=_ONE_LINE)
    ] = None
    centrifugal: Annotated[_Switch, setting("CENTRIFUGAL", "centrifugal forces", default="INCLUDE", inline=True)] = None
    axial_inertia: Annotated[_Switch, setting("AXIAL_INERTIA", "inertia along", default="INCLUDE", inline=True)] = None
    lateral_inertia: Annotated[
        _Switch, setting("LATERAL_INERTIA", "inertia across", default="INCLUDE", inline=True)
    ] = None
    dynamic_pressure: Annotated[
        _Switch, setting("DYNAMIC_PRESSURE", "pressure of the flow", default="INCLUDE", inline=True)
    ] = None


class InternalFluid(Block):
    """Fluids."""

    rule = "internal_fluid"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "kwd_loadcase_internalfluid"
    summary = "Fluid in pipes by element set: level, density, pressure, velocity, and which of its forces count."
    example = "*INTERNAL FLUID\n SET=ALL\n 300.0, 850.0, 2.0E6, 3.0, CORIOLIS=EXCLUDE\n"

    keyword: Literal["INTERNAL FLUID"] = "INTERNAL FLUID"
    sets: list[FluidSet] = []


BLOCK = InternalFluid
