"""`*ELEMENT SETS` of clearance: the two groups of elements between which it is looked for."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.keywords.model import Block, Record, about
from mudline.keywords.values import Ident, Names, Real


class ClearRange(Record):
    """A group of elements."""

    rule = "clear_range"
    start: Annotated[Ident, about("first element", names=Names.ELEMENT)]
    end: Annotated[Ident, about("last element", names=Names.ELEMENT)]
    diameter: Annotated[Real | None, about("external diameter", unit="L", default="of the model", above=0)] = None


class ClearSets(Block):
    """Two groups of elements."""

    rule = "clear_element_sets"
    sections = ("CLEAR",)
    subject = "post-processing"
    page = "kwd_clear_elementsets"
    summary = "The two groups of elements between which clearance is looked for: exactly two lines."
    example = "*ELEMENT SETS\n 1, 40, 0.35\n 41, 90\n"

    keyword: Literal["ELEMENT SETS"] = "ELEMENT SETS"
    ranges: list[ClearRange] = []


BLOCK = ClearSets
