"""`*AUXILIARY`: bodies that are drawn, and move with vessels or nodes (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, ListRow, Record
from mudline.language.keywords.usual import COUNT, NUMBER
from mudline.language.keywords.values import Name, Whole


class AuxiliaryRange(ListRow):
    """First and last auxiliary element, and the step between them."""

    start: Annotated[Whole, about("first auxiliary element")]
    end: Annotated[Whole, about("last auxiliary element")]
    increment: Annotated[Whole | None, about("step", default="1", at_least=1, usual=COUNT)] = None


class AuxiliaryList(Record):
    """Auxiliary elements, 20 on a line at most."""

    rule = "auxiliary_list"
    elements: Annotated[list[Whole], about("numbers of auxiliary elements", usual=NUMBER)]


class AuxiliaryGenerate(Record):
    """A range of auxiliary elements."""

    rule = "auxiliary_generate"
    generate: Annotated[AuxiliaryRange, setting("GEN", "range of auxiliary elements")]


class AuxiliaryBody(Record):
    """A body."""

    rule = "auxiliary_body"
    body: Annotated[Name, setting("BODY", "vessel or node that it moves with; NONE: it does not move")]
    members: list[AuxiliaryList | AuxiliaryGenerate] = []


class Auxiliary(Block):
    """Bodies."""

    rule = "auxiliary"
    page = "kwd_model_auxiliary"
    summary = "Auxiliary elements that are drawn as bodies, and what they move with."
    example = "*AUXILIARY\n BODY=FPSO\n 1, 2, 3\n GEN=10, 20, 2\n"

    keyword: Literal["AUXILIARY"] = "AUXILIARY"
    bodies: list[AuxiliaryBody] = []


BLOCK = Auxiliary
