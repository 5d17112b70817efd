"""`*UNITS`: the unit system of decks whose suffix does not say it."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block


class Units(Block):
    """The unit system."""

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
