"""`*TAPER`: tapered stress joints, whose diameters change linearly along an element set."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *

_START = "the joint starts with the first element of its set, in the order of the set's lines"
_PART = "the page was seen only in part: its default is that of the buoyancy diameter"
_GROWS = Usual(0.2, 5.0, "beyond it the wall is twice the bore", of="/do", code="UNT006")
_GOES_ON = Usual(0.2, 5.0, "the bore goes on", of="/di", code="UNT006")


def _wider(outer: str) -> Usual:
    return Usual(high=11.5, why="coatings and strakes are no wider", of=f"/{outer}", code="UNT006")


class TaperSection(Row):
    """Property line: material, and diameters at both ends."""

    e: Annotated[Real, about("Young's modulus", unit="F/L2", at_least=0, usual=YOUNG)] = Field(alias="E")
    g: Annotated[Real, about("shear modulus", unit="F/L2", at_least=0, usual=SHEAR)] = Field(alias="G")
    density: Annotated[Real, about("density of the wall", unit="M/L3", at_least=0, usual=WALL)]
    di: Annotated[
        Real, about("internal diameter at the start", unit="L", at_least=0, inferred=_START, usual=STEEL_BORE)
    ] = Field(alias="Dis")
    do: Annotated[
        Real, about("external diameter at the start", unit="L", above=0, usual=(WIDTH, PIPE_WALL, OUTER_WIDTH))
    ] = Field(alias="Dos")
    do_end: Annotated[Real, about("external diameter at the end", unit="L", above=0, usual=(WIDTH, _GROWS))] = Field(
        alias="Doe"
    )
    di_end: Annotated[
        Real | None, about("internal diameter at the end", unit="L", default="Dis", at_least=0, usual=_GOES_ON)
    ] = Field(None, alias="Die")
    db: Annotated[
        Real | None,
        about("buoyancy diameter at the start", unit="L", default="Dos", at_least=0, usual=_wider("do")),
    ] = Field(None, alias="Dbs")
    db_end: Annotated[
        Real | None,
        about("buoyancy diameter at the end", unit="L", default="Doe", at_least=0, usual=_wider("do_end")),
    ] = Field(None, alias="Dbe")
    dd: Annotated[
        Real | None,
        about("drag diameter at the start", unit="L", default="Dos", at_least=0, inferred=_PART, usual=_wider("do")),
    ] = Field(None, alias="Dds")
    dd_end: Annotated[
        Real | None,
        about("drag diameter at the end", unit="L", default="Doe", at_least=0, inferred=_PART, usual=_wider("do_end")),
    ] = Field(None, alias="Dde")


class TaperedJoint(Record):
    """Joint."""

    rule = "tapered_joint"
    set_name: Annotated[
        Name, setting("SET", "element set; it has no line in *GEOMETRIC SETS", names=Names.SET, unique=True)
    ] = Field(alias="set")
    section: Annotated[TaperSection, about("its properties")]
    compression_check: Annotated[
        Name | None, setting("COMPRESSION CHECK", "AUTOMATIC, NONE or a number", default="AUTOMATIC")
    ] = None


class TaperedJoints(Block):
    """Joints."""

    rule = "taper"
    facts = Facts(gives=("sections",), later_wins=True)
    page = "kwd_model_taper"
    summary = "Tapered stress joints: material, and diameters that change linearly along an element set."
    example = "*TAPER\n SET=ALL\n 207.0E9, 79.6E9, 7850.0, 0.2731, 0.3239, 0.4064\n"

    keyword: Literal["TAPER"] = "TAPER"
    sets: Records[TaperedJoint] = Records()
