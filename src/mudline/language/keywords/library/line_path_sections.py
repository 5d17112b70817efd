"""`*LINE PATH SECTIONS`: sections of lines that follow a path, by the distances at which they start and end."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.common import AdditionalSets
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import ALONG
from mudline.language.keywords.values import Facts, Name, Real

_DISTANCE = "; a negative one counts back from the end of the line, bend radii do not count"


class SectionStretch(Row):
    """Values of SECTION=."""

    set_name: Annotated[Name, about("element set that the section makes")] = Field(alias="set")
    start: Annotated[Real, about("distance along the line where the section starts" + _DISTANCE, unit="L", usual=ALONG)]
    end: Annotated[Real | None, about("distance along the line where it ends" + _DISTANCE, unit="L", usual=ALONG)] = (
        None
    )


class PathSection(Record):
    """A section of a line."""

    rule = "path_section"
    section: Annotated[SectionStretch, setting("SECTION", "element set of the section, and where it lies")]
    repeat: Annotated[
        Name | None, setting("REPEAT", "group of *LINE SECTION GROUPS that is repeated here", inline=True)
    ] = None
    additional: list[AdditionalSets] = []


class PathLine(Record):
    """A line and its sections."""

    rule = "path_line"
    line: Annotated[Name, setting("LINE", "line of *LINE PATHS", inferred="it is an element set too")]
    sections: list[PathSection] = []


class LinePathSections(Block):
    """Sections of lines that follow a path."""

    rule = "line_path_sections"
    facts = Facts(makes=("NODE", "ELEMENT", "ELEMENT SETS"))
    page = "_line-path-sections"
    summary = "Sections of the lines of *LINE PATHS: element sets by distance along the line."
    example = (
        "*LINE PATH SECTIONS\n"
        " LINE=Flowline\n"
        " SECTION=Start Zone, 0.0, 150.0\n ADDITIONAL=Coated Pipe\n"
        " SECTION=Route, 150.0, -50.0\n"
        " SECTION=End Zone, -50.0\n"
    )

    keyword: Literal["LINE PATH SECTIONS"] = "LINE PATH SECTIONS"
    paths: list[PathLine] = []


BLOCK = LinePathSections
