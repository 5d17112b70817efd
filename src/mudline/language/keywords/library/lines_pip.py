"""`*LINES PIP`: lines that lie in or on each other."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from mudline.language.keywords.common import require_one
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import ALONG, ANY
from mudline.language.keywords.values import Name, Names, Real


class Spacing(Row):
    """Where connections are, measured from the start of the primary line."""

    spacing: Annotated[Real | None, about("distance between two", unit="L", above=0, usual=ALONG)] = None
    start: Annotated[Real | None, about("distance of the first", unit="L", at_least=0, usual=ALONG)] = None
    end: Annotated[Real | None, about("distance of the last", unit="L", at_least=0, usual=ALONG)] = None


class _Stiffness(Row):
    stiffness: Annotated[Real, about("stiffness", unit="F/L", at_least=0, usual=ANY)]


class _Curve(Row):
    curve: Annotated[Name, about("curve of *PIP STIFFNESS", names=Names.PIP_STIFFNESS)]


class _Bulkhead(Row):
    bulkhead: Annotated[Literal["BULKHEAD"], about("the word")]


class StiffConnections(Spacing, _Stiffness):  # the last base's fields first
    """Values of STIFFNESS=."""


class CurveConnections(Spacing, _Curve):
    """Values of CURVE=."""


class Bulkheads(Spacing, _Bulkhead):
    """A line of bulkheads."""


class PipLink(Record):
    """A line of connections."""

    rule = "pip_link"
    stiffness: Annotated[StiffConnections | None, setting("STIFFNESS", "connections of a stiffness")] = None
    curve: Annotated[CurveConnections | None, setting("CURVE", "connections with a curve")] = None
    bulkhead: Annotated[Bulkheads | None, about("bulkheads")] = None

    @model_validator(mode="after")
    def _fits(self) -> PipLink:
        """One kind of connection."""
        require_one(self, "stiffness", "curve", "bulkhead")
        return self


class LinePair(Record):
    """Two lines."""

    rule = "line_pair"
    primary: Annotated[Name, setting("PRIMARY", "line of *LINES", names=Names.LINE)]
    secondary: Annotated[Name, setting("SECONDARY", "line in or on it", inline=True, names=Names.LINE)]
    type_: Annotated[
        Literal["PIP", "POP"] | None,
        setting("TYPE", "pipe in pipe, or on pipe", default="PIP", inline=True, inferred="it may be left out"),
    ] = Field(default=None, alias="type")
    offset: Annotated[
        Real | None, setting("OFFSET", "offset along the line", unit="L", default="0", inline=True, usual=ALONG)
    ] = None
    links: list[PipLink] = []


class LinesPip(Block):
    """Pairs of lines."""

    rule = "lines_pip"
    page = "kwd_model_linespip"
    summary = "Lines that lie in or on each other, and what connects them."
    example = (
        "*LINES PIP\n PRIMARY=Carrier, SECONDARY=Flowline, TYPE=PIP\n STIFFNESS=1.0E6, 12.0, 0.0, 480.0\n"
        " BULKHEAD, 240.0, 0.0, 480.0\n"
    )

    keyword: Literal["LINES PIP"] = "LINES PIP"
    pairs: list[LinePair] = []


BLOCK = LinesPip
