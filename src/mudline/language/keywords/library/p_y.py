"""`*P-Y`: lateral soil springs."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import setting
from mudline.language.keywords.keeping import OpenBlock, OpenRecord
from mudline.language.keywords.soil_springs import CurvesFile, SoilCurves
from mudline.language.keywords.values import Facts, Name, Names, Other

_OTHERS = "the types of other soil models are not public: the lines of one are passed through unchanged"


class LateralSprings(OpenRecord):
    """The curves of a set."""

    rule = "lateral_springs"
    type_: Annotated[
        Literal["USER"] | Other | None,
        setting("TYPE", "curves given by points", default="USER", inferred=_OTHERS, opaque=()),
    ] = Field(default=None, alias="type")
    set_name: Annotated[Name | None, setting("SET", "element set that the curves hold for", names=Names.SET)] = Field(
        default=None, alias="set"
    )
    file: CurvesFile = None
    curves: SoilCurves = []


class LateralSoil(OpenBlock):
    """Lateral soil springs."""

    rule = "p_y"
    subject = "seabed"
    facts = Facts(soil_springs=True)
    page = "kwd_model_py"
    summary = "Lateral soil springs by set and depth: points of resistance P and displacement y, resistance first."
    tabular = True
    example = (
        "*P-Y\n TYPE=USER\n SET=Conductor\n DEPTH=0.0\n 0.0, 0.0\n 4000.0, 0.01\n 9000.0, 0.1\n"
        " DEPTH=10.0\n 0.0, 0.0\n 40000.0, 0.01\n 90000.0, 0.1\n"
    )

    keyword: Literal["P-Y"] = "P-Y"
    sets: list[LateralSprings] = []


BLOCK = LateralSoil
