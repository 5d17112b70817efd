"""`*FLEXJOINT`: elements that are flex joints."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from mudline.language.keywords.common import require_one
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import OF_ITS_CURVE, ROTATION, ROTATION_CURVE, Usual
from mudline.language.keywords.values import Facts, Ident, Name, Names, Real, RealOrName


class JointWeights(Row):
    """The weights of a joint: in water first."""

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
    """A point of a curve: moment first."""

    moment: Annotated[Real, about("moment; it comes first", unit="FL", usual=OF_ITS_CURVE)]
    angle: Annotated[
        Real, about("angle there", unit="deg", inferred="its unit", usual=Usual(-90.0, 90.0, "no joint turns farther"))
    ]


class FlexJoint(Record):
    """A joint, or those of a set."""

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
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """Weights stand before TYPE=, and what it chose behind it."""
        if "type" not in given:
            return "weights"
        return "points" if given["type"] == "NONLINEAR" else "stiffness"

    @model_validator(mode="after")
    def _fits(self) -> FlexJoint:
        """One way to say which, and what its type has."""
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
    joints: list[FlexJoint] = []


BLOCK = FlexJoints
