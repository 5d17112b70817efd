"""`*TIMETRACE` of code checking: where and by what code utilisation is traced."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.lists import Element
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.usual import COUNT
from mudline.language.keywords.values import Name, Names, Whole


class CheckedPlace(Record):
    """A place."""

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
    """The places of a set."""

    rule = "checked_set"
    set_name: Annotated[Name, setting("SET", "element set", names=Names.SET)] = Field(alias="set")
    places: list[CheckedPlace] = []


class CheckingTimetrace(Block):
    """Traces of code checking."""

    rule = "code_checking_timetrace"
    sections = ("CODE CHECKING",)
    subject = "post-processing"
    page = "kwd_codechecking_timetrace"
    summary = "Places whose utilisation is traced in time, by set, and the codes."
    example = "*TIMETRACE\n SET=ALL\n 12, 1, OUTPUT=WSD\n {Hang-off}, 3, OUTPUT=ALL\n"

    keyword: Literal["TIMETRACE"] = "TIMETRACE"
    sets: list[CheckedSet] = []


BLOCK = CheckingTimetrace
