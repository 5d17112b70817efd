"""Shape of the seabed: planes and profiles."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *


class PlanePoint(Row):
    """Values of POINT=."""

    x: Annotated[Real, about("elevation of the point", unit="L", usual=POSITION)]
    y: Annotated[Real, about("horizontal coordinate Y", unit="L", usual=POSITION)]
    z: Annotated[Real, about("horizontal coordinate Z", unit="L", usual=POSITION)]


class PlaneBounds(Row):
    """Values of BOUNDS=: a closed range; an empty field is no bound on that side."""

    y_min: Annotated[Real | None, about("smallest Y", unit="L", default="unbounded", usual=POSITION)] = None
    y_max: Annotated[Real | None, about("largest Y", unit="L", default="unbounded", usual=POSITION)] = None
    z_min: Annotated[Real | None, about("smallest Z", unit="L", default="unbounded", usual=POSITION)] = None
    z_max: Annotated[Real | None, about("largest Z", unit="L", default="unbounded", usual=POSITION)] = None


class Plane(Record):
    """Plane."""

    rule = "seabed_plane"
    name: Annotated[Name, setting("PLANE", "name of the plane")]
    point: Annotated[PlanePoint | None, setting("POINT", "a point of the plane; mandatory")] = None
    slope: Annotated[
        Real | None,
        setting(
            "SLOPE",
            "steepest slope; positive rises towards +Y turned by DIRECTION=; mandatory",
            unit="deg",
            usual=MODEL,
        ),
    ] = None
    direction: Annotated[
        Real | None,
        setting(
            "DIRECTION",
            "angle from +Y, counter-clockwise about X",
            unit="deg",
            default="0",
            inline=True,
            behind="SLOPE",
            usual=DIRECTION,
        ),
    ] = None
    bounds: Annotated[
        PlaneBounds | None, setting("BOUNDS", "horizontal extent, its edges included", default="unbounded")
    ] = None


class SeabedPlanes(Block):
    """Plane surfaces; of the planes over a point the highest is the seabed there."""

    rule = "seabed_planes"
    subject = "seabed"
    facts = Facts(extension=True, computed_in="shapes-of-the-seabed")
    summary = "A seabed of several plane surfaces, of which the highest at a place is the seabed (extension)."
    example = (
        "*SEABED PLANES\n PLANE=shelf\n POINT=0.0, 0.0, 0.0\n SLOPE=0.0\n"
        " PLANE=slope\n POINT=0.0, 200.0, 0.0\n SLOPE=5.0, DIRECTION=0.0\n BOUNDS=200.0, 900.0, -500.0, 500.0\n"
    )

    keyword: Literal["SEABED PLANES"] = "SEABED PLANES"
    planes: Records[Plane] = Records()


_SETTINGS = ("INTERPOLATION", "SLOPE", "FILE")
_NEEDS = {"SLOPING": ("SLOPE",), "2D": ("FILE",), "3D": ("FILE",)}
_TAKES = {"SLOPING": ("SLOPE",), "2D": ("INTERPOLATION", "FILE"), "3D": ("INTERPOLATION", "FILE")}
_CUBIC = {"2D": ("CUBIC SPLINE", "CUBIC BESSEL"), "3D": ("CUBIC",)}


class SeabedProfile(Block):
    """Slope, or a profile from a file."""

    rule = "seabed_profile"
    subject = "seabed"
    facts = Facts(supersedes=True, computed_in="shapes-of-the-seabed")
    page = "kwd_model_seabedprofile"
    summary = "A seabed that is not flat: a uniform slope, or a profile from a file; without it X = 0."
    example = "*SEABED PROFILE\n TYPE=SLOPING\n DIRECTION=30.0\n SLOPE=2.5\n"

    keyword: Literal["SEABED PROFILE"] = "SEABED PROFILE"
    type_: Annotated[
        Literal["SLOPING", "2D", "3D"], setting("TYPE", "uniform slope, profile in a plane, or surface")
    ] = Field(alias="type")
    interpolation: Annotated[
        Literal["LINEAR", "CUBIC SPLINE", "CUBIC BESSEL", "CUBIC"] | None,
        setting("INTERPOLATION", "between points: 2D takes CUBIC SPLINE and CUBIC BESSEL, 3D CUBIC", default="LINEAR"),
    ] = None
    direction: Annotated[
        Real | None,
        setting(
            "DIRECTION",
            "turns the profile counter-clockwise about X",
            unit="deg",
            default="0",
            inline=True,
            behind="INTERPOLATION",
            inferred=("the profile is taken at Y cos + Z sin, from `counter-clockwise about X`; for an elastic seabed"),
            usual=DIRECTION,
        ),
    ] = None
    slope: Annotated[
        Real | None,
        setting(
            "SLOPE",
            "of SLOPING: slope of a plane through the origin, positive towards +Y; mandatory",
            unit="deg",
            usual=MODEL,
        ),
    ] = None
    file: Annotated[
        Name | None,
        setting(
            "FILE",
            "of 2D and 3D: compiled profile (.fcsbd), or for linear 2D a text file of lines `Y, elevation`; mandatory",
            names=Names.FILE,
        ),
    ] = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the settings are those of the type."""
        keys = [key for key in _SETTINGS if getattr(self, key.lower()) is not None]
        for key in _NEEDS[self.type_]:
            if key not in keys:
                raise ValueError(f"TYPE={self.type_} needs {key}=")
        for key in keys:
            if key not in _TAKES[self.type_]:
                raise ValueError(f"TYPE={self.type_} takes no {key}=")
        if self.type_ == "3D" and self.direction is not None:
            raise ValueError("TYPE=3D takes no DIRECTION=: it turns the profile of 2D and SLOPING")
        allowed = ("LINEAR", *_CUBIC.get(self.type_, ()))
        if self.interpolation and self.interpolation not in allowed:
            raise ValueError(f"TYPE={self.type_} takes INTERPOLATION={' or '.join(allowed)}, not {self.interpolation}")
        return self
