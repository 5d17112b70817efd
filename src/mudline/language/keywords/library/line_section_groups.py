"""`*LINE SECTION GROUPS`: sections of given lengths, in groups that are repeated along a line."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.common import AdditionalSets
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import ALONG
from mudline.language.keywords.values import Facts, Name, Real

_RANGE = "it is not negative; the manual gives no range"


class SectionLength(Row):
    """Values of SECTION=."""

    set_name: Annotated[Name, about("element set that the section makes")] = Field(alias="set")
    length: Annotated[Real, about("length of the section", unit="L", at_least=0, inferred=_RANGE, usual=ALONG)]


class SectionMesh(Row):
    """Element lengths along a section."""

    start: Annotated[
        Real | None, about("shortest element at the start", unit="L", at_least=0, inferred=_RANGE, usual=ALONG)
    ] = None
    longest: Annotated[Real | None, about("longest element", unit="L", at_least=0, inferred=_RANGE, usual=ALONG)] = None
    end: Annotated[
        Real | None, about("shortest element at the end", unit="L", at_least=0, inferred=_RANGE, usual=ALONG)
    ] = None


class GroupSection(Record):
    """A section of a group."""

    rule = "group_section"
    section: Annotated[SectionLength, setting("SECTION", "element set and length of the section")]
    additional: list[AdditionalSets] = []
    mesh: Annotated[SectionMesh | None, about("element lengths along the section")] = None


class SectionGroup(Record):
    """A group."""

    rule = "section_group"
    name: Annotated[Name, setting("NAME", "name of the group", inferred="it is an element set too")]
    sections: list[GroupSection] = []


class LineSectionGroups(Block):
    """Groups of line sections."""

    rule = "line_section_groups"
    facts = Facts(makes=("NODE", "ELEMENT", "ELEMENT SETS"))
    page = "kwd_model_linesectiongroups"
    summary = "Groups of line sections, one after the other, for the REPEAT= of *LINE PATH SECTIONS."
    example = (
        "*LINE SECTION GROUPS\n"
        " NAME=Joint\n"
        " SECTION=Pipe Joint, 11.8\n ADDITIONAL=Coated Pipe, Riser\n 0.5, 2.0, 0.5\n"
        " SECTION=Field Joint, 0.4\n"
    )

    keyword: Literal["LINE SECTION GROUPS"] = "LINE SECTION GROUPS"
    groups: list[SectionGroup] = []


BLOCK = LineSectionGroups
