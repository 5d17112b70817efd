"""`*SEABED STIFFNESS`: named force-embedment curves."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.common import POINTS, CurvePoint
from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block, Record, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import CURVE_FORCE
from mudline.language.keywords.values import Facts, Name, Names


class StiffnessCurve(Record):
    """A curve."""

    rule = "stiffness_curve"
    name: Annotated[Name, setting("CURVE", "curve name, used by STIFFNESS= of *SEABED PROPERTIES", defines=Names.CURVE)]
    points: Annotated[
        Table, curve_points(CurvePoint, POINTS, "force-embedment curve", abscissa="ratio", usual=CURVE_FORCE)
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
    curves: list[StiffnessCurve] = []


BLOCK = SeabedStiffness
