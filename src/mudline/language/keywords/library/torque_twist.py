"""`*TORQUE-TWIST`: non-linear torsional stiffness."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import EI_CURVE, OF_ITS_CURVE
from mudline.language.keywords.values import Name, Names, Real


class TorqueTwistPoint(Row):
    """A point of a curve: torque first."""

    torque: Annotated[Real, about("torque; it comes first", unit="FL", usual=OF_ITS_CURVE)]
    twist: Annotated[Real, about("twist per unit length there", unit="1/L", usual=OF_ITS_CURVE)]


class TorqueTwistCurve(Record):
    """A curve."""

    rule = "torque_twist_curve"
    curve: Annotated[
        Name, setting("CURVE", "name of the curve, for GJ= of *GEOMETRIC SETS", defines=Names.TORQUE_TWIST)
    ]
    points: Annotated[
        Table,
        curve_points(
            TorqueTwistPoint, "two points or more, in any order", "torque-twist curve", abscissa="twist", usual=EI_CURVE
        ),
    ]


class TorqueTwist(Block):
    """Curves of the flexible format."""

    rule = "torque_twist"
    page = "kwd_model_torquetwist"
    summary = "Curves of torque against twist: non-linear torsional stiffness, named by GJ= of *GEOMETRIC SETS."
    tabular = True
    example = "*TORQUE-TWIST\n CURVE=Pipe\n 0.0, 0.0\n 2.0E4, 0.01\n 3.0E4, 0.04\n"

    keyword: Literal["TORQUE-TWIST"] = "TORQUE-TWIST"
    curves: list[TorqueTwistCurve] = []


BLOCK = TorqueTwist
