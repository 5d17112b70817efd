"""`*WAVE-TIME-HISTORY`: a random sea by the elevation of its surface."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.loads import Direction
from mudline.language.keywords.model import Block
from mudline.language.keywords.usual import COUNT, OF_THE_RUN, POSITION
from mudline.language.keywords.values import Contents, Name, Names, Real, Whole


class WaveTimeHistory(Block):
    """A sea from a file."""

    rule = "wave_time_history"
    sections = ("LOAD CASE",)
    subject = "waves"
    page = "kwd_loadcase_wavetimehistory"
    summary = "A random sea by the elevation of the water surface in time, from a file; in the time domain."
    example = "*WAVE-TIME-HISTORY\n FILE=sea.dat\n 180.0, 0.0, 0.0, 0.25, ENSEMBLES=4\n"

    keyword: Literal["WAVE-TIME-HISTORY"] = "WAVE-TIME-HISTORY"
    file: Annotated[
        Name,
        setting("FILE", "text file with a time and an elevation a line", names=Names.FILE, holds=Contents.ELEVATIONS),
    ]
    direction: Direction = None
    y: Annotated[Real | None, about("Y of the point where it was measured", unit="L", default="0", usual=POSITION)] = (
        None
    )
    z: Annotated[Real | None, about("Z of that point", unit="L", default="0", usual=POSITION)] = None
    increment: Annotated[
        Real | None,
        about("time step; mandatory where the times of the file are uneven", unit="T", above=0, usual=OF_THE_RUN),
    ] = None
    ensembles: Annotated[Whole, setting("ENSEMBLES", "number of ensembles", at_least=1, inline=True, usual=COUNT)]


BLOCK = WaveTimeHistory
