"""Curves of non-linear and plastic materials: most are named by `*GEOMETRIC SETS`."""

from functools import partial
from typing import Annotated, Literal

from mudline.language.keywords.common import *


class MomentCurvaturePoint(Row):
    """Point of a curve: moment first."""

    moment: Annotated[Real, about("bending moment; it comes first", unit="FL", usual=OF_ITS_CURVE)]
    curvature: Annotated[Real, about("curvature there", unit="1/L", usual=OF_ITS_CURVE)]


class MomentCurvatureCurve(Record):
    """Curve."""

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
            usual=(EI_CURVE, BENT),
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
    curves: Records[MomentCurvatureCurve] = Records()


class TorqueTwistPoint(Row):
    """Point of a curve: torque first."""

    torque: Annotated[Real, about("torque; it comes first", unit="FL", usual=OF_ITS_CURVE)]
    twist: Annotated[Real, about("twist per unit length there", unit="1/L", usual=OF_ITS_CURVE)]


class TorqueTwistCurve(Record):
    """Curve."""

    rule = "torque_twist_curve"
    curve: Annotated[
        Name, setting("CURVE", "name of the curve, for GJ= of *GEOMETRIC SETS", defines=Names.TORQUE_TWIST)
    ]
    points: Annotated[
        Table,
        curve_points(
            TorqueTwistPoint,
            "two points or more, in any order",
            "torque-twist curve",
            abscissa="twist",
            usual=EI_CURVE,
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
    curves: Records[TorqueTwistCurve] = Records()


class ForceStrainPoint(Row):
    """Point of a curve: force first."""

    force: Annotated[Real, about("axial force; it comes first", unit="F", usual=OF_ITS_CURVE)]
    strain: Annotated[Real, about("strain there", unit="-", usual=Usual(-5.0, 5.0, "rubber stretches fivefold"))]


class ForceStrainCurve(Record):
    """Curve."""

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
    curves: Records[ForceStrainCurve] = Records()


class StressStrainPoint(Row):
    """Point of a curve: stress first."""

    stress: Annotated[
        Real, about("stress; it comes first", unit="F/L2", usual=Usual(high=5e9, why="the strongest wire has 3 GPa"))
    ]
    strain: Annotated[Real, about("strain there", unit="-", usual=Usual(-5.0, 5.0, "rubber stretches fivefold"))]


_of_stress = partial(
    curve_points,
    StressStrainPoint,
    "points in any order; at least two; without negative strains it is taken to be symmetric",
    "stress-strain curve",
    abscissa="strain",
    usual=E_CURVE,
)
"""Table field of a stress-strain curve."""


class StressStrainCurve(Record):
    """Curve."""

    rule = "stress_strain_direct_curve"
    curve: Annotated[
        Name, setting("CURVE", "name of the curve, for E= of *GEOMETRIC SETS", defines=Names.STRESS_STRAIN)
    ]
    points: Annotated[
        Table,
        _of_stress(),
    ]


class StressStrain(Block):
    """Curves of the rigid format."""

    rule = "stress_strain_direct"
    page = "kwd_model_stressstraindirect"
    summary = "Curves of stress against strain: non-linear material stiffness, named by E= of *GEOMETRIC SETS."
    tabular = True
    example = "*STRESS/STRAIN DIRECT\n CURVE=Pipe\n 0.0, 0.0\n 4.4E8, 0.0021\n 5.1E8, 0.02\n"

    keyword: Literal["STRESS/STRAIN DIRECT"] = "STRESS/STRAIN DIRECT"
    curves: Records[StressStrainCurve] = Records()


class StiffenerCurve(Record):
    """Curve."""

    rule = "stiffener_curve"
    curve: Annotated[Name, setting("CURVE", "name of the curve, for bend stiffeners", unique=True)]
    points: Annotated[
        Table,
        _of_stress(ends="slope"),
    ]


class NonlinearStiffener(Block):
    """Curves of bend stiffeners."""

    rule = "nonlinear_stiffener"
    page = "kwd_model_nonlinearstiffener"
    summary = "Curves of stress against strain of bend stiffeners, named by *STIFFENER."
    tabular = True
    example = "*NONLINEAR STIFFENER\n CURVE=Polyurethane\n 0.0, 0.0\n 4.0E6, 0.03\n 7.0E6, 0.1\n"

    keyword: Literal["NONLINEAR STIFFENER"] = "NONLINEAR STIFFENER"
    curves: Records[StiffenerCurve] = Records()


class HardeningPoint(Row):
    """Point of a model: stress first."""

    stress: Annotated[
        Real,
        about(
            "equivalent stress; it comes first",
            unit="F/L2",
            at_least=0,
            usual=Usual(1e6, 5e9, "plastics yield at 1E7, the strongest wire at 3E9", typical=4.5e8, within=3.0),
        ),
    ]
    strain: Annotated[
        Real,
        about(
            "equivalent plastic strain there",
            unit="-",
            at_least=0,
            usual=Usual(high=1.5, why="ductile steel breaks before; 0.2 is 20 %"),
        ),
    ]


class HardeningModel(Record):
    """Model."""

    rule = "hardening_model"
    name: Annotated[
        Name,
        setting("NAME", "name of the model, for PLASTIC HARDENING= of *GEOMETRIC SETS", defines=Names.HARDENING),
    ]
    tension: Annotated[
        Real | None, setting("TENSION VARIATION", "threshold of the variation of tension", inline=True, usual=ANY)
    ] = None
    points: Annotated[
        Table,
        curve_points(
            HardeningPoint,
            "at least two; the first one is the yield point",
            "hardening curve",
            abscissa="strain",
            usual=(
                Usual(high=0.0, why="there is no plastic strain before the metal yields", of="at the first point"),
                Usual(low=0.0, why="metals harden", of="as the least slope"),
            ),
        ),
    ]


class PlasticHardening(Block):
    """Models of the rigid format."""

    rule = "plastic_hardening"
    page = "kwd_model_plastichardening"
    summary = "Plastic hardening: stress against plastic strain, named by PLASTIC HARDENING= of *GEOMETRIC SETS."
    tabular = True
    example = "*PLASTIC HARDENING\n NAME=X65\n 448.0E6, 0.0\n 510.0E6, 0.02\n 560.0E6, 0.1\n"

    keyword: Literal["PLASTIC HARDENING"] = "PLASTIC HARDENING"
    models: Records[HardeningModel] = Records()
