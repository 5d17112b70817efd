"""`*ELEMENT SETS` of clearance: the two groups of elements between which it is looked for."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import model_validator

from mudline.language.keywords.fields import about
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.usual import WIDTH
from mudline.language.keywords.values import Ident, Names, Real

_GROUPS = 2


class ClearRange(Record):
    """A group of elements."""

    rule = "clear_range"
    start: Annotated[Ident, about("first element", names=Names.ELEMENT)]
    end: Annotated[Ident, about("last element", names=Names.ELEMENT)]
    diameter: Annotated[
        Real | None, about("external diameter", unit="L", default="of the model", above=0, usual=WIDTH)
    ] = None


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

    @model_validator(mode="after")
    def _fits(self) -> ClearSets:
        """Two groups."""
        if len(self.ranges) != _GROUPS:
            raise ValueError(f"{len(self.ranges)} lines are given: expected exactly {_GROUPS}")
        return self


BLOCK = ClearSets
