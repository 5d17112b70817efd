"""What the keywords of summary postprocessing share: the head of a request."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Row
from mudline.language.keywords.usual import ANY, COUNT
from mudline.language.keywords.values import Name, Real, Title, Whole

LOCATION = "place on the section, of outputs that have one"
AXIS = "name of an axis system of *AXIS/VECTOR"


class SummaryRequest(Block):
    """A request: its head."""

    sections = ("SUMMARY POSTPROCESSING",)
    subject = "post-processing"

    title: Annotated[Title | None, setting("TITLE", "title of the output", default="blank")] = None
    scale: Annotated[Real | None, setting("SCALE", "factor on the values", default="1", usual=ANY)] = None
    units: Annotated[
        Name | None, setting("UNITS", "unit of the output", default="of its kind", inline=True, behind="SCALE")
    ] = None
    plot: Annotated[Literal["YES", "NO"] | None, setting("PLOT", "plot beside the summary", default="NO")] = None


LocalNode = Annotated[
    Whole,
    setting("DATA2", "place on the element; 1 first node, 2 middle, 3 second node", at_least=1, at_most=3, usual=COUNT),
]


class ForceVariable(Row):
    """What is asked for."""

    variable: Annotated[Name, about("output variable, in the words of the manual")]
    location: Annotated[Name | None, about(LOCATION)] = None
