"""`*RAO`: response amplitude operators of vessels (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import model_validator

from mudline.language.keywords.common import require_one
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, rows
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import DIRECTION, LONG_WAVE, SHIFT_RAO, TURN_RAO, Usual
from mudline.language.keywords.values import Contents, Facts, Name, Names, Real
from mudline.language.keywords.vessels import Vessel


class Six(Row):
    """Amplitudes of six motions, of a wave with an amplitude of 1: lengths, and degrees of rotations."""

    heave: Annotated[Real, about("amplitude of heave", usual=SHIFT_RAO)]
    surge: Annotated[Real, about("amplitude of surge", usual=SHIFT_RAO)]
    sway: Annotated[Real, about("amplitude of sway", usual=SHIFT_RAO)]
    yaw: Annotated[Real, about("amplitude of yaw", usual=TURN_RAO)]
    roll: Annotated[Real, about("amplitude of roll", usual=TURN_RAO)]
    pitch: Annotated[Real, about("amplitude of pitch", usual=TURN_RAO)]


class SixPhases(Row):
    """Phases of six motions."""

    heave: Annotated[Real, about("phase of heave", unit="deg", usual=DIRECTION)]
    surge: Annotated[Real, about("phase of surge", unit="deg", usual=DIRECTION)]
    sway: Annotated[Real, about("phase of sway", unit="deg", usual=DIRECTION)]
    yaw: Annotated[Real, about("phase of yaw", unit="deg", usual=DIRECTION)]
    roll: Annotated[Real, about("phase of roll", unit="deg", usual=DIRECTION)]
    pitch: Annotated[Real, about("phase of pitch", unit="deg", usual=DIRECTION)]


class FrequencyRao(Record):
    """Three lines: a frequency, six amplitudes, six phases."""

    rule = "frequency_rao"
    frequency: Annotated[
        Real, about("wave frequency", at_least=0, usual=Usual(high=20.0, why="a frequency in Hz or rad/s", remark=True))
    ]
    amplitudes: Annotated[Six, about("amplitudes for a unit wave", usual=LONG_WAVE)]
    phases: Annotated[SixPhases, about("phases, positive for a lag")]

    @classmethod
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """Line by line."""
        return ("frequency", "amplitudes", "phases")[min(number, 2)]


class HeadingRao(Record):
    """The operators of a heading."""

    rule = "heading_rao"
    heading: Annotated[Real, setting("HEADING", "wave heading", unit="deg", at_least=-180, at_most=180)]
    frequencies: list[FrequencyRao] = []


class RaoLine(Row):
    """A line of LAYOUT=LINE."""

    heading: Annotated[Real, about("wave heading", unit="deg", at_least=-180, at_most=180)]
    frequency: Annotated[
        Real, about("wave frequency", at_least=0, usual=Usual(high=20.0, why="a frequency in Hz or rad/s", remark=True))
    ]
    heave: Annotated[Real, about("amplitude of heave", usual=(SHIFT_RAO, LONG_WAVE))]
    heave_phase: Annotated[Real, about("phase of heave", unit="deg", usual=DIRECTION)]
    surge: Annotated[Real, about("amplitude of surge", usual=SHIFT_RAO)]
    surge_phase: Annotated[Real, about("phase of surge", unit="deg", usual=DIRECTION)]
    sway: Annotated[Real, about("amplitude of sway", usual=SHIFT_RAO)]
    sway_phase: Annotated[Real, about("phase of sway", unit="deg", usual=DIRECTION)]
    yaw: Annotated[Real, about("amplitude of yaw", usual=TURN_RAO)]
    yaw_phase: Annotated[Real, about("phase of yaw", unit="deg", usual=DIRECTION)]
    roll: Annotated[Real, about("amplitude of roll", usual=TURN_RAO)]
    roll_phase: Annotated[Real, about("phase of roll", unit="deg", usual=DIRECTION)]
    pitch: Annotated[Real, about("amplitude of pitch", usual=TURN_RAO)]
    pitch_phase: Annotated[Real, about("phase of pitch", unit="deg", usual=DIRECTION)]


class VesselRao(Record):
    """The operators of a vessel: a file, or lines."""

    rule = "vessel_rao"
    vessel: Vessel
    format: Annotated[Name | None, setting("FORMAT", "MCS, AQWA, WAMIT, MOSES, ORCAFLEX, or one of *RAO FORMAT")] = None
    layout: Annotated[
        Literal["MCS", "LINE"] | None,
        setting("LAYOUT", "by heading, or a line a frequency", default="MCS", inline=True, behind="FORMAT"),
    ] = None
    file: Annotated[
        Name | None,
        setting("FILE", "file with the operators, instead of lines", names=Names.FILE, holds=Contents.OPERATORS),
    ] = None
    headings: list[HeadingRao] = []
    lines: Annotated[Table | None, rows(RaoLine, "of LINE: operators, in any order")] = None

    @model_validator(mode="after")
    def _fits(self) -> VesselRao:
        """A file, or lines of one layout."""
        if self.file or self.headings or self.lines is not None:
            require_one(self, "file", "headings", "lines")
        return self


class Raos(Block):
    """Operators."""

    rule = "rao"
    sections = ("LOAD CASE",)
    subject = "vessels"
    facts = Facts(moves_vessels=True)
    page = "kwd_loadcase_rao"
    summary = "Response amplitude operators of vessels, by file or lines (older than *VESSEL,INTEGRATED)."
    example = (
        "*RAO\n VESSEL=FPSO\n HEADING=0.0\n 0.1\n 0.9, 0.4, 0.0, 0.0, 0.0, 1.1\n 10.0, 90.0, 0.0, 0.0, 0.0, -80.0\n"
    )

    keyword: Literal["RAO"] = "RAO"
    vessels: list[VesselRao] = []


BLOCK = Raos
