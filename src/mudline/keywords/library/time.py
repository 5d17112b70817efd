"""`*TIME`: start, end and step of a load case in time."""

from __future__ import annotations

from collections.abc import Collection
from typing import Annotated, Literal, cast

from mudline.codes.lines import SYN001, SYN004, SYN005
from mudline.diagnostics import Code
from mudline.keywords.model import Block, about, setting
from mudline.keywords.values import Real

_SEEN = "seen in decks of a related program; a block of another form is passed through unchanged"


class TimeSpan(Block):
    """A span of time with a fixed step."""

    rule = "time"
    sections = ("LOAD CASE",)
    subject = "analysis"
    summary = "Start and end of a load case in time, and its step; only the form with a fixed step is read."
    example = "*TIME\n STEP=FIXED\n 0.0, 120.0, 0.05, 24.0\n"

    keyword: Literal["TIME"] = "TIME"
    step: Annotated[Literal["FIXED"], setting("STEP", "how time advances", inferred=_SEEN)]
    start: Annotated[Real, about("start of the load case", unit="T", inferred=_SEEN)]
    end: Annotated[Real, about("its end", unit="T", inferred=_SEEN)]
    increment: Annotated[
        Real | None, about("time step", unit="T", above=0, inferred="the third value is the step", also="step")
    ] = None
    ramp: Annotated[Real | None, about("time over which loads grow", unit="T", inferred=_SEEN)] = None

    def other_form(self, faults: Collection[Code]) -> bool:
        """Another STEP=, other settings, or a row without STEP=: of the fixed step all is known."""
        if cast("str | None", self.step) is not None:
            return False
        return (
            SYN004 in faults or SYN005 in faults or (SYN001 in faults and cast("float | None", self.start) is not None)
        )


BLOCK = TimeSpan
