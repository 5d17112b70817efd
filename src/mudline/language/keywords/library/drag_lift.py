"""`*DRAG LIFT`: lift of lines that lie close to the seabed."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import ANY, LIFT
from mudline.language.keywords.values import Name, Names, Real


class LiftPoint(Row):
    """A point of a curve."""

    ratio: Annotated[Real, about("gap to the seabed over drag diameter", unit="-", usual=ANY)]
    coefficient: Annotated[Real, about("drag lift coefficient there", unit="-", usual=LIFT)]


class LiftCurve(Record):
    """A curve."""

    rule = "lift_curve"
    curve: Annotated[Name, setting("CURVE", "name of the curve, for *HYDRODYNAMIC SETS", defines=Names.DRAG_LIFT)]
    points: Annotated[Table, curve_points(LiftPoint, "points in any order", "drag lift curve", abscissa="ratio")]


class DragLift(Block):
    """Curves of lift."""

    rule = "drag_lift"
    page = "kwd_model_draglift"
    summary = "Drag lift coefficients by the gap to the seabed, named by *HYDRODYNAMIC SETS."
    tabular = True
    example = "*DRAG LIFT\n CURVE=Lift\n 0.0, 0.9\n 0.5, 0.3\n 1.0, 0.0\n"

    keyword: Literal["DRAG LIFT"] = "DRAG LIFT"
    curves: list[LiftCurve] = []


BLOCK = DragLift
