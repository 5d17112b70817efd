"""`*SPRING ELEMENT`: springs between two nodes."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from mudline.language.keywords.common import require_one
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, curve_points
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import ANY, FORCE_CURVE, OF_ITS_CURVE
from mudline.language.keywords.values import Facts, Ident, Name, Names, Real


class SpringPoint(Row):
    """A point of a curve."""

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
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """What TYPE= says."""
        return "points" if given.get("type") == "NONLINEAR" else "stiffness"

    @model_validator(mode="after")
    def _fits(self) -> Springs:
        """One way to say which, and what its type has."""
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
    springs: list[Springs] = []


BLOCK = SpringElements
