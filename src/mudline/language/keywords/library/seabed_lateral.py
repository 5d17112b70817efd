"""Resistance of the seabed along its surface: friction, and trench walls."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *

_NEEDS = "; a direction whose coefficient is 0 stays free"


class LinearFriction(OpenBlock):
    """Stiffnesses in place of friction; if both are zero the model is fixed."""

    rule = "friction"
    sections = ("LOAD CASE", "MODES")
    subject = "seabed"
    page = "kwd_loadcase_friction"
    summary = "Stiffnesses in place of seabed friction in the frequency domain and in modes; both 0: fixed."
    example = "*FRICTION\n 500.0, 250.0\n"

    keyword: Literal["FRICTION"] = "FRICTION"
    longitudinal: Annotated[
        Real | None,
        about(
            "stiffness along the line" + _NEEDS,
            unit="F/L2",
            default="0",
            inferred="per unit length",
            usual=Usual(95.0, 2.1e11, remark=True),
        ),
    ] = None
    transverse: Annotated[
        Real | None,
        about(
            "stiffness across the line" + _NEEDS,
            unit="F/L2",
            default="0",
            inferred="per unit length",
            usual=Usual(95.0, 2.1e11, remark=True),
        ),
    ] = None


NO_FRICTION = OpaqueKeyword(
    keyword="NO FRICTION",
    summary="A run without seabed friction, whatever coefficients the seabed has.",
    example="*NO FRICTION\n",
    certain="Friction acts if any coefficient is not zero; this keyword suppresses it for a run.",
    inferred="It belongs in $LOAD CASE and has no lines; in another section it is not reported.",
    sections=("LOAD CASE",),
    sections_inferred=True,
    subject="seabed",
)


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
    """Friction of one SET=, taken as a whole."""

    rule = "friction_set"
    set_name: SetName = Field(alias="set")
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
    sets: Records[FrictionSet] = Records()


class TrenchGeometry(Row):
    """Values of GEOMETRY=."""

    depth: Annotated[Real, about("depth of the trench", unit="L", above=0, usual=MODEL)]
    bottom_width: Annotated[Real, about("width at the bottom", unit="L", above=0, usual=MODEL)]
    upper_width: Annotated[Real, about("width at the top", unit="L", above=0, usual=MODEL)]


class ResistancePoint(Row):
    """Row below PEAK=TABLE."""

    offset: Annotated[
        Real, about("distance from the centreline; not negative, larger in each row", unit="L", usual=MODEL)
    ]
    resistance: Annotated[Real, about("lateral resistance per unit length there", unit="F/L", at_least=0, usual=MODEL)]


class TrenchResidual(Row):
    """Values of RESIDUAL=."""

    resistance: Annotated[
        Real, about("lateral resistance per unit length beyond the peak", unit="F/L", at_least=0, usual=MODEL)
    ]
    displacement: Annotated[
        Real, about("distance from the centreline beyond which it holds", unit="L", above=0, usual=MODEL)
    ]


class Centreline(Row):
    """Values of CENTRELINE=: two points of a straight line."""

    y0: Annotated[Real, about("Y of the first point", unit="L", usual=POSITION)]
    z0: Annotated[Real, about("Z of the first point", unit="L", usual=POSITION)]
    y1: Annotated[Real, about("Y of the second point", unit="L", usual=POSITION)]
    z1: Annotated[Real, about("Z of the second point", unit="L", usual=POSITION)]


class TrenchSet(Record):
    """Trench of one SET=, taken as a whole."""

    rule = "trench_set"
    set_name: SetName = Field(alias="set")
    geometry: Annotated[TrenchGeometry, setting("GEOMETRY", "depth and widths of the trench")]
    model: Annotated[
        Literal["PEAK", "WALL"] | None,
        setting(
            "MODEL",
            "PEAK: the resistance that PEAK= gives, which is then mandatory; WALL: that of sloped walls, by GEOMETRY= "
            "and friction",
            default="PEAK",
        ),
    ] = None
    peak: Annotated[
        Real | Literal["TABLE"] | None,
        setting(
            "PEAK",
            "peak lateral resistance of the walls per unit length; TABLE: by the distance from the centreline, in the "
            "rows below",
            unit="F/L",
            at_least=0,
            usual=MODEL,
        ),
    ] = None
    table: Annotated[
        Table | None,
        rows(
            ResistancePoint, "rows of PEAK=TABLE, at least two; linear between them, the first holds inside, 0 outside"
        ),
    ] = None
    level: Annotated[
        Literal["UNCHANGED", "LOWERED"] | None,
        setting(
            "LEVEL", "LOWERED: the seabed lies lower by the depth of the trench between its walls", default="UNCHANGED"
        ),
    ] = None
    residual: Annotated[
        TrenchResidual | None,
        setting("RESIDUAL", "resistance to which that of PEAK= falls beyond its peak, instead of to 0", default="none"),
    ] = None
    smoothing: Annotated[
        Real | None,
        setting(
            "SMOOTHING",
            "half width of parabolas in the corners of the resistance",
            unit="L",
            at_least=0,
            default="0",
            usual=MODEL,
        ),
    ] = None
    centreline: Annotated[
        Literal["LAID"] | Centreline | None,
        setting(
            "CENTRELINE",
            "LAID: through the nodes where they lie first; or two points of a straight line",
            default="LAID",
        ),
    ] = None

    @field_validator("table")
    @classmethod
    def _of_table(cls, table: Table | None, info: ValidationInfo) -> Table | None:
        """Return the table; raise ValueError for rows that are not below PEAK=TABLE."""
        if table is not None and "peak" in info.data and info.data["peak"] != "TABLE":
            raise ValueError("rows belong to PEAK=TABLE only: write that, or remove them")
        return table


class SeabedTrench(Block):
    """Trenches by set."""

    rule = "seabed_trench"
    subject = "seabed"
    facts = Facts(extension=True, later_wins=True, computed_in="trenches")
    tabular = True
    summary = "Lateral resistance of the walls of a trench, by element set (extension)."
    example = "*SEABED TRENCH\n SET=ALL\n GEOMETRY=0.5, 1.0, 3.0\n PEAK=2000.0\n CENTRELINE=LAID\n"

    keyword: Literal["SEABED TRENCH"] = "SEABED TRENCH"
    sets: Records[TrenchSet] = Records()
