"""`*TIME`: start, end and step of a load case in time."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.keywords.keeping import OpenBlock
from mudline.keywords.model import about, setting
from mudline.keywords.values import Real

_SEEN = "seen in decks of a related program; a block of another form is passed through unchanged"


class TimeSpan(OpenBlock):
    """A span of time with a fixed step."""

    rule = "time"
    sections = ("LOAD CASE",)
    subject = "analysis"
    open_lines = False
    summary = "Start and end of a load case in time, and its step; only the form with a fixed step is read."
    example = "*TIME\n STEP=FIXED\n 0.0, 120.0, 0.05, 24.0\n"

    keyword: Literal["TIME"] = "TIME"
    step: Annotated[
        Literal["FIXED", "VARIABLE"] | None,
        setting("STEP", "how time advances", default="FIXED", inferred=_SEEN, opaque=("VARIABLE",)),
    ] = None
    start: Annotated[Real, about("start of the load case", unit="T", inferred=_SEEN)]
    end: Annotated[Real, about("its end", unit="T", inferred=_SEEN)]
    increment: Annotated[
        Real | None, about("time step", unit="T", above=0, inferred="the third value is the step", also="step")
    ] = None
    ramp: Annotated[Real | None, about("time over which loads grow", unit="T", inferred=_SEEN)] = None


BLOCK = TimeSpan
