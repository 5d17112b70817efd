"""`*VARIATION`: which parameters and blocks vary from deck to deck."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import model_validator

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, ListRow, Record
from mudline.language.keywords.usual import OF_THE_RUN
from mudline.language.keywords.values import Facts, Name, Names, Real


class ValueRange(ListRow):
    """First and last value, and the step between them."""

    start: Annotated[Real, about("first value", usual=OF_THE_RUN)]
    end: Annotated[Real, about("last value", usual=OF_THE_RUN)]
    increment: Annotated[Real | None, about("step", default="1", usual=OF_THE_RUN)] = None


class VariedParameter(Record):
    """A parameter with its values: a list, or a range of numbers."""

    rule = "varied_parameter"
    parameter: Annotated[
        Name,
        setting(
            "PARA",
            "parameter of *PARAMETERS",
            inferred="the parameters of one variation change together, and need equally many values",
            names=Names.PARAMETER,
        ),
    ]
    values: Annotated[
        list[Name] | None,
        setting("VALUE", "its values, as they are written", inline=True, behind="PARA"),
    ] = None
    generate: Annotated[ValueRange | None, setting("GEN", "range of numbers", inline=True, behind="PARA")] = None

    @model_validator(mode="after")
    def _given(self) -> VariedParameter:
        """Values come from one of the two."""
        if (self.values is None) == (self.generate is None):
            found = "neither" if self.values is None else "both"
            raise ValueError(f"PARA={self.parameter} needs VALUE= or GEN=, found {found}")
        return self


class VariedBlock(Record):
    """A block that is put into the deck, or taken out of it."""

    rule = "varied_block"
    action: Annotated[
        Literal["ADD", "REMOVE"],
        setting("ACTION", "what is done with the block", inferred="in every case of the variation"),
    ]
    keyword: Annotated[
        list[Name],
        setting("KEYWORD", "the keyword; two words where its name has a comma", inline=True, behind="ACTION"),
    ]
    file: Annotated[
        Name | None,
        setting(
            "FILE",
            "file with the lines to add",
            inline=True,
            behind="ACTION",
            inferred="beside the deck; with or without the *KEYWORD line; without FILE= that line alone is added",
            names=Names.FILE,
        ),
    ] = None
    section: Annotated[
        Name | None,
        setting("SECTION", "section of the block", inline=True, behind="ACTION", default="the section of the keyword"),
    ] = None


class NamedVariation(Record):
    """A variation."""

    rule = "named_variation"
    name: Annotated[Name, setting("NAME", "name, by which *COMBINATIONS calls the variation")]
    parameters: list[VariedParameter] = []
    blocks: list[VariedBlock] = []


class Variation(Block):
    """Variations."""

    rule = "variation"
    sections = ("PREPROCESSOR",)
    subject = "deck"
    facts = Facts(plans_decks=True)
    page = "kwd_preprocessor_variation"
    summary = "What varies from deck to deck: values of parameters, blocks that come and go."
    example = (
        "*VARIATION\n NAME=Soil\n PARA=su, VALUE=2.0, 5.0, 8.0\n PARA=case, GEN=1, 3\n"
        " NAME=Smooth\n ACTION=REMOVE, KEYWORD=FRICTION, SECTION=LOAD CASE\n"
    )

    keyword: Literal["VARIATION"] = "VARIATION"
    variations: list[NamedVariation] = []


BLOCK = Variation
