"""Loads, boundary conditions, internal fluids and winches of a load case."""

import math
from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *

_DOF = "degree of freedom: 1 vertical, 2 and 3 horizontal, 4 to 6 rotations"
_VALUE = "displacement that is imposed: a length, of a rotation degrees"
_OTHERS = "the lines of other types are not public: they are passed through unchanged"
_FOUR = "of four values the last two may be increment and degree of freedom, or degree of freedom and displacement"

Fixation = Annotated[
    Literal["RELATIVE"] | None,
    setting("FIXATION", "relative to the position where the load case begins", inline=True),
]


def _counted(value: object) -> object:
    """Return a whole number as int, so that a degree of freedom is written as it was; the sign of -0.0 is kept."""
    whole = isinstance(value, float) and value.is_integer() and math.copysign(1.0, value) > 0
    return int(value) if whole and isinstance(value, float) and value <= LARGEST_WHOLE else value


Either = Annotated[Count | Finite | Equation, Field(union_mode="left_to_right"), BeforeValidator(_counted), Kind.REAL]
"""Degree of freedom or a displacement."""


class FixedNode(Record):
    """Node that is held in a degree of freedom."""

    rule = "fixed_node"
    node: Annotated[Ident, about("node number, or its label", names=Names.NODE)]
    dof: Annotated[Whole, about(_DOF, usual=OF_A_KIND)]
    value: Annotated[Real | None, about(_VALUE, default="0", usual=OF_A_KIND, written_in=("L", "deg"))] = None
    fixation: Fixation = None


class FixedValues(ListRow):
    """First and last node, optional step between them, degree of freedom, displacement."""

    start: Annotated[WholeOrLabel, about("first node, or its label", names=Names.NODE, usual=OF_A_KIND)]
    end: Annotated[WholeOrLabel, about("last node, or its label", names=Names.NODE, usual=OF_A_KIND)]
    third: Annotated[
        Whole | None,
        about("of three values the degree of freedom, of five the increment", inferred=_FOUR, usual=OF_A_KIND),
    ] = None
    fourth: Annotated[Either | None, about("of five values the degree of freedom", inferred=_FOUR, usual=OF_A_KIND)] = (
        None
    )
    fifth: Annotated[Real | None, about(_VALUE, default="0", usual=OF_A_KIND)] = None


class FixedRange(Record):
    """Nodes that are held in a degree of freedom."""

    rule = "fixed_range"
    generate: Annotated[FixedValues, setting("GEN", "nodes from one number to another, and how they are held")]
    fixation: Fixation = None


class BoundaryType(OpenRecord):
    """Conditions of one type."""

    rule = "boundary_type"
    type_: Annotated[
        Literal["CONSTANT", "VESSEL"] | Other,
        setting(
            "TYPE", "what the conditions are; the lines of constant ones are read", inferred=_OTHERS, opaque=("VESSEL",)
        ),
    ] = Field(alias="type")
    entries: Records[FixedNode | FixedRange] = Records()


class Boundary(Block):
    """Boundary conditions."""

    rule = "boundary"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "kwd_loadcase_boundary"
    summary = "Nodes that are held, or moved, in single degrees of freedom."
    example = "*BOUNDARY\n TYPE=CONSTANT\n 1, 2\n 1, 3, 0.0, FIXATION=RELATIVE\n GEN=11, 20, 1, 6, 0.0\n"

    keyword: Literal["BOUNDARY"] = "BOUNDARY"
    types: Records[BoundaryType] = Records()


_LOAD_LINES = (
    "the lines below it, as their page was not seen: they give nodes, directions and magnitudes, or first and last "
    "elements and components, and are passed through unchanged"
)


class LoadType(OpenRecord):
    """Loads of one type."""

    rule = "load_type"
    type_: Annotated[
        Literal["CONSTANT", "DISTRIBUTED"] | Other,
        setting(
            "TYPE",
            "forces on single nodes, or on the elements from one to another",
            inferred=_LOAD_LINES,
            opaque=("CONSTANT", "DISTRIBUTED"),
        ),
    ] = Field(alias="type")


class Loads(Block):
    """Loads."""

    rule = "load"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "theory_additional_point"
    summary = "Forces on nodes, and forces along elements, in the global axes."
    example = "*LOAD\n TYPE=CONSTANT\n 12, 1, -5000.0\n"

    keyword: Literal["LOAD"] = "LOAD"
    types: Records[LoadType] = Records()


class Moments(Block):
    """Factors of moments."""

    rule = "moments"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "kwd_loadcase_moments"
    summary = "Factors of the yaw moments of a moored vessel; in mooring analyses."
    example = "*MOMENTS\n 0.5, 1.0, 0.0\n"

    keyword: Literal["MOMENTS"] = "MOMENTS"
    molin: Annotated[Real | None, about("coefficient of Molin", default="0", usual=ANY)] = None
    yaw: Annotated[Real | None, about("yaw factor of Molin", default="0", at_least=0, at_most=1, usual=ANY)] = None
    munk: Annotated[Real | None, about("factor of Munk", default="0", at_least=0, at_most=1, usual=ANY)] = None


_ONE_LINE = "the manual prints the line over several: it is one"
_Switch = Literal["INCLUDE", "EXCLUDE"] | None


class FluidSet(Record):
    """Fluid in a set; it flows from the first element of the set to the last."""

    rule = "fluid_set"
    set_name: Annotated[Name | None, setting("SET", "element set", default="ALL", names=Names.SET)] = Field(
        default=None, alias="set"
    )
    level: Annotated[
        Real,
        about(
            "height of its free surface above the mudline",
            unit="L",
            usual=(
                Usual(low=0.0, why="it is counted upwards from the mudline", remark=True),
                Usual(high=300.0, why="no line rises higher", of="m above the water"),
            ),
        ),
    ]
    density: Annotated[
        Real,
        about(
            "mass density",
            unit="M/L3",
            at_least=0,
            usual=(Usual(1.0, 2600.0, "from gas to heavy mud", typical=850.0, within=8.0), LIQUID),
        ),
    ]
    pressure: Annotated[
        Real | None,
        about(
            "pressure above the hydrostatic one",
            unit="F/L2",
            default="0",
            usual=(
                Usual(-1e7, 3e8, "wells have up to 2000 bar"),
                Usual(2e5, 3e8, "pipes are made for tens of bar", remark=True, also=(-1e7, 0.0)),
            ),
        ),
    ] = None
    velocity: Annotated[
        Real | None,
        about(
            "velocity; a negative one turns the flow",
            unit="L/T",
            default="0",
            usual=(
                Usual(-100.0, 100.0, "faster flow erodes steel"),
                Usual(-30.0, 30.0, "liquids flow at 5 m/s, gas at 20 (API RP 14E)", remark=True),
                Usual(-0.001, 0.001, "nothing flows", when="a fluid without density", remark=True),
            ),
        ),
    ] = None
    fifth: Annotated[
        Real | None, about("a number whose meaning is not known", inferred=OLDER, older=True, usual=NOT_KNOWN)
    ] = None
    inertia: Annotated[
        Whole | None, about("number for the inertia along", inferred=OLDER, older=True, usual=NOT_KNOWN)
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
    summary = "Fluid in pipes by element set: level, density, pressure, velocity, and the forces that count."
    example = "*INTERNAL FLUID\n SET=ALL\n 300.0, 850.0, 2.0E6, 3.0, CORIOLIS=EXCLUDE\n"

    keyword: Literal["INTERNAL FLUID"] = "INTERNAL FLUID"
    sets: Records[FluidSet] = Records()


def _later(than: str) -> Usual:
    return Usual(low=1.0, why="the times ascend", of=f"/{than}")


class WinchProfile(Row):
    """Velocity, and the times between which it changes."""

    velocity: Annotated[
        Real,
        about(
            "largest velocity; a negative one reels in",
            unit="L/T",
            usual=Usual(-3.0, 3.0, "winches pay out at up to 1 m/s", remark=True),
        ),
    ]
    start: Annotated[Real, about("time at which it begins", unit="T", usual=OF_THE_RUN)]
    full: Annotated[Real, about("time from which it is full", unit="T", usual=_later("start"))]
    slowing: Annotated[Real, about("time at which it begins to fall", unit="T", usual=_later("full"))]
    end: Annotated[Real, about("time from which the winch rests", unit="T", usual=_later("slowing"))]


class WinchSet(Record):
    """Elements of one winch."""

    rule = "winch_set"
    set_name: Annotated[Name, setting("SET", "element set", names=Names.SET, unique=True)] = Field(alias="set")
    length: Annotated[
        Real | None,
        setting("LENGTH", "in a static run: length that is added, or taken off", unit="L", usual=OF_THE_RUN),
    ] = None
    file: Annotated[
        Name | None,
        setting("FILE", "in the time domain: file of times and lengths", names=Names.FILE, holds=DataFile.NUMBERS),
    ] = None
    profile: Annotated[WinchProfile | None, about("in the time domain: velocity and times")] = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the winch has one of the three."""
        require_one(self, "length", "file", "profile")
        return self


class Winches(Block):
    """Winches."""

    rule = "winch"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "kwd_loadcase_winch"
    summary = "Winches: elements that grow longer or shorter during a run."
    example = "*WINCH\n SET=ALL\n 0.5, 10.0, 15.0, 60.0, 65.0\n"

    keyword: Literal["WINCH"] = "WINCH"
    sets: Records[WinchSet] = Records()
