"""`*PIP SECTION`: element sets that lie in each other."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.values import Name, Names


class PipSets(Record):
    """A set inside of another one."""

    rule = "pip_sets"
    outer: Annotated[Name, setting("OUTER", "set of the outer pipe", names=Names.SET)]
    inner: Annotated[Name, setting("INNER", "set of the inner pipe", names=Names.SET, inline=True)]


class PipSections(Block):
    """Pipes in pipes."""

    rule = "pip_section"
    page = "kwd_model_pipsection"
    summary = "Which element set lies inside of which one."
    example = "*PIP SECTION\n INNER_HYDRO=LHS, AUTO_CREATE=YES\n OUTER=Outer Pipe, INNER=Inner Pipe\n"

    keyword: Literal["PIP SECTION"] = "PIP SECTION"
    inner_hydro: Annotated[
        Literal["LHS", "RHS"] | None, setting("INNER_HYDRO", "side of the equations of the inner forces", default="LHS")
    ] = None
    auto_create: Annotated[
        Literal["YES", "NO"] | None,
        setting("AUTO_CREATE", "connections are made of themselves", default="YES", inline=True),
    ] = None
    pipes: list[PipSets] = []


BLOCK = PipSections
