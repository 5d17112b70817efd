"""Force-embedment curves."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *

_PER_LENGTH = "the force is per unit length, as is the linear stiffness that the curve replaces"
POINTS = "points of the curve in any order; at least two"


class CurvePoint(Row):
    """Point of a force-embedment curve."""

    ratio: Annotated[
        Real,
        about(
            "embedment ratio: mean depth of the element's nodes over external diameter",
            unit="-",
            heading="Embedment Ratio",
            usual=MODEL,
        ),
    ]
    force: Annotated[
        Real,
        about(
            "seabed force at that ratio", unit="F/L", inferred=_PER_LENGTH, heading="Seabed Force", usual=OF_ITS_CURVE
        ),
    ]


class StiffnessCurve(Record):
    """Curve."""

    rule = "stiffness_curve"
    name: Annotated[Name, setting("CURVE", "curve name, used by STIFFNESS= of *SEABED PROPERTIES", defines=Names.CURVE)]
    points: Annotated[
        Table,
        curve_points(CurvePoint, POINTS, "force-embedment curve", abscissa="ratio", ends="slope", usual=CURVE_FORCE),
    ]


class SeabedStiffness(Block):
    """Force-embedment curves."""

    rule = "seabed_stiffness"
    subject = "seabed"
    facts = Facts(
        supersedes=True,
        defines="curves",
        computed_in="normal-laws",
        instead_of={"SET": "name the curve by CURVE= here, and give it to the set in STIFFNESS= of *SEABED PROPERTIES"},
    )
    page = "kwd_model_seabedstiffness"
    summary = "Force-embedment curves of an elastic seabed, by name."
    tabular = True
    example = "*SEABED STIFFNESS\n CURVE=clay\n 0.0, 0.0\n 0.1, 1200.0\n 0.5, 10000.0\n"

    keyword: Literal["SEABED STIFFNESS"] = "SEABED STIFFNESS"
    curves: Records[StiffnessCurve] = Records()


class EmbedmentCurve(Record):
    """Curve, and the set for which it holds."""

    rule = "embedment_curve"
    set_name: Annotated[
        Name | None,
        setting("SET", "element set of the curve", default="ALL", inferred=NO_SET, names=Names.SET),
    ] = Field(default=None, alias="set")
    points: Annotated[
        Table,
        curve_points(CurvePoint, POINTS, "force-embedment curve", abscissa="ratio", ends="slope", usual=CURVE_FORCE),
    ]


class Embedment(Block):
    """Force-embedment curves by set."""

    rule = "embedment"
    subject = "seabed"
    facts = Facts(
        superseded_by=(
            Successor("SEABED STIFFNESS"),
            Successor("SEABED PROPERTIES", "STIFFNESS"),
        ),
        defines="curves",
        beside=("ELASTIC SURFACE",),
        computed_in="normal-laws",
    )
    page = "kwd_model_embedment"
    summary = "Force-embedment curves of an elastic seabed, by element set (superseded by *SEABED STIFFNESS)."
    tabular = True
    example = "*EMBEDMENT\n SET=Flowline\n 0.0, 0.0\n 0.1, 1200.0\n 0.5, 10000.0\n"

    keyword: Literal["EMBEDMENT"] = "EMBEDMENT"
    curves: Records[EmbedmentCurve] = Records()
