"""`*CRITERIA`: what a static run is to reach, and what is moved for it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import model_validator

from mudline.language.keywords.common import require_one
from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.usual import ANY, COUNT
from mudline.language.keywords.values import Name, Names, Real, Whole


class Criterion(Record):
    """A value that is to be reached."""

    rule = "criterion"
    criterion: Annotated[
        Literal[
            "HANGOFF ANGLE",
            "TENSION",
            "AXIAL STRESS",
            "AXIAL STRAIN",
            "BENDING STRESS",
            "BENDING STRAIN",
            "BENDING MOMENT",
            "SUPPORT REACTION",
            "SEABED CONTACT",
            "VON MISES STRESS",
        ],
        setting("CRITERION", "quantity"),
    ]
    monitor: Annotated[Name, setting("MONITOR", "element, element set or guide where it is looked at", inline=True)]
    target: Annotated[Real, setting("TARGET", "value to be reached", inline=True, usual=ANY)]
    tolerance: Annotated[
        Real | None, setting("TOLERANCE", "tolerance", unit="%", default="1", above=0, inline=True, usual=ANY)
    ] = None


class Criteria(Block):
    """Criteria of a static run."""

    rule = "criteria"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_criteria"
    summary = "What a static run is to reach, and what is moved, or made longer, until it does."
    example = (
        "*CRITERIA\n CRITERION=TENSION, MONITOR=12, TARGET=2.5E5\n VARIABLE=VESSEL, ADJUST=FPSO, VECTOR=Away\n"
        " MAX ITERATIONS=50\n"
    )

    keyword: Literal["CRITERIA"] = "CRITERIA"
    criteria: list[Criterion] = []
    variable: Annotated[Literal["NODE", "VESSEL", "LENGTH"] | None, setting("VARIABLE", "what is changed")] = None
    option: Annotated[
        Literal["LENGTH"] | None,
        setting("OPTION", "the same of a length", inferred="the manual prints OPTION=LENGTH; VARIABLE=LENGTH is taken"),
    ] = None
    adjust: Annotated[Name, setting("ADJUST", "node, vessel, element or set that is changed", inline=True)]
    vector: Annotated[
        Name | None, setting("VECTOR", "of NODE and VESSEL: direction, of *VECTOR", inline=True, names=Names.VECTOR)
    ] = None
    iterations: Annotated[Whole | None, setting("MAX ITERATIONS", "most iterations", at_least=1, usual=COUNT)] = None
    least: Annotated[
        Real | None, setting("MIN ADJUSTMENT", "smallest change", inline=True, behind="MAX ITERATIONS", usual=ANY)
    ] = None
    largest: Annotated[
        Real | None, setting("MAX ADJUSTMENT", "largest change", inline=True, behind="MAX ITERATIONS", usual=ANY)
    ] = None

    @model_validator(mode="after")
    def _fits(self) -> Criteria:
        """One thing is changed."""
        require_one(self, "variable", "option")
        return self


BLOCK = Criteria
