"""`*TIME`: start, end and steps of a load case."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import model_validator

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import OF_THE_RUN, STEP
from mudline.language.keywords.values import Real

_START = "time at which the run starts"
_END = "time at which it ends"
_RAMP = "time over which loads grow"


class FixedSpan(Row):
    """The line under STEP=FIXED."""

    start: Annotated[Real, about(_START, unit="T", usual=OF_THE_RUN)]
    end: Annotated[Real, about(_END, unit="T", usual=OF_THE_RUN)]
    increment: Annotated[
        Real | None,
        about(
            "time step; a static run may leave it out",
            unit="T",
            default="end - start",
            above=0,
            also="step",
            usual=STEP,
        ),
    ] = None
    ramp: Annotated[Real | None, about(_RAMP, unit="T", at_least=0, usual=OF_THE_RUN)] = None


class VariableSpan(Row):
    """The first line under STEP=VARIABLE."""

    start: Annotated[Real, about(_START, unit="T", usual=OF_THE_RUN)]
    end: Annotated[Real, about(_END, unit="T", usual=OF_THE_RUN)]
    ramp: Annotated[Real | None, about(_RAMP, unit="T", at_least=0, usual=OF_THE_RUN)] = None


class StepLimits(Record):
    """A line of limits of a variable step; of several all but the first say from when they hold."""

    rule = "step_limits"
    suggested: Annotated[Real, about("time step to begin with", unit="T", above=0, usual=STEP)]
    least: Annotated[Real, about("smallest time step", unit="T", above=0, usual=OF_THE_RUN)]
    largest: Annotated[Real, about("largest time step", unit="T", above=0, usual=STEP)]
    length: Annotated[Real | None, about("step length", default="0.055", above=0, usual=OF_THE_RUN)] = None
    since: Annotated[Real | None, about("time from which the line holds", unit="T", usual=OF_THE_RUN)] = None


class TimeSpan(Block):
    """A span of time with a fixed or a variable step."""

    rule = "time"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_time"
    summary = "Start and end of a load case in time, and its steps: of one length, or between limits."
    sticky = "step"
    example = "*TIME\n STEP=FIXED\n 0.0, 120.0, 0.05, 24.0\n"

    keyword: Literal["TIME"] = "TIME"
    step: Annotated[
        Literal["FIXED", "VARIABLE"] | None,
        setting("STEP", "one length of the steps, or limits", default="FIXED", inferred="its default, FIXED"),
    ] = None
    fixed: Annotated[FixedSpan | None, about("span under STEP=FIXED")] = None
    variable: Annotated[VariableSpan | None, about("span under STEP=VARIABLE")] = None
    limits: list[StepLimits] = []

    @classmethod
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """The span that STEP= chose."""
        return str(given.get("step") or "FIXED").lower()

    @model_validator(mode="after")
    def _fits(self) -> TimeSpan:
        """Each form has its own lines."""
        step = self.step or "FIXED"
        if getattr(self, step.lower()) is None or (self.fixed and self.variable):
            raise ValueError(f"STEP={step} needs the span {step.lower()!r}, and no other")
        if step == "VARIABLE" and not self.limits:
            raise ValueError("STEP=VARIABLE needs a line of suggested, least and largest step below its first line")
        if step == "FIXED" and self.limits:
            raise ValueError("STEP=FIXED takes one line: start, end, step and ramp")
        if any(one.since is None for one in self.limits[1:]):
            raise ValueError("of several lines of step limits each but the first needs the time from which it holds")
        return self


BLOCK = TimeSpan
