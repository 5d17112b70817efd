"""Springs, dampers and joints."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *


class SpringPoint(Row):
    """Point of a curve."""

    displacement: Annotated[Real, about("extension, positive as the spring grows longer", unit="L", usual=OF_ITS_CURVE)]
    force: Annotated[Real, about("force there", unit="F", usual=OF_ITS_CURVE)]


class Springs(Record):
    """Springs of one stiffness."""

    rule = "springs"
    elements: Annotated[
        list[Ident] | None, setting("ELEMENT", "elements, 20 on a line at most", names=Names.ELEMENT)
    ] = Field(default=None, alias="element")
    set_name: Annotated[
        Name | None,
        setting("SET", "element set", names=Names.SET, inferred="in place of ELEMENT=: the input table knows it"),
    ] = Field(default=None, alias="set")
    type_: Annotated[Literal["LINEAR", "NONLINEAR"], setting("TYPE", "a stiffness, or a curve")] = Field(alias="type")
    stiffness: Annotated[Real | None, about("of LINEAR: stiffness", unit="F/L", at_least=0, usual=ANY)] = None
    points: Annotated[
        Table | None,
        curve_points(
            SpringPoint, "of NONLINEAR: two points or more", "spring curve", abscissa="displacement", usual=FORCE_CURVE
        ),
    ] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the field of the form in TYPE=."""
        return "points" if values.get("type") == "NONLINEAR" else "stiffness"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless either elements or a set, and the data of the type, are given."""
        require_one(self, "elements", "set_name")
        require_one(self, "stiffness" if self.type_ == "LINEAR" else "points")
        require_one(self, "stiffness", "points")
        return self


class SpringElements(Block):
    """Springs."""

    rule = "spring_element"
    page = "kwd_model_springelement"
    facts = Facts(zero_length=True)
    summary = "Elements that are springs, of one stiffness or with a curve of force against extension."
    example = "*SPRING ELEMENT\n ELEMENT=12\n TYPE=LINEAR\n 25000.0\n"

    keyword: Literal["SPRING ELEMENT"] = "SPRING ELEMENT"
    springs: Records[Springs] = Records()


class NodeSpring(Record):
    """Spring at a node."""

    rule = "node_spring_line"
    node: Node
    dof: Freedom
    stiffness: Annotated[
        Real,
        about(
            "stiffness: force per length, of a rotation moment per degree",
            at_least=0,
            usual=OF_A_KIND,
            written_in=("F/L", "FL/deg"),
        ),
    ]


class NodeSprings(Block):
    """Springs."""

    rule = "node_spring"
    page = "kwd_model_nodespring"
    summary = "Springs at nodes, each in one degree of freedom and a fixed direction."
    example = "*NODE SPRING\n 12, 2, 25000.0\n {Hang-off}, 4, 300.0\n"

    keyword: Literal["NODE SPRING"] = "NODE SPRING"
    springs: Records[NodeSpring] = Records()


class DamperPoint(Row):
    """Point of a curve."""

    variable: Annotated[Real, about("time or velocity", usual=OF_A_KIND)]
    coefficient: Annotated[Real, about("damping coefficient there", unit="FT/L", at_least=0, usual=ANY)]


class DamperCurve(Record):
    """Curve."""

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
    curves: Records[DamperCurve] = Records()


class JointWeights(Row):
    """Weights of a joint, in water first."""

    water: Annotated[
        Real | None,
        about(
            "weight in water; it comes first",
            unit="F",
            default="0",
            usual=Usual(high=1.0, why="water lifts", of="/air"),
        ),
    ] = None
    air: Annotated[
        Real | None, about("weight in air, not below that in water", unit="F", default="0", usual=OF_ITS_CURVE)
    ] = None


class JointPoint(Row):
    """Point of a curve: moment first."""

    moment: Annotated[Real, about("moment; it comes first", unit="FL", usual=OF_ITS_CURVE)]
    angle: Annotated[
        Real, about("angle there", unit="deg", inferred="its unit", usual=Usual(-90.0, 90.0, "no joint turns farther"))
    ]


class FlexJoint(Record):
    """Joint, or the joints of a set."""

    rule = "flex_joint"
    element: Annotated[Ident | None, setting("ELEMENT", "element, or give SET=", names=Names.ELEMENT)] = None
    set_name: Annotated[Name | None, setting("SET", "element set, or give ELEMENT=", names=Names.SET)] = Field(
        default=None, alias="set"
    )
    weights: Annotated[JointWeights | None, about("weights")] = None
    type_: Annotated[
        Literal["LINEAR", "NONLINEAR"], setting("TYPE", "a stiffness, or a curve", inferred="the block may be repeated")
    ] = Field(alias="type")
    stiffness: Annotated[
        RealOrName | None, about("of LINEAR: rotational stiffness", unit="FL", at_least=0, usual=ROTATION)
    ] = None
    points: Annotated[
        Table | None,
        curve_points(
            JointPoint, "of NONLINEAR: two points or more", "moment-angle curve", abscissa="angle", usual=ROTATION_CURVE
        ),
    ] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the field of a row: weights before TYPE=, then the form in TYPE=."""
        if "type" not in values:
            return "weights"
        return "points" if values["type"] == "NONLINEAR" else "stiffness"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless either elements or a set, and the data of the type, are given."""
        require_one(self, "element", "set_name")
        require_one(self, "stiffness" if self.type_ == "LINEAR" else "points")
        require_one(self, "stiffness", "points")
        return self


class FlexJoints(Block):
    """Flex joints."""

    rule = "flexjoint"
    page = "kwd_model_flexjoint"
    facts = Facts(zero_length=True)
    summary = "Elements that are flex joints: weights, and a rotational stiffness or a curve of moment against angle."
    example = "*FLEXJOINT\n ELEMENT=12\n 8000.0, 9500.0\n TYPE=NONLINEAR\n 0.0, 0.0\n 15000.0, 1.0\n"

    keyword: Literal["FLEXJOINT"] = "FLEXJOINT"
    joints: Records[FlexJoint] = Records()


class HingeElement(Record):
    """Hinge; its two nodes should be at one place."""

    rule = "hinge_line"
    element: Element
    stiffness: Annotated[
        Real | None,
        setting(
            "STIFFNESS",
            "rotational stiffness, per degree",
            unit="FL",
            default="0",
            at_least=0,
            inline=True,
            usual=ROTATION,
        ),
    ] = None


class Hinges(Block):
    """Hinges."""

    rule = "hinge"
    page = "kwd_model_hinge"
    facts = Facts(zero_length=True)
    summary = "Elements that are hinges, with a rotational stiffness or none."
    example = "*HINGE\n 12\n 40, STIFFNESS=1500.0\n"

    keyword: Literal["HINGE"] = "HINGE"
    hinges: Records[HingeElement] = Records()
