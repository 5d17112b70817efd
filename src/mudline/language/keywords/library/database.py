"""`*DATABASE`: when results are stored."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import model_validator

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block
from mudline.language.keywords.usual import OF_THE_RUN
from mudline.language.keywords.values import Real


class Database(Block):
    """When results are stored."""

    rule = "database"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_database"
    summary = "When results are stored: at all times, at selected ones, at the end, or never. Once in a load case."
    example = "*DATABASE\n TIME=SELECTED\n 60.0, 0.5\n"

    keyword: Literal["DATABASE"] = "DATABASE"
    time: Annotated[Literal["ALL", "SELECTED", "END", "NONE"], setting("TIME", "the times")]
    start: Annotated[
        Real | None,
        about("of SELECTED: first time", unit="T", default="the start of the run", at_least=0, usual=OF_THE_RUN),
    ] = None
    interval: Annotated[Real | None, about("of SELECTED: time between two", unit="T", above=0, usual=OF_THE_RUN)] = None

    @model_validator(mode="after")
    def _fits(self) -> Database:
        """Only selected times have a line of their own."""
        if self.time == "SELECTED" and self.interval is None:
            raise ValueError("TIME=SELECTED needs a line `start, interval` below it")
        if self.time != "SELECTED" and (self.start is not None or self.interval is not None):
            raise ValueError(f"TIME={self.time} takes no line below it: only SELECTED does")
        return self


BLOCK = Database
