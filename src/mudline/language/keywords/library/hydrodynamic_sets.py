"""Drag, inertia and lift coefficients."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *

_ORDER = (
    "the order, which is that of .das decks: a page on theory lists tangential before normal added mass, and the lines "
    "of the keyword's own page were not seen"
)
_OTHERS = "types by Reynolds number, of moonpools and buoys, whose lines are passed through unchanged"


class ConstantCoefficients(Row):
    """Line of TYPE=CONSTANT."""

    normal_drag: Annotated[Real, about("normal drag coefficient", unit="-", at_least=0, inferred=_ORDER, usual=DRAG)]
    tangential_drag: Annotated[
        Real | None, about("tangential drag coefficient", unit="-", default="0", at_least=0, usual=ALONG_DRAG)
    ] = None
    normal_inertia: Annotated[
        Real | None, about("normal inertia coefficient", unit="-", default="2", at_least=0, usual=INERTIA)
    ] = None
    normal_added_mass: Annotated[
        Real | None,
        about(
            "normal added mass coefficient",
            unit="-",
            default="normal inertia - 1",
            at_least=0,
            inferred=_ORDER,
            usual=ADDED_MASS,
        ),
    ] = None
    tangential_added_mass: Annotated[
        Real | None,
        about(
            "tangential added mass coefficient", unit="-", default="0", at_least=0, inferred=_ORDER, usual=ADDED_MASS
        ),
    ] = None
    drag_lift: Annotated[
        RealOrName | None,
        about(
            "drag lift coefficient, or a curve of *DRAG LIFT",
            unit="-",
            default="none",
            names=Names.DRAG_LIFT,
            usual=LIFT,
        ),
    ] = None


class HydrodynamicSet(OpenRecord):
    """Coefficients of a set."""

    rule = "hydrodynamic_set"
    set_name: Annotated[Name, setting("SET", "element set", names=Names.SET, unique=True)] = Field(alias="set")
    type_: Annotated[
        Literal["CONSTANT", "REYNOLDS"] | Other | None,
        setting(
            "TYPE",
            "what the coefficients depend on",
            default="CONSTANT",
            inline=True,
            inferred=_OTHERS,
            opaque=("REYNOLDS",),
        ),
    ] = Field(default=None, alias="type")
    constant: Annotated[ConstantCoefficients | None, about("coefficients of CONSTANT")] = None


class HydrodynamicSets(OpenBlock):
    """Coefficients by set."""

    rule = "hydrodynamic_sets"
    page = "kwd_model_hydrodynamicsets"
    facts = Facts(gives=("hydrodynamics",), later_wins=True)
    open_lines = False
    summary = "Drag, inertia and added mass coefficients by element set."
    example = "*HYDRODYNAMIC SETS\n DIAMETER=DRAG\n SET=ALL, TYPE=CONSTANT\n 1.0, 0.05, 2.0\n"

    keyword: Literal["HYDRODYNAMIC SETS"] = "HYDRODYNAMIC SETS"
    diameter: Annotated[
        Literal["DRAG", "BUOYANCY"] | None, setting("DIAMETER", "diameter of inertia forces", default="DRAG")
    ] = None
    option: Annotated[
        Literal["REYNOLDS"] | Other | None,
        setting(
            "OPTION",
            "that forces follow the Reynolds number of the moment",
            inferred="its key, from the public reader of .das decks: the manual has an optional line for it",
            opaque=(),
        ),
    ] = None
    sets: Records[HydrodynamicSet] = Records()


class LiftPoint(Row):
    """Point of a curve."""

    ratio: Annotated[Real, about("gap to the seabed over drag diameter", unit="-", usual=ANY)]
    coefficient: Annotated[Real, about("drag lift coefficient there", unit="-", usual=LIFT)]


class LiftCurve(Record):
    """Curve."""

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
    curves: Records[LiftCurve] = Records()
