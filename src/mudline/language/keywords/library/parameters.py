"""`*PARAMETERS`: named values that equations use."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.usual import ANY
from mudline.language.keywords.values import Facts, Name, Names, RealOrName


class Parameter(Record):
    """One line: a name with its value, or a prefix with a list between slashes."""

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
    parameters: list[Parameter] = []


BLOCK = Parameters
