"""Currents of a load case, and of SHEAR7."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *


class UniformCurrent(Row):
    """One velocity from the seabed to the surface."""

    velocity: Annotated[Real, about("velocity", unit="L/T", usual=CURRENT)]
    direction: Direction = None


class CurrentPoint(Row):
    """Velocity at an elevation."""

    elevation: Annotated[
        Real, about("height above X = 0 (ASCEND), or depth below the water line (DESCEND)", unit="L", usual=POSITION)
    ]
    velocity: Annotated[Real, about("velocity there", unit="L/T", usual=CURRENT)]
    direction: Direction = None


class CurrentProfile(Record):
    """Current."""

    rule = "current_profile"
    type_: Annotated[
        Literal["UNIFORM", "PIECEWISE LINEAR", "SUBROUTINE"],
        setting("TYPE", "one velocity, a profile, or a subroutine"),
    ] = Field(alias="type")
    option: Annotated[
        Literal["ASCEND", "DESCEND", "DESCENDING"] | None,
        setting(
            "OPTION",
            "of a profile: up from X = 0, or down from the water line",
            default="ASCEND",
            inline=True,
            inferred=f"DESCENDING, {OLDER}",
            older=("DESCENDING",),
        ),
    ] = None
    level: Annotated[
        Literal["MWL", "AMBIENT"] | None,
        setting("LEVEL", "of a profile: its water line", default="AMBIENT", inline=True),
    ] = None
    user: Annotated[Name | None, setting("USER", "of SUBROUTINE: file with it", names=Names.FILE, inline=True)] = None
    uniform: Annotated[UniformCurrent | None, about("current of UNIFORM")] = None
    profile: Annotated[
        Table | None,
        curve_points(CurrentPoint, "at least two points", "current profile", abscissa="elevation"),
    ] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the field of the form in TYPE=."""
        return "uniform" if values.get("type") == "UNIFORM" else "profile"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the current has the data of its type."""
        if self.type_ == "SUBROUTINE" and self.user is None:
            raise ValueError("TYPE=SUBROUTINE needs USER=, the file with it")
        if self.type_ != "SUBROUTINE":
            require_one(self, "uniform" if self.type_ == "UNIFORM" else "profile")
        if self.uniform is not None or self.profile is not None:
            require_one(self, "uniform", "profile")
        return self


class Current(Block):
    """Currents."""

    rule = "current"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "kwd_loadcase_current"
    summary = "Current: one velocity, a profile of velocities by elevation, or a subroutine."
    example = "*CURRENT\n TYPE=PIECEWISE LINEAR\n 0.0, 0.1, 180.0\n 300.0, 0.9, 180.0\n"

    keyword: Literal["CURRENT"] = "CURRENT"
    currents: Records[CurrentProfile] = Records()


class VelocityPoint(Row):
    """Velocity at an elevation."""

    elevation: Annotated[
        Real, about("elevation; of XL the place along the line over its length", unit="L", usual=POSITION)
    ]
    velocity: Annotated[Real, about("velocity there", unit="L/T", usual=CURRENT)]


class ShearCurrent(Block):
    """Current profile."""

    rule = "shear7_current"
    sections = ("SHEAR7",)
    subject = "loads"
    page = "kwd_shear7_current"
    summary = "Current profile for vortex-induced vibration, and its probability."
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
