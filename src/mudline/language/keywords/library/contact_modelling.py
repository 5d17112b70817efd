"""`*CONTACT MODELLING`: how the contact with guides begins."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block
from mudline.language.keywords.usual import ANY
from mudline.language.keywords.values import Real


class ContactModelling(Block):
    """The ramp of contact."""

    rule = "contact_modelling"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_contactmodelling"
    summary = "How the contact with guides grows over a distance."
    example = "*CONTACT MODELLING\n RAMP=0.01, POWER=1.5\n"

    keyword: Literal["CONTACT MODELLING"] = "CONTACT MODELLING"
    ramp: Annotated[
        Real, setting("RAMP", "distance over which contact grows; 0 without", unit="L", at_least=0, usual=ANY)
    ]
    power: Annotated[
        Real | None, setting("POWER", "exponent of the growth", default="1.5", above=0, inline=True, usual=ANY)
    ] = None


BLOCK = ContactModelling
