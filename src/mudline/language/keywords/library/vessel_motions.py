"""Motions of vessels in a load case: offsets, drifts, velocities, response amplitude operators."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *

_VESSEL = "vessel of *VESSEL or *VESSEL,INTEGRATED"
Vessel = Annotated[Name, setting("VESSEL", _VESSEL, names=Names.VESSEL)]
OneVessel = Annotated[Name, setting("VESSEL", _VESSEL, names=Names.VESSEL, unique=True)]


class Motion(Row):
    """Six displacements of a vessel."""

    x: Annotated[Real, about("shift along the global X axis", unit="L", usual=VERTICAL_OFFSET)]
    y: Annotated[Real | None, about("shift along the global Y axis", unit="L", default="0", usual=OFFSET)] = None
    z: Annotated[Real | None, about("shift along the global Z axis", unit="L", default="0", usual=OFFSET)] = None
    yaw: Annotated[Real | None, about("turn about the vertical axis", unit="deg", default="0", usual=DIRECTION)] = None
    roll: Annotated[
        Real | None, about("turn about the surge axis of the vessel", unit="deg", default="0", usual=HEEL)
    ] = None
    pitch: Annotated[
        Real | None, about("turn about the sway axis of the vessel", unit="deg", default="0", usual=HEEL)
    ] = None


class VesselOffset(Record):
    """Offset of a vessel."""

    rule = "vessel_offset"
    vessel: OneVessel
    option: Annotated[Name | None, setting("OPTION", "what the offset is given as", inferred=OLDER, older=True)] = None
    offset: Annotated[Motion, setting("OFFSET", "displacements from the initial position")]


class Offsets(Block):
    """Offsets."""

    rule = "offset"
    sections = ("LOAD CASE",)
    subject = "vessels"
    page = "kwd_loadcase_offset"
    summary = "Offsets of vessels from their initial positions."
    example = "*OFFSET\n VESSEL=FPSO\n OFFSET=0.0, -8.0, 0.0\n"

    keyword: Literal["OFFSET"] = "OFFSET"
    offsets: Records[VesselOffset] = Records()


class Velocity(Record):
    """Velocity of a vessel."""

    rule = "velocity"
    vessel: Vessel
    axis: Annotated[
        Literal["GLOBAL", "LOCAL"] | None,
        setting("AXIS", "axis from which the direction counts: global Y or surge", default="GLOBAL", inline=True),
    ] = None
    speed: Annotated[Real, about("speed", unit="L/T", usual=Usual(-30.0, 30.0, "ships are no faster"))]
    angle: Annotated[Real | None, about("direction, anticlockwise", unit="deg", default="0", usual=DIRECTION)] = None


class VesselVelocity(Block):
    """Velocities."""

    rule = "vessel_velocity"
    sections = ("LOAD CASE",)
    subject = "vessels"
    page = "kwd_loadcase_vesselvelocity"
    summary = "Constant velocities of vessels, in addition to their other motions; not with *VESSEL TIMETRACE."
    example = "*VESSEL VELOCITY\n VESSEL=FPSO, AXIS=LOCAL\n 0.5, 0.0\n"

    keyword: Literal["VESSEL VELOCITY"] = "VESSEL VELOCITY"
    velocities: Records[Velocity] = Records()


class VesselMotion(Record):
    """Motion of a vessel."""

    rule = "vessel_motion"
    vessel: Vessel
    option: Annotated[
        Literal["GLOBAL", "LOCAL"] | None,
        setting("OPTION", "axes of the displacements", default="GLOBAL", inline=True),
    ] = None
    file: Annotated[
        Name,
        setting(
            "FILE", "text file of seven columns: time, six displacements", names=Names.FILE, holds=DataFile.MOTIONS
        ),
    ]


class VesselTimetrace(Block):
    """Motions from files."""

    rule = "vessel_timetrace"
    sections = ("LOAD CASE",)
    subject = "vessels"
    facts = Facts(moves_vessels=True)
    page = "kwd_loadcase_vesseltimetrace"
    summary = "Motions of vessels, of low and high frequency together, from files; not with *RAO or *DRIFT."
    example = "*VESSEL TIMETRACE\n VESSEL=FPSO\n FILE=motion.dat\n"

    keyword: Literal["VESSEL TIMETRACE"] = "VESSEL TIMETRACE"
    motions: Records[VesselMotion] = Records()


_SEVERAL = "several sinusoids of a vessel: the pair of lines is repeated"


class Sinusoid(Row):
    """Drift in one degree of freedom."""

    dof: Freedom
    amplitude: Annotated[
        Real, about("amplitude: a length, of a rotation degrees", usual=OF_A_KIND, written_in=("L", "deg"))
    ]
    phase: Annotated[Real, about("phase", unit="deg", usual=DIRECTION)]
    period: Annotated[Real, about("period", unit="T", above=0, usual=DRIFT_PERIOD)]


class VesselDrift(Record):
    """Drift of a vessel: a sinusoid, or a file."""

    rule = "vessel_drift"
    vessel: Vessel
    type_: Annotated[
        Literal["SINUSOIDAL", "FILE"],
        setting("TYPE", "a sinusoid, or a time history", inline=True, inferred=_SEVERAL),
    ] = Field(alias="type")
    option: Annotated[
        Literal["GLOBAL", "LOCAL"] | None, setting("OPTION", "axes of the drift", default="GLOBAL", inline=True)
    ] = None
    sinusoid: Annotated[Sinusoid | None, about("of SINUSOIDAL")] = None
    file: Annotated[
        Name | None,
        setting(
            "FILE",
            "of FILE: text file of seven columns, time and six displacements",
            names=Names.FILE,
            holds=DataFile.MOTIONS,
        ),
    ] = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the line is that of the type."""
        require_one(self, "sinusoid" if self.type_ == "SINUSOIDAL" else "file")
        require_one(self, "sinusoid", "file")
        return self


class Drift(Block):
    """Drifts."""

    rule = "drift"
    sections = ("LOAD CASE",)
    subject = "vessels"
    page = "kwd_loadcase_drift"
    summary = "Slow motions of vessels: sinusoids, or time histories from files."
    example = "*DRIFT\n VESSEL=FPSO, TYPE=SINUSOIDAL\n 2, 4.0, 0.0, 120.0\n"

    keyword: Literal["DRIFT"] = "DRIFT"
    drifts: Records[VesselDrift] = Records()


class Six(Row):
    """Amplitudes of six motions for a wave of amplitude 1: lengths, and degrees for rotations."""

    heave: Annotated[Real, about("amplitude of heave", usual=SHIFT_RAO, written_in=("L/L",))]
    surge: Annotated[Real, about("amplitude of surge", usual=SHIFT_RAO, written_in=("L/L",))]
    sway: Annotated[Real, about("amplitude of sway", usual=SHIFT_RAO, written_in=("L/L",))]
    yaw: Annotated[Real, about("amplitude of yaw", usual=TURN_RAO, written_in=("deg/L",))]
    roll: Annotated[Real, about("amplitude of roll", usual=TURN_RAO, written_in=("deg/L",))]
    pitch: Annotated[Real, about("amplitude of pitch", usual=TURN_RAO, written_in=("deg/L",))]


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
        Real,
        about(
            "wave frequency",
            at_least=0,
            unique=True,
            usual=Usual(high=20.0, why="a frequency in Hz or rad/s", remark=True),
        ),
    ]
    amplitudes: Annotated[Six, about("amplitudes for a unit wave", usual=LONG_WAVE)]
    phases: Annotated[SixPhases, about("phases, positive for a lag")]

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the field of the next line: frequency, amplitudes, phases."""
        return ("frequency", "amplitudes", "phases")[min(number, 2)]


class HeadingRao(Record):
    """Operators of a heading."""

    rule = "heading_rao"
    heading: Annotated[Real, setting("HEADING", "wave heading", unit="deg", at_least=-180, at_most=180, unique=True)]
    frequencies: Records[FrequencyRao] = Records()


class RaoLine(Row):
    """Line of LAYOUT=LINE."""

    heading: Annotated[Real, about("wave heading", unit="deg", at_least=-180, at_most=180)]
    frequency: Annotated[
        Real, about("wave frequency", at_least=0, usual=Usual(high=20.0, why="a frequency in Hz or rad/s", remark=True))
    ]
    heave: Annotated[Real, about("amplitude of heave", usual=(SHIFT_RAO, LONG_WAVE), written_in=("L/L",))]
    heave_phase: Annotated[Real, about("phase of heave", unit="deg", usual=DIRECTION)]
    surge: Annotated[Real, about("amplitude of surge", usual=SHIFT_RAO, written_in=("L/L",))]
    surge_phase: Annotated[Real, about("phase of surge", unit="deg", usual=DIRECTION)]
    sway: Annotated[Real, about("amplitude of sway", usual=SHIFT_RAO, written_in=("L/L",))]
    sway_phase: Annotated[Real, about("phase of sway", unit="deg", usual=DIRECTION)]
    yaw: Annotated[Real, about("amplitude of yaw", usual=TURN_RAO, written_in=("deg/L",))]
    yaw_phase: Annotated[Real, about("phase of yaw", unit="deg", usual=DIRECTION)]
    roll: Annotated[Real, about("amplitude of roll", usual=TURN_RAO, written_in=("deg/L",))]
    roll_phase: Annotated[Real, about("phase of roll", unit="deg", usual=DIRECTION)]
    pitch: Annotated[Real, about("amplitude of pitch", usual=TURN_RAO, written_in=("deg/L",))]
    pitch_phase: Annotated[Real, about("phase of pitch", unit="deg", usual=DIRECTION)]


class VesselRao(Record):
    """Operators of a vessel: a file, or lines."""

    rule = "vessel_rao"
    vessel: OneVessel
    format: Annotated[Name | None, setting("FORMAT", "MCS, AQWA, WAMIT, MOSES, ORCAFLEX, or one of *RAO FORMAT")] = None
    layout: Annotated[
        Literal["MCS", "LINE"] | None,
        setting("LAYOUT", "by heading, or a line a frequency", default="MCS", inline=True, behind="FORMAT"),
    ] = None
    file: Annotated[
        Name | None,
        setting("FILE", "file with the operators, instead of lines", names=Names.FILE, holds=DataFile.OPERATORS),
    ] = None
    first: Annotated[
        Literal["YES", "NO"] | None,
        setting("FIRSTRAO", "YES: the operators of the first load case", inferred=OLDER, older=True),
    ] = None
    headings: Records[HeadingRao] = Records()
    lines: Annotated[Table | None, rows(RaoLine, "of LINE: operators, in any order")] = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless a vessel has either a file or lines of one layout."""
        if self.file or self.first or self.headings or self.lines is not None:
            require_one(self, "file", "first", "headings", "lines")
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
    vessels: Records[VesselRao] = Records()
