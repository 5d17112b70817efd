"""`*TIME` of summary postprocessing: the part of a run that is summarised."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block
from mudline.language.keywords.usual import OF_THE_RUN
from mudline.language.keywords.values import Real


class SummaryTime(Block):
    """From when to when."""

    rule = "summary_time"
    sections = ("SUMMARY POSTPROCESSING",)
    subject = "post-processing"
    page = "kwd_summarypostprocessing_time"
    summary = "The part of a run that is summarised: all of it where nothing is given."
    example = "*TIME\n START=20.0\n END=120.0\n"

    keyword: Literal["TIME"] = "TIME"
    start: Annotated[
        Real | None,
        setting(
            "START", "time at which it starts; -1 is the last stored step", unit="T", at_least=-1, usual=OF_THE_RUN
        ),
    ] = None
    end: Annotated[Real | None, setting("END", "time at which it ends", unit="T", usual=OF_THE_RUN)] = None


BLOCK = SummaryTime
