"""`*TD OPTIONS`: how time histories are read for fatigue."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block
from mudline.language.keywords.usual import ANY, COUNT, OF_THE_RUN
from mudline.language.keywords.values import Real, Whole

_SECTION = "the name of the section, from the name of the page"


class TimeDomainOptions(Block):
    """Options of fatigue in the time domain."""

    rule = "td_options"
    sections = ("LIFETIME FATIGUE",)
    subject = "post-processing"
    page = "kwd_lifetimefatigue_tdoptions"
    summary = "From when on time histories count for fatigue, in how many ensembles, and their factor."
    example = "*TD OPTIONS\n 100.0, ENSEMBLES=4, SCALE=1.0\n"

    keyword: Literal["TD OPTIONS"] = "TD OPTIONS"
    start: Annotated[Real, about("time from which the histories count", unit="T", inferred=_SECTION, usual=OF_THE_RUN)]
    ensembles: Annotated[
        Whole | None, setting("ENSEMBLES", "number of ensembles", default="4", at_least=2, inline=True, usual=COUNT)
    ] = None
    scale: Annotated[Real | None, setting("SCALE", "factor on the stress", default="1", inline=True, usual=ANY)] = None


BLOCK = TimeDomainOptions
