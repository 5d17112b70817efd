"""`*SEABED PROFILE`: a seabed that is not flat."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block
from mudline.language.keywords.usual import DIRECTION, MODEL
from mudline.language.keywords.values import Facts, Name, Names, Real

_SETTINGS = ("INTERPOLATION", "SLOPE", "FILE")
_NEEDS = {"SLOPING": ("SLOPE",), "2D": ("FILE",), "3D": ("FILE",)}
_TAKES = {"SLOPING": ("SLOPE",), "2D": ("INTERPOLATION", "FILE"), "3D": ("INTERPOLATION", "FILE")}
_CUBIC = {"2D": ("CUBIC SPLINE", "CUBIC BESSEL"), "3D": ("CUBIC",)}


class SeabedProfile(Block):
    """A slope, or a profile from a file."""

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
    def _fits(self) -> SeabedProfile:
        """Each type has its own settings."""
        given = [key for key in _SETTINGS if getattr(self, key.lower()) is not None]
        for key in _NEEDS[self.type_]:
            if key not in given:
                raise ValueError(f"TYPE={self.type_} needs {key}=")
        for key in given:
            if key not in _TAKES[self.type_]:
                raise ValueError(f"TYPE={self.type_} takes no {key}=")
        allowed = ("LINEAR", *_CUBIC.get(self.type_, ()))
        if self.interpolation and self.interpolation not in allowed:
            raise ValueError(f"TYPE={self.type_} takes INTERPOLATION={' or '.join(allowed)}, not {self.interpolation}")
        return self


BLOCK = SeabedProfile
