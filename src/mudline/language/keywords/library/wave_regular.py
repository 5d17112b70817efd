"""`*WAVE-REGULAR`: regular Airy waves."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import model_validator

from mudline.language.keywords.common import require_one
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.loads import Direction
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import AMPLITUDE, COUNT, DIRECTION, WAVE_PERIOD
from mudline.language.keywords.values import Real, Whole

_AMPLITUDE = about("wave amplitude, half of its height", unit="L", at_least=0, usual=AMPLITUDE)
_LEAST = about("smallest period", unit="T", above=0, usual=WAVE_PERIOD)
_LARGEST = about("largest period", unit="T", above=0, usual=WAVE_PERIOD)
_NUMBER = about("number of periods", at_least=1, usual=COUNT)
_FIELDS = "a line of four values has no direction"


class Wave(Row):
    """A wave, in the time domain or under OPTION=ONE."""

    amplitude: Annotated[Real, _AMPLITUDE]
    period: Annotated[Real, about("wave period", unit="T", above=0, usual=WAVE_PERIOD)]
    direction: Direction = None
    phase: Annotated[
        Real | None, about("phase; not in the frequency domain", unit="deg", default="0", usual=DIRECTION)
    ] = None


class Band(Row):
    """Waves of several periods under OPTION=MANY."""

    amplitude: Annotated[Real, _AMPLITUDE]
    least: Annotated[Real, _LEAST]
    largest: Annotated[Real, _LARGEST]
    number: Annotated[Whole, _NUMBER]


class DirectedBand(Row):
    """The same with a direction."""

    amplitude: Annotated[Real, _AMPLITUDE]
    direction: Direction = None
    least: Annotated[Real, _LEAST]
    largest: Annotated[Real, _LARGEST]
    number: Annotated[Whole, _NUMBER]


class RegularWave(Record):
    """A line of waves; `option` is given where it changes."""

    rule = "regular_wave"
    sticky = "option"
    option: Annotated[
        Literal["ONE", "MANY"] | None, setting("OPTION", "of the frequency domain: one period, or many")
    ] = None
    wave: Annotated[Wave | None, about("wave of one period")] = None
    band: Annotated[Band | None, about("waves of many periods", inferred=_FIELDS)] = None
    directed_band: Annotated[DirectedBand | None, about("the same with a direction", inferred=_FIELDS)] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """What OPTION= chose, here or on an earlier line."""
        if (given.get("option") or last) != "MANY":
            return "wave"
        return "band" if fields == len(Band.model_fields) else "directed_band"

    @model_validator(mode="after")
    def _fits(self) -> RegularWave:
        """One line."""
        require_one(self, "wave", "band", "directed_band")
        return self


class RegularWaves(Block):
    """Regular waves."""

    rule = "wave_regular"
    sections = ("LOAD CASE",)
    subject = "waves"
    page = "kwd_loadcase_waveregular"
    summary = "Regular Airy waves: amplitude, period, direction and phase of each."
    example = "*WAVE-REGULAR\n 1.0, 9.0, 180.0, 0.0\n 0.5, 14.0\n"

    keyword: Literal["WAVE-REGULAR"] = "WAVE-REGULAR"
    waves: list[RegularWave] = []


BLOCK = RegularWaves
