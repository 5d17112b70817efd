"""`*EMBEDMENT`: force-embedment curves by element set (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.common import NO_SET, POINTS, CurvePoint
from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block, Record, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import CURVE_FORCE
from mudline.language.keywords.values import Facts, Name, Names, Successor


class EmbedmentCurve(Record):
    """A curve and the set that it holds for."""

    rule = "embedment_curve"
    set_name: Annotated[
        Name | None,
        setting("SET", "element set of the curve", default="ALL", inferred=NO_SET, names=Names.SET),
    ] = Field(default=None, alias="set")
    points: Annotated[
        Table, curve_points(CurvePoint, POINTS, "force-embedment curve", abscissa="ratio", usual=CURVE_FORCE)
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
    curves: list[EmbedmentCurve] = []


BLOCK = Embedment
