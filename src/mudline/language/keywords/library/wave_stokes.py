"""`*WAVE-STOKES`: a Stokes V wave."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.loads import Direction
from mudline.language.keywords.model import Block
from mudline.language.keywords.usual import AMPLITUDE, HEIGHT, WAVE_PERIOD
from mudline.language.keywords.values import Real

_AIRY = "of the Airy wave that moves the vessel"


class StokesWave(Block):
    """A Stokes wave."""

    rule = "wave_stokes"
    sections = ("LOAD CASE",)
    subject = "waves"
    page = "kwd_loadcase_wavestokes"
    summary = "A Stokes V wave, and the Airy wave that stands for it where a vessel moves."
    example = "*WAVE-STOKES\n OPTION=SUPERPOSE\n 6.0, 12.0, 180.0, 3.0, 12.0\n"

    keyword: Literal["WAVE-STOKES"] = "WAVE-STOKES"
    option: Annotated[Literal["SUPERPOSE"] | None, setting("OPTION", "how the response of a vessel is found")] = None
    height: Annotated[Real, about("wave height", unit="L", at_least=0, usual=HEIGHT)]
    period: Annotated[Real, about("wave period", unit="T", above=0, usual=WAVE_PERIOD)]
    direction: Direction = None
    airy_amplitude: Annotated[
        Real | None, about(f"amplitude {_AIRY}", unit="L", default="0", at_least=0, usual=AMPLITUDE)
    ] = None
    airy_period: Annotated[
        Real | None, about(f"period {_AIRY}; it needs an amplitude above 0", unit="T", at_least=0, usual=WAVE_PERIOD)
    ] = None


BLOCK = StokesWave
