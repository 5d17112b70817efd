"""`*RESTART`: the deck that a load case continues."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import setting
from mudline.language.keywords.keeping import OpenBlock
from mudline.language.keywords.values import Name, Names

_WORDS = "the words of the manual are taken as they are, and not checked"


class Restart(OpenBlock):
    """The run that goes before."""

    rule = "restart"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_restart"
    summary = "The deck that this one continues: its model holds here, too."
    example = "*RESTART\n LAST=static\n"

    keyword: Literal["RESTART"] = "RESTART"
    last: Annotated[
        Name,
        setting(
            "LAST",
            "file of the deck before, beside this one; its suffix may be left out",
            inferred="the model of that deck comes before what this deck has of its own",
            names=Names.DECK,
        ),
    ]
    type_: Annotated[
        Name | None,
        setting("TYPE", "what follows the last run: DYNAMIC, STATIC or CONTINUATION", inline=True, inferred=_WORDS),
    ] = Field(default=None, alias="type")
    option: Annotated[
        Name | None,
        setting("OPTION", "APPEND: results go on in the same file, for a CONTINUATION", inline=True, inferred=_WORDS),
    ] = None


BLOCK = Restart
