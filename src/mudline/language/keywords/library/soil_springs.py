"""Soil springs: curves of resistance against displacement, by depth or by node."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *


class SoilPoint(Row):
    """Point of a curve: resistance first."""

    resistance: Annotated[
        Real,
        about(
            "soil resistance; it comes first", unit="F/L", inferred="P is per unit length, as T is", usual=OF_ITS_CURVE
        ),
    ]
    displacement: Annotated[
        Real,
        about(
            "displacement of the pipe against the soil",
            unit="L",
            usual=Usual(-5.0, 5.0, "soil yields within a few diameters", typical=0.05, within=30.0),
        ),
    ]


_CURVE = curve_points(
    SoilPoint,
    "points of the curve: resistance and displacement",
    "soil spring curve",
    abscissa="displacement",
    ends="value",
    usual=SOIL_CURVES,
)


class DepthCurve(OpenRecord):
    """Curve at a depth."""

    rule = "depth_curve"
    depth: Annotated[
        Real,
        setting(
            "DEPTH",
            "depth below the mudline, negative above it",
            unit="L",
            usual=Usual(-500.0, 500.0, "piles are no longer", remark=True),
        ),
    ]
    points: Annotated[
        Table,
        _CURVE,
    ]


class NodeCurve(OpenRecord):
    """Curve at a node."""

    rule = "node_curve"
    node: Annotated[
        Ident,
        setting("NODE", "node that the curve belongs to", inferred="in place of DEPTH=", names=Names.NODE, unique=True),
    ]
    points: Annotated[
        Table,
        _CURVE,
    ]


SoilCurves = list[DepthCurve | NodeCurve]
CurvesFile = Annotated[Name | None, setting("FILE", "file with the curves, instead of lines", names=Names.FILE)]


_OTHERS = "the types of other soil models are not public: the lines of one are passed through unchanged"


class LateralSprings(OpenRecord):
    """Curves of a set."""

    rule = "lateral_springs"
    type_: Annotated[
        Literal["USER"] | Other | None,
        setting("TYPE", "curves given by points", default="USER", inferred=_OTHERS, opaque=()),
    ] = Field(default=None, alias="type")
    set_name: Annotated[Name | None, setting("SET", "element set that the curves hold for", names=Names.SET)] = Field(
        default=None, alias="set"
    )
    file: CurvesFile = None
    curves: SoilCurves = []


class LateralSoil(OpenBlock):
    """Lateral soil springs."""

    rule = "p_y"
    subject = "seabed"
    facts = Facts(soil_springs=True)
    page = "kwd_model_py"
    summary = "Lateral soil springs by set and depth: points of resistance P and displacement y, resistance first."
    tabular = True
    example = (
        "*P-Y\n TYPE=USER\n SET=Conductor\n DEPTH=0.0\n 0.0, 0.0\n 4000.0, 0.01\n 9000.0, 0.1\n"
        " DEPTH=10.0\n 0.0, 0.0\n 40000.0, 0.01\n 90000.0, 0.1\n"
    )

    keyword: Literal["P-Y"] = "P-Y"
    sets: Records[LateralSprings] = Records()


class AxialSprings(OpenRecord):
    """Curves of a set."""

    rule = "axial_springs"
    set_name: Annotated[Name | None, setting("SET", "element set that the curves hold for", names=Names.SET)] = Field(
        default=None, alias="set"
    )
    file: CurvesFile = None
    curves: SoilCurves = []


class AxialSoil(OpenBlock):
    """Axial soil springs."""

    rule = "t_z"
    subject = "seabed"
    facts = Facts(soil_springs=True)
    page = "kwd_model_tz"
    summary = "Axial soil springs by set and depth: points of resistance T and displacement z, resistance first."
    tabular = True
    example = "*T-Z\n SET=Conductor\n DEPTH=0.0\n 0.0, 0.0\n 1500.0, 0.005\n DEPTH=10.0\n 0.0, 0.0\n 12000.0, 0.005\n"

    keyword: Literal["T-Z"] = "T-Z"
    sets: Records[AxialSprings] = Records()
