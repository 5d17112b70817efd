"""Parameters, and decks generated from variations."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *


class Parameter(Record):
    """Line with the name and value of a parameter, or with a prefix and a list between slashes."""

    rule = "parameter"
    name: Annotated[Name, about("parameter name, or the prefix of a list of parameters", defines=Names.PARAMETER)]
    value: Annotated[
        RealOrName,
        about(
            "number, equation, text, or a list between slashes: /a:1 b:2 3/ gives name_a, name_b and name_1",
            inferred="unnamed items are counted by themselves; a colon or a semicolon joins name and value",
            usual=ANY,
        ),
    ]


class Parameters(Block):
    """Named values."""

    rule = "parameters"
    sections = ("PREPROCESSOR",)
    subject = "deck"
    facts = Facts(defines="parameters")
    page = "kwd_preprocessor_parameters"
    summary = "Named values for equations, and for the variations of a deck."
    slashes = True
    example = "*PARAMETERS\n depth, 500.0\n vessel x, =[depth+5]\n Point, /X:11, Y:22, Z:=[Point_X+10]/\n"

    keyword: Literal["PARAMETERS"] = "PARAMETERS"
    parameters: Records[Parameter] = Records()


class ValueRange(ListRow):
    """First and last value, and the step between them."""

    start: Annotated[Real, about("first value", usual=OF_THE_RUN)]
    end: Annotated[Real, about("last value", usual=OF_THE_RUN)]
    increment: Annotated[Real | None, about("step", default="1", usual=OF_THE_RUN)] = None


class VariedParameter(Record):
    """Parameter with its values: a list, or a range of numbers."""

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
    def _given(self) -> Self:
        """Raise ValueError unless the values come from either a list or a range."""
        if (self.values is None) == (self.generate is None):
            count = "neither" if self.values is None else "both"
            raise ValueError(f"PARA={self.parameter} needs VALUE= or GEN=, found {count}")
        return self


class VariedBlock(Record):
    """Block that is added to the deck, or removed from it."""

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
    """Variation."""

    rule = "named_variation"
    name: Annotated[Name, setting("NAME", "name, by which *COMBINATIONS calls the variation")]
    parameters: Records[VariedParameter] = Records()
    blocks: Records[VariedBlock] = Records()


class Variation(Block):
    """Variations."""

    rule = "variation"
    sections = ("PREPROCESSOR",)
    subject = "deck"
    facts = Facts(plans_decks=True)
    page = "kwd_preprocessor_variation"
    summary = "Variations from deck to deck: values of parameters, blocks to be added or removed."
    example = (
        "*VARIATION\n NAME=Soil\n PARA=su, VALUE=2.0, 5.0, 8.0\n PARA=case, GEN=1, 3\n"
        " NAME=Smooth\n ACTION=REMOVE, KEYWORD=FRICTION, SECTION=LOAD CASE\n"
    )

    keyword: Literal["VARIATION"] = "VARIATION"
    variations: Records[NamedVariation] = Records()


_BEHIND = "DESCRIPTION"


class CombinedVariations(Record):
    """Line of names, at most 20."""

    rule = "combined_variations"
    names: Annotated[
        list[Name],
        setting(
            "VARIATIONS",
            "names of variations, or ALL for every one of the deck",
            inferred="every case of one variation goes with every case of the others",
        ),
    ]


class Combination(Record):
    """Decks for every combination of the cases of some variations."""

    rule = "combination"
    description: Annotated[Name, setting("DESCRIPTION", "what the decks show")]
    subdirectory: Annotated[
        Name | None,
        setting(
            "SUBDIRECTORY", "folder of the decks: `%name%` is the value of a parameter", inline=True, behind=_BEHIND
        ),
    ] = None
    filename: Annotated[
        Name | None,
        setting("FILENAME", "name of their files: `%name%` is the value of a parameter", inline=True, behind=_BEHIND),
    ] = None
    variations: Records[CombinedVariations] = Records()


class Combinations(Block):
    """Combinations."""

    rule = "combinations"
    sections = ("PREPROCESSOR",)
    subject = "deck"
    facts = Facts(plans_decks=True)
    page = "kwd_preprocessor_combinations"
    summary = "The decks that `mudline expand` makes from variations, and the names of their files."
    example = (
        "*COMBINATIONS\n DIRECTORY=Soils\n DESCRIPTION=All soils, SUBDIRECTORY=Case %case%, FILENAME=su %su%\n"
        " VARIATIONS=ALL\n"
    )

    keyword: Literal["COMBINATIONS"] = "COMBINATIONS"
    directory: Annotated[
        Name | None,
        setting(
            "DIRECTORY", "folder of all decks: `%name%` is the value of a parameter", inferred="in the folder of -o"
        ),
    ] = None
    combinations: Records[Combination] = Records()


class ExcelVariations(Block):
    """Variations from a workbook."""

    rule = "excel_variations"
    sections = ("PREPROCESSOR",)
    subject = "deck"
    page = "kwd_preprocessor_excelvariations"
    summary = "Decks to be made from a table of parameters in a workbook."
    example = "*EXCEL VARIATIONS\n SUBDIRECTORY=Cases, FILENAME=Case %Number%\n EXCEL=cases.xlsx, RANGE=A1:D20\n"

    keyword: Literal["EXCEL VARIATIONS"] = "EXCEL VARIATIONS"
    directory: Annotated[Name | None, setting("DIRECTORY", "folder of the decks")] = None
    subdirectory: Annotated[Name | None, setting("SUBDIRECTORY", "folder of a deck; %Parameter% is its value")] = None
    filename: Annotated[
        Name | None, setting("FILENAME", "name of a deck; %Parameter% likewise", inline=True, behind="SUBDIRECTORY")
    ] = None
    excel: Annotated[Name, setting("EXCEL", "workbook", names=Names.FILE)]
    sheet: Annotated[Name | None, setting("SHEET", "its sheet", default="the first", inline=True)] = None
    cells: Annotated[Name, setting("RANGE", "cells with the table", inline=True)]
    orientation: Annotated[
        Literal["HORIZONTAL"] | None, setting("ORIENTATION", "names are in the first column", inline=True)
    ] = None
