"""`*STRESS/STRAIN DIRECT`: non-linear material stiffness."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import E_CURVE, Usual
from mudline.language.keywords.values import Name, Names, Real


class StressStrainPoint(Row):
    """A point of a curve: stress first."""

    stress: Annotated[
        Real, about("stress; it comes first", unit="F/L2", usual=Usual(high=5e9, why="the strongest wire has 3 GPa"))
    ]
    strain: Annotated[Real, about("strain there", unit="-", usual=Usual(-5.0, 5.0, "rubber stretches fivefold"))]


class StressStrainCurve(Record):
    """A curve."""

    rule = "stress_strain_direct_curve"
    curve: Annotated[
        Name, setting("CURVE", "name of the curve, for E= of *GEOMETRIC SETS", defines=Names.STRESS_STRAIN)
    ]
    points: Annotated[
        Table,
        curve_points(
            StressStrainPoint,
            "points in any order; at least two; without negative strains it is taken to be symmetric",
            "stress-strain curve",
            abscissa="strain",
            usual=E_CURVE,
        ),
    ]


class StressStrain(Block):
    """Curves of the rigid format."""

    rule = "stress_strain_direct"
    page = "kwd_model_stressstraindirect"
    summary = "Curves of stress against strain: non-linear material stiffness, named by E= of *GEOMETRIC SETS."
    tabular = True
    example = "*STRESS/STRAIN DIRECT\n CURVE=Pipe\n 0.0, 0.0\n 4.4E8, 0.0021\n 5.1E8, 0.02\n"

    keyword: Literal["STRESS/STRAIN DIRECT"] = "STRESS/STRAIN DIRECT"
    curves: list[StressStrainCurve] = []


BLOCK = StressStrain
