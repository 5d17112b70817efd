"""`*MOMENT-CURVATURE`: non-linear bending stiffness."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import EI_CURVE, OF_ITS_CURVE
from mudline.language.keywords.values import Name, Names, Real


class MomentCurvaturePoint(Row):
    """A point of a curve: moment first."""

    moment: Annotated[Real, about("bending moment; it comes first", unit="FL", usual=OF_ITS_CURVE)]
    curvature: Annotated[Real, about("curvature there", unit="1/L", usual=OF_ITS_CURVE)]


class MomentCurvatureCurve(Record):
    """A curve."""

    rule = "moment_curvature_curve"
    curve: Annotated[
        Name,
        setting("CURVE", "name of the curve, for EIYY= and EIZZ= of *GEOMETRIC SETS", defines=Names.MOMENT_CURVATURE),
    ]
    points: Annotated[
        Table,
        curve_points(
            MomentCurvaturePoint,
            "points in any order; at least two",
            "moment-curvature curve",
            abscissa="curvature",
            usual=EI_CURVE,
        ),
    ]


class MomentCurvature(Block):
    """Curves of the flexible format."""

    rule = "moment_curvature"
    page = "kwd_model_momentcurvature"
    summary = (
        "Curves of moment against curvature: non-linear bending stiffness, named by EIYY= and EIZZ= of *GEOMETRIC SETS."
    )
    tabular = True
    example = "*MOMENT-CURVATURE\n CURVE=Pipe\n 0.0, 0.0\n 5.0E4, 0.01\n 7.0E4, 0.03\n"

    keyword: Literal["MOMENT-CURVATURE"] = "MOMENT-CURVATURE"
    curves: list[MomentCurvatureCurve] = []


BLOCK = MomentCurvature
