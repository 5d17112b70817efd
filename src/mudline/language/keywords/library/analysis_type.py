"""`*ANALYSIS TYPE`: what kind of run a load case is."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import setting
from mudline.language.keywords.keeping import OpenBlock
from mudline.language.keywords.values import Other

_PAGE = (
    "no page of the manual was found: the types are those of known decks, other words and lines are passed through "
    "unchanged"
)
_TYPES = ("STATIC", "QUASI-STATIC", "DYNAMIC", "TIME DOMAIN", "FREQUENCY DOMAIN")


class AnalysisType(OpenBlock):
    """The kind of run."""

    rule = "analysis_type"
    sections = ("LOAD CASE", "ANALYSIS")
    subject = "analysis"
    summary = "What kind of run a load case is: static, or dynamic in the time or frequency domain."
    example = "*ANALYSIS TYPE\n TYPE=STATIC\n"

    keyword: Literal["ANALYSIS TYPE"] = "ANALYSIS TYPE"
    type_: Annotated[
        Literal["STATIC", "QUASI-STATIC", "DYNAMIC", "TIME DOMAIN", "FREQUENCY DOMAIN"] | Other | None,
        setting("TYPE", "kind of run", inferred=_PAGE, opaque=_TYPES),
    ] = Field(default=None, alias="type")


BLOCK = AnalysisType
