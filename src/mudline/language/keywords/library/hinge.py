"""`*HINGE`: elements that are hinges."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.lists import Element
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.usual import ROTATION
from mudline.language.keywords.values import Facts, Real


class HingeElement(Record):
    """A hinge; its two nodes should lie at one place."""

    rule = "hinge_line"
    element: Element
    stiffness: Annotated[
        Real | None,
        setting(
            "STIFFNESS",
            "rotational stiffness, per degree",
            unit="FL",
            default="0",
            at_least=0,
            inline=True,
            usual=ROTATION,
        ),
    ] = None


class Hinges(Block):
    """Hinges."""

    rule = "hinge"
    page = "kwd_model_hinge"
    facts = Facts(zero_length=True)
    summary = "Elements that are hinges, with a rotational stiffness or none."
    example = "*HINGE\n 12\n 40, STIFFNESS=1500.0\n"

    keyword: Literal["HINGE"] = "HINGE"
    hinges: list[HingeElement] = []


BLOCK = Hinges
