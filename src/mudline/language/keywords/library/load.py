"""`*LOAD`: forces on nodes and elements."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import setting
from mudline.language.keywords.keeping import OpenRecord
from mudline.language.keywords.model import Block
from mudline.language.keywords.values import Other

_LINES = (
    "the lines below it, as their page was not seen: they give nodes, directions and magnitudes, or first and last "
    "elements and components, and are passed through unchanged"
)


class LoadType(OpenRecord):
    """Loads of one type."""

    rule = "load_type"
    type_: Annotated[
        Literal["CONSTANT", "DISTRIBUTED"] | Other,
        setting(
            "TYPE",
            "forces on single nodes, or on the elements from one to another",
            inferred=_LINES,
            opaque=("CONSTANT", "DISTRIBUTED"),
        ),
    ] = Field(alias="type")


class Loads(Block):
    """Loads."""

    rule = "load"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "theory_additional_point"
    summary = "Forces on nodes, and forces along elements, in the global axes."
    example = "*LOAD\n TYPE=CONSTANT\n 12, 1, -5000.0\n"

    keyword: Literal["LOAD"] = "LOAD"
    types: list[LoadType] = []


BLOCK = Loads
