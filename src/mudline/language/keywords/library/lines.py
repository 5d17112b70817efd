"""Lines, each of which creates nodes, elements, labels and element sets.

The formats of `*LINES`, `*LINE PATHS` and `*LINE LOCATIONS` are not public: their lines are kept, and the names in
them are used.
"""

from typing import Annotated, Literal

from mudline.language.keywords.common import *


class AdditionalSets(Record):
    """More sets that the elements of a section belong to."""

    rule = "additional_sets"
    sets: Annotated[
        list[Name],
        setting("ADDITIONAL", "more element sets that hold this section", inferred="the line may be repeated"),
    ]


LINE_LOCATIONS = OpaqueKeyword(
    keyword="LINE LOCATIONS",
    summary="Labels for nodes at given distances along a line.",
    example="*LINE LOCATIONS\n LINE=Umbilical\n Touchdown, 200.0\n",
    certain="It gives labels to nodes at a distance along a line.",
    inferred="LINE= names a line, which is an element set too; any other text in its lines may be a label.",
    name_settings={"LINE": Names.SET},
    labels=True,
    makes=("NODE",),
)


LINE_PATHS = OpaqueKeyword(
    keyword="LINE PATHS",
    summary="Lines that follow a path; their sections are given in *LINE PATH SECTIONS.",
    example="*LINE PATHS\n LINE=Flowline\n 0.0, 0.0, 0.0\n 0.0, 850.0, 0.0\n",
    certain="It defines the lines that *LINE PATH SECTIONS divides into sections, with bends.",
    inferred=(
        "LINE= or NAME= gives the line's name, which is an element set too; SECTION= and ADDITIONAL= give such sets if "
        "they belong here; a line makes nodes, elements and labels as those of *LINES do; any text may be a label."
    ),
    name_settings=LINE_SETS,
    labels=True,
    makes=("NODE", "ELEMENT", "ELEMENT SETS"),
)


LINES = OpaqueKeyword(
    keyword="LINES",
    summary="Lines made of sections: nodes, elements, labels and element sets in one.",
    example="*LINES\n LINE=Umbilical\n SECTION=Static Section, 200.0\n SECTION=Dynamic Section, 365.6\n",
    certain=(
        "It makes the nodes and elements of a line, labels for the nodes at its ends, and an element set for the line, "
        "for each section, and for each name in ADDITIONAL=."
    ),
    inferred=(
        "LINE= or NAME= gives the line's name and SECTION= that of a section, each as the first value, ADDITIONAL= has "
        "names only; any text in its lines may be a label."
    ),
    name_settings=LINE_SETS,
    labels=True,
    makes=("NODE", "ELEMENT", "ELEMENT SETS"),
)


_DISTANCE = "; a negative one counts back from the end of the line, bend radii do not count"


class SectionStretch(Row):
    """Values of SECTION=."""

    set_name: Annotated[Name, about("element set that the section makes")] = Field(alias="set")
    start: Annotated[Real, about("distance along the line where the section starts" + _DISTANCE, unit="L", usual=ALONG)]
    end: Annotated[Real | None, about("distance along the line where it ends" + _DISTANCE, unit="L", usual=ALONG)] = (
        None
    )


class PathSection(Record):
    """Section of a line."""

    rule = "path_section"
    section: Annotated[SectionStretch, setting("SECTION", "element set of the section, and where it lies")]
    repeat: Annotated[
        Name | None, setting("REPEAT", "group of *LINE SECTION GROUPS that is repeated here", inline=True)
    ] = None
    additional: Records[AdditionalSets] = Records()


class PathLine(Record):
    """Line and its sections."""

    rule = "path_line"
    line: Annotated[Name, setting("LINE", "line of *LINE PATHS", inferred="it is an element set too")]
    sections: Records[PathSection] = Records()


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
    paths: Records[PathLine] = Records()


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
    """Section of a group."""

    rule = "group_section"
    section: Annotated[SectionLength, setting("SECTION", "element set and length of the section")]
    additional: Records[AdditionalSets] = Records()
    mesh: Annotated[SectionMesh | None, about("element lengths along the section")] = None


class SectionGroup(Record):
    """Group."""

    rule = "section_group"
    name: Annotated[Name, setting("NAME", "name of the group", inferred="it is an element set too")]
    sections: Records[GroupSection] = Records()


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
    groups: Records[SectionGroup] = Records()
