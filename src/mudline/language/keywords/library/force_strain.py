"""`*FORCE-STRAIN`: non-linear axial stiffness."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import EA_CURVE, OF_ITS_CURVE, Usual
from mudline.language.keywords.values import Name, Names, Real


class ForceStrainPoint(Row):
    """A point of a curve: force first."""

    force: Annotated[Real, about("axial force; it comes first", unit="F", usual=OF_ITS_CURVE)]
    strain: Annotated[Real, about("strain there", unit="-", usual=Usual(-5.0, 5.0, "rubber stretches fivefold"))]


class ForceStrainCurve(Record):
    """A curve."""

    rule = "force_strain_curve"
    curve: Annotated[
        Name, setting("CURVE", "name of the curve, for EA= of *GEOMETRIC SETS", defines=Names.FORCE_STRAIN)
    ]
    points: Annotated[
        Table,
        curve_points(
            ForceStrainPoint,
            "two points or more, in any order",
            "force-strain curve",
            abscissa="strain",
            usual=EA_CURVE,
        ),
    ]


class ForceStrain(Block):
    """Curves of the flexible format."""

    rule = "force_strain"
    page = "kwd_model_forcestrain"
    summary = "Curves of force against strain: non-linear axial stiffness, named by EA= of *GEOMETRIC SETS."
    tabular = True
    example = "*FORCE-STRAIN\n CURVE=Pipe\n -2.0E6, -0.004\n 0.0, 0.0\n 2.5E6, 0.004\n"

    keyword: Literal["FORCE-STRAIN"] = "FORCE-STRAIN"
    curves: list[ForceStrainCurve] = []


BLOCK = ForceStrain
