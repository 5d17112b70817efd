"""`*BOUNDARY`: what is held, or moved, during a load case."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.keeping import OpenRecord
from mudline.language.keywords.model import Block, ListRow, Record
from mudline.language.keywords.table import LARGEST_WHOLE
from mudline.language.keywords.usual import OF_A_KIND
from mudline.language.keywords.values import (
    Count,
    Equation,
    Finite,
    Ident,
    Kind,
    Names,
    Other,
    Real,
    Whole,
    WholeOrLabel,
)

_DOF = "degree of freedom: 1 vertical, 2 and 3 horizontal, 4 to 6 rotations"
_VALUE = "displacement that is imposed: a length, of a rotation degrees"
_OTHERS = "the lines of other types are not public: they are passed through unchanged"
_FOUR = "of four values the last two may be increment and degree of freedom, or degree of freedom and displacement"

Fixation = Annotated[
    Literal["RELATIVE"] | None,
    setting("FIXATION", "relative to the position where the load case begins", inline=True),
]


def _counted(given: object) -> object:
    """A whole number as one, so that a degree of freedom is written as it was; the sign of -0.0 is kept."""
    whole = isinstance(given, float) and given.is_integer() and math.copysign(1.0, given) > 0
    return int(given) if whole and isinstance(given, float) and given <= LARGEST_WHOLE else given


Either = Annotated[Count | Finite | Equation, Field(union_mode="left_to_right"), BeforeValidator(_counted), Kind.REAL]
"""A degree of freedom or a displacement."""


class FixedNode(Record):
    """A node that is held in a degree of freedom."""

    rule = "fixed_node"
    node: Annotated[Ident, about("node number, or its label", names=Names.NODE)]
    dof: Annotated[Whole, about(_DOF, usual=OF_A_KIND)]
    value: Annotated[Real | None, about(_VALUE, default="0", usual=OF_A_KIND)] = None
    fixation: Fixation = None


class FixedValues(ListRow):
    """First and last node, then the step between them if it is given, the degree of freedom, the displacement."""

    start: Annotated[WholeOrLabel, about("first node, or its label", names=Names.NODE, usual=OF_A_KIND)]
    end: Annotated[WholeOrLabel, about("last node, or its label", names=Names.NODE, usual=OF_A_KIND)]
    third: Annotated[
        Whole | None,
        about("of three values the degree of freedom, of five the increment", inferred=_FOUR, usual=OF_A_KIND),
    ] = None
    fourth: Annotated[Either | None, about("of five values the degree of freedom", inferred=_FOUR, usual=OF_A_KIND)] = (
        None
    )
    fifth: Annotated[Real | None, about(_VALUE, default="0", usual=OF_A_KIND)] = None


class FixedRange(Record):
    """Nodes that are held in a degree of freedom."""

    rule = "fixed_range"
    generate: Annotated[FixedValues, setting("GEN", "nodes from one number to another, and how they are held")]
    fixation: Fixation = None


class BoundaryType(OpenRecord):
    """Conditions of one type."""

    rule = "boundary_type"
    type_: Annotated[
        Literal["CONSTANT", "VESSEL"] | Other,
        setting(
            "TYPE", "what the conditions are; the lines of constant ones are read", inferred=_OTHERS, opaque=("VESSEL",)
        ),
    ] = Field(alias="type")
    entries: list[FixedNode | FixedRange] = []


class Boundary(Block):
    """Boundary conditions."""

    rule = "boundary"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "kwd_loadcase_boundary"
    summary = "Nodes that are held, or moved, in single degrees of freedom."
    example = "*BOUNDARY\n TYPE=CONSTANT\n 1, 2\n 1, 3, 0.0, FIXATION=RELATIVE\n GEN=11, 20, 1, 6, 0.0\n"

    keyword: Literal["BOUNDARY"] = "BOUNDARY"
    types: list[BoundaryType] = []


BLOCK = Boundary
