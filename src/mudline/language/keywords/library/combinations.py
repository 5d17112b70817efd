"""`*COMBINATIONS`: the decks that are made from variations, and their files."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.values import Facts, Name

_BEHIND = "DESCRIPTION"


class CombinedVariations(Record):
    """A line of names; the language allows 20 on it."""

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
    """One deck for every combination of the cases of some variations."""

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
    variations: list[CombinedVariations] = []


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
    combinations: list[Combination] = []


BLOCK = Combinations
