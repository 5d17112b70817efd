"""Title of a deck, and its unit system if the file's suffix does not give it."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *

TITLE = OpaqueKeyword(
    keyword="TITLE",
    summary="The title of a run.",
    example="*TITLE\n 10 in. production riser - base case, Hs = 4.5 m\n",
    certain="It gives a title. No page of the manual was found.",
    inferred="its lines are text for people: nothing is looked for in them. Its section is not confirmed.",
    sections=("PREPROCESSOR", "MODEL", "LOAD CASE"),
    sections_inferred=True,
    free_text=True,
    subject="deck",
)


class Units(Block):
    """Unit system."""

    rule = "units"
    sections = ("ANALYSIS",)
    subject = "deck"
    summary = "The unit system of a deck (sister dialect)."
    example = "*UNITS\n UNITS=METRIC\n"

    keyword: Literal["UNITS"] = "UNITS"
    units: Annotated[
        Literal["METRIC", "IMPERIAL"],
        setting(
            "UNITS",
            "unit system of all values in the deck",
            inferred=(
                "the keyword is seen in decks of a sister dialect and described nowhere: its words are taken for the "
                "systems of the suffixes .keyxm and .keyxi, and a suffix that says the system takes precedence"
            ),
        ),
    ]
