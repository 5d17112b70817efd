"""`*DAMPER DATA`: damping coefficients by time or velocity."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import ANY, OF_A_KIND
from mudline.language.keywords.values import Name, Names, Real


class DamperPoint(Row):
    """A point of a curve."""

    variable: Annotated[Real, about("time or velocity", usual=OF_A_KIND)]
    coefficient: Annotated[Real, about("damping coefficient there", unit="FT/L", at_least=0, usual=ANY)]


class DamperCurve(Record):
    """A curve."""

    rule = "damper_curve"
    name: Annotated[Name, setting("NAME", "name of the curve", defines=Names.DAMPER)]
    variable: Annotated[
        Literal["TIME", "VELOCITY"] | None, setting("VARIABLE", "what comes first", default="TIME", inline=True)
    ] = None
    points: Annotated[
        Table, curve_points(DamperPoint, "points in any order; at least two", "damper curve", abscissa="variable")
    ]


class DamperData(Block):
    """Curves of dampers."""

    rule = "damper_data"
    page = "kwd_model_damperdata"
    summary = "Damping coefficients of damper elements by time or by velocity."
    tabular = True
    example = "*DAMPER DATA\n NAME=Snubber, VARIABLE=VELOCITY\n 0.0, 2000.0\n 1.5, 8000.0\n"

    keyword: Literal["DAMPER DATA"] = "DAMPER DATA"
    curves: list[DamperCurve] = []


BLOCK = DamperData
