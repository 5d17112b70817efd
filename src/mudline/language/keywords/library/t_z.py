"""`*T-Z`: axial soil springs."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import setting
from mudline.language.keywords.keeping import OpenBlock, OpenRecord
from mudline.language.keywords.soil_springs import CurvesFile, SoilCurves
from mudline.language.keywords.values import Facts, Name, Names


class AxialSprings(OpenRecord):
    """The curves of a set."""

    rule = "axial_springs"
    set_name: Annotated[Name | None, setting("SET", "element set that the curves hold for", names=Names.SET)] = Field(
        default=None, alias="set"
    )
    file: CurvesFile = None
    curves: SoilCurves = []


class AxialSoil(OpenBlock):
    """Axial soil springs."""

    rule = "t_z"
    subject = "seabed"
    facts = Facts(soil_springs=True)
    page = "kwd_model_tz"
    summary = "Axial soil springs by set and depth: points of resistance T and displacement z, resistance first."
    tabular = True
    example = "*T-Z\n SET=Conductor\n DEPTH=0.0\n 0.0, 0.0\n 1500.0, 0.005\n DEPTH=10.0\n 0.0, 0.0\n 12000.0, 0.005\n"

    keyword: Literal["T-Z"] = "T-Z"
    sets: list[AxialSprings] = []


BLOCK = AxialSoil
