"""Postprocessing: element sets, traces, clearance, code checks and fatigue."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *


class ElementSpan(ListRow):
    """First and last element, and the step between them."""

    start: Annotated[Ident, about("first element", names=Names.ELEMENT)]
    end: Annotated[Ident, about("last element", names=Names.ELEMENT)]
    increment: Annotated[Whole | None, about("step", default="1", at_least=1, usual=COUNT)] = None


class ElementList(Record):
    """Elements by number or label, at most 20 on a line."""

    rule = "element_list"
    elements: Annotated[list[Ident], about("element numbers or {labels}", names=Names.ELEMENT)]


class PostElementGenerate(Record):
    """Range of elements."""

    rule = "element_span"
    generate: Annotated[ElementSpan, setting("GEN", "range of elements")]


class OtherSet(Record):
    """All elements of another set."""

    rule = "other_set"
    subset: Annotated[Name, setting("SUBSET", "another set, all of whose elements belong to this one too")]


class PostSet(Record):
    """Set."""

    rule = "post_set"
    name: Annotated[Name, setting("SET", "set name: up to 256 characters; ALL is predefined", defines=Names.SET)]
    members: Records[ElementList | PostElementGenerate | OtherSet] = Records()


class PostSets(Block):
    """Sets of elements for postprocessing."""

    rule = "element_set_post"
    sections = ("DATABASE POSTPROCESSING", "POSTPROCESSING")
    subject = "post-processing"
    page = "kwd_databasepostprocessing_elementsets"
    summary = "Named groups of elements for postprocessing."
    example = "*ELEMENT SET\n SET=Hot Spots\n 1, {Hang-off}, 3\n GEN=10, 20, 2\n SUBSET=Riser\n"

    keyword: Literal["ELEMENT SET"] = "ELEMENT SET"
    sets: Records[PostSet] = Records()


_OF_SECTION = "computed from the diameters"


class StressSection(Row):
    """Dimensions for the computation of stresses."""

    outer: Annotated[
        Real | None,
        about(
            "effective outside diameter", unit="L", default="of the section, or its drag diameter", above=0, usual=WIDTH
        ),
    ] = None
    inner: Annotated[
        Real | None,
        about("effective internal diameter", unit="L", default="of the section", at_least=0, usual=(WIDTH, BORE)),
    ] = None
    area: Annotated[Real | None, about("cross-sectional area", unit="L2", default=_OF_SECTION, above=0, usual=ANY)] = (
        None
    )
    iyy: Annotated[
        Real | None, about("second moment of area about local y", unit="L4", default=_OF_SECTION, above=0, usual=ANY)
    ] = None
    izz: Annotated[
        Real | None, about("second moment of area about local z", unit="L4", default=_OF_SECTION, above=0, usual=ANY)
    ] = None
    thickness: Annotated[
        Real | None, about("smallest wall thickness, for API-2RD", unit="L", default=_OF_SECTION, above=0, usual=ANY)
    ] = None


class StressSet(Record):
    """Properties of a set."""

    rule = "stress_set"
    set_name: SetName = Field(alias="set")
    section: Annotated[StressSection, about("its properties")]


class StressProperties(Block):
    """Properties for stresses."""

    rule = "stress_properties"
    sections = ("DATABASE POSTPROCESSING",)
    subject = "post-processing"
    page = "kwd_databasepostprocessing_properties"
    summary = "Section properties by element set with which postprocessing computes stresses."
    example = "*PROPERTIES\n SET=ALL\n 0.3239, 0.2731, , , , 0.0234\n"

    keyword: Literal["PROPERTIES"] = "PROPERTIES"
    sets: Records[StressSet] = Records()


_PAGE = "no page of the manual was found: one type is named by a page on theory, all lines are passed through unchanged"


class Timetrace(OpenBlock):
    """Plots in time."""

    rule = "timetrace"
    sections = ("DATABASE POSTPROCESSING", "POSTPROCESSING")
    subject = "post-processing"
    page = "theory_postprocessing_advanced_angles_elements"
    summary = "Plots over time from the database of a run."
    example = "*TIMETRACE\n TYPE=ELEMENT_ELEMENT_ANGLE\n"

    keyword: Literal["TIMETRACE"] = "TIMETRACE"
    type_: Annotated[
        Literal["ELEMENT_ELEMENT_ANGLE"] | Other | None,
        setting("TYPE", "what is plotted", inferred=_PAGE, opaque=("ELEMENT_ELEMENT_ANGLE",)),
    ] = Field(default=None, alias="type")


_GROUPS = 2


class ClearRange(Record):
    """Group of elements."""

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
    summary = "The two groups of elements between which clearance is evaluated: exactly two lines."
    example = "*ELEMENT SETS\n 1, 40, 0.35\n 41, 90\n"

    keyword: Literal["ELEMENT SETS"] = "ELEMENT SETS"
    ranges: Records[ClearRange] = Records()

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless there are two groups."""
        if len(self.ranges) != _GROUPS:
            raise ValueError(f"{len(self.ranges)} lines are given: expected exactly {_GROUPS}")
        return self


class ClearDatabase(Block):
    """Files with the positions of the two groups."""

    rule = "clear_database"
    sections = ("CLEAR",)
    subject = "post-processing"
    page = "kwd_clear_database"
    summary = "The databases of the runs between whose elements clearance is evaluated."
    example = "*DATABASE\n DATABASE_1=Riser, DATABASE_2=Umbilical\n"

    keyword: Literal["DATABASE"] = "DATABASE"
    first: Annotated[Name | None, setting("DATABASE_1", "of the first group", default="that of this run")] = None
    second: Annotated[
        Name | None, setting("DATABASE_2", "of the second group", default="that of the first", inline=True)
    ] = None


class CheckedPlace(Record):
    """Place for code checking."""

    rule = "checked_place"
    element: Element
    node: Annotated[
        Whole, about("place on the element; 1 first node, 2 middle, 3 second", at_least=1, at_most=3, usual=COUNT)
    ]
    output: Annotated[
        Literal["ALL", "LFRD", "LRFD", "WSD", "VMS", "METHOD1", "METHOD2", "METHOD3", "METHOD4A", "METHOD4B"],
        setting("OUTPUT", "the code; LFRD is how the manual spells LRFD", inline=True),
    ]


class CheckedSet(Record):
    """Places of a set."""

    rule = "checked_set"
    set_name: SetName = Field(alias="set")
    places: Records[CheckedPlace] = Records()


class CheckingTimetrace(Block):
    """Traces of code checking."""

    rule = "code_checking_timetrace"
    sections = ("CODE CHECKING",)
    subject = "post-processing"
    page = "kwd_codechecking_timetrace"
    summary = "Places whose utilisation is traced in time, by set, and the codes."
    example = "*TIMETRACE\n SET=ALL\n 12, 1, OUTPUT=WSD\n {Hang-off}, 3, OUTPUT=ALL\n"

    keyword: Literal["TIMETRACE"] = "TIMETRACE"
    sets: Records[CheckedSet] = Records()


class SourceType(Block):
    """Source of stresses."""

    rule = "source_type"
    sections = ("LIFETIME FATIGUE",)
    subject = "post-processing"
    page = "kwd_lifetimefatigue_sourcetype"
    summary = "Source of the stresses for fatigue in the time domain: time traces, or databases."
    example = "*SOURCE TYPE\n SOURCE=DATABASE\n"

    keyword: Literal["SOURCE TYPE"] = "SOURCE TYPE"
    source: Annotated[
        Literal["TIMETRACE", "DATABASE"] | None,
        setting(
            "SOURCE",
            "time traces, or databases",
            default="TIMETRACE",
            inferred="the name of the section, from the name of the page",
        ),
    ] = None


_SECTION = "the name of the section, from the name of the page"


class TimeDomainOptions(Block):
    """Options of fatigue in the time domain."""

    rule = "td_options"
    sections = ("LIFETIME FATIGUE",)
    subject = "post-processing"
    page = "kwd_lifetimefatigue_tdoptions"
    summary = "Time histories for fatigue: start time, number of ensembles, and factor."
    example = "*TD OPTIONS\n 100.0, ENSEMBLES=4, SCALE=1.0\n"

    keyword: Literal["TD OPTIONS"] = "TD OPTIONS"
    start: Annotated[Real, about("time from which the histories count", unit="T", inferred=_SECTION, usual=OF_THE_RUN)]
    ensembles: Annotated[
        Whole | None, setting("ENSEMBLES", "number of ensembles", default="4", at_least=2, inline=True, usual=COUNT)
    ] = None
    scale: Annotated[Real | None, setting("SCALE", "factor on the stress", default="1", inline=True, usual=ANY)] = None
