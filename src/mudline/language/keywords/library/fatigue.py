"""Fatigue in the time domain: S-N curves, the places they apply to, and the runs whose stresses are counted."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *

_INTERCEPT = Usual(low=1e4, why="standards give its logarithm, as 12.164 for 1.46E12 (DNV-RP-C203)")
_SLOPE = Usual(2.0, 15.0, "steel has 3 to 5 (DNV-RP-C203), composites about 10")
_CYCLES = Usual(1.0, 1e15, "a number of cycles", remark=True)
_STRESS = Usual(high=1e4, why="the strongest wire has 3000 MPa; stresses are in MPa or ksi", remark=True)


class SingleSlope(Row):
    """Line of a curve of one slope."""

    slope: Annotated[Real, about("inverse slope m", unit="-", above=0, usual=_SLOPE)] = Field(alias="m")
    intercept: Annotated[Real, about("constant K of N = K / S^m", above=0, usual=_INTERCEPT)] = Field(alias="K")
    limit: Annotated[
        Real | None, about("stress range below which nothing is damaged; 1 is none", default="1", usual=_STRESS)
    ] = None


class Segment(Row):
    """Line of a segment of a curve."""

    slope: Annotated[Real, about("inverse slope m", unit="-", above=0, usual=_SLOPE)] = Field(alias="m")
    intercept: Annotated[Real, about("constant K of N = K / S^m", above=0, usual=_INTERCEPT)] = Field(alias="K")
    first: Annotated[Real, about("cycles at which it begins", at_least=0, usual=_CYCLES)] = Field(alias="N1")
    last: Annotated[
        Real,
        about(
            "cycles at which it ends",
            above=0,
            usual=(_CYCLES, Usual(low=1.0, why="it ends behind its beginning", of="/first")),
        ),
    ] = Field(alias="N2")


class EndurancePoint(Row):
    """Point of a curve: stress first."""

    stress: Annotated[Real, about("stress range; it comes first", above=0, usual=_STRESS)] = Field(alias="S")
    cycles: Annotated[Real, about("cycles to failure", above=0, usual=_CYCLES)] = Field(alias="N")


class EnduranceCurve(Record):
    """Curve."""

    rule = "endurance_curve"
    curve: Annotated[Name, setting("CURVE", "name of the curve, for *FATIGUE DATA", defines=Names.S_N_CURVE)]
    type_: Annotated[
        Literal["LOG-LINEAR", "DATA PAIRS"],
        setting("TYPE", "one slope or segments, or points", inline=True),
    ] = Field(alias="type")
    single: Annotated[SingleSlope | None, about("of LOG-LINEAR, three values at most: the slope")] = None
    segments: Annotated[Table | None, Rows("of LOG-LINEAR, four values: a row for each segment", row=Segment)] = None
    points: Annotated[Table | None, Rows("of DATA PAIRS", row=EndurancePoint)] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the field of the form in TYPE=; four values are a segment."""
        if values.get("type") == "DATA PAIRS":
            return "points"
        return "segments" if fields == len(Segment.model_fields) else "single"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the curve has rows of one form, that of its type."""
        require_one(self, *(("points",) if self.type_ == "DATA PAIRS" else ("single", "segments")))
        require_one(self, "single", "segments", "points")
        return self


class EnduranceCurves(Block):
    """S-N curves."""

    rule = "s_n_curve"
    sections = ("LIFETIME FATIGUE",)
    subject = "post-processing"
    page = "kwd_lifetimefatigue_sncurve"
    summary = "S-N curves, by slopes or by points: stress range and cycles to failure; named by *FATIGUE DATA."
    example = "*S-N CURVE\n CURVE=D, TYPE=LOG-LINEAR\n 3.0, 1.4588E12, 0.0, 1.0E7\n 5.0, 4.0427E15, 1.0E7, 1.0E15\n"

    keyword: Literal["S-N CURVE"] = "S-N CURVE"
    curves: Records[EnduranceCurve] = Records()


class HotSpots(Record):
    """Data of a set of hot spots."""

    rule = "hot_spots"
    set_name: Annotated[Name, setting("SET", "set of *HOT SPOT SETS", unique=True)] = Field(alias="set")
    curve: Annotated[Name, setting("CURVE", "S-N curve", names=Names.S_N_CURVE)]
    concentration: Annotated[
        Real | None,
        setting(
            "SCF",
            "stress concentration factor",
            default="1",
            above=0,
            inline=True,
            usual=Usual(1.0, 10.0, "welds and connectors have 1 to 5"),
        ),
    ] = None
    stress: Annotated[
        Literal["COMBINED", "BENDING", "AXIAL"] | None,
        setting("STRESS", "stresses that count", default="COMBINED", inline=True),
    ] = None
    thickness: Annotated[
        Real | None,
        setting(
            "TB",
            "thickness above which the wall counts; without it the wall does not count",
            unit="L",
            above=0,
            inline=True,
            usual=Usual(0.005, 0.2, "DNV-RP-C203 has 0.025 m", typical=0.025, within=1.7),
        ),
    ] = None
    exponent: Annotated[
        Real | None,
        setting(
            "EXPONENT",
            "exponent n of the thickness: 4 is its fourth root",
            default="4",
            above=0,
            inline=True,
            usual=Usual(2.0, 12.0, "DNV-RP-C203 has powers of 0.1 to 0.3, that is 1/n"),
        ),
    ] = None


class FatigueData(Block):
    """Data of hot spots."""

    rule = "fatigue_data"
    sections = ("LIFETIME FATIGUE",)
    subject = "post-processing"
    page = "kwd_lifetimefatigue_fatiguedata"
    summary = "S-N curve, stress concentration and thickness effect of each set of hot spots."
    example = "*FATIGUE DATA\n SET=Touchdown\n CURVE=D, SCF=1.2, TB=0.025\n"

    keyword: Literal["FATIGUE DATA"] = "FATIGUE DATA"
    sets: Records[HotSpots] = Records()


class GeneratedHistories(Row):
    """Time histories made from mode shapes."""

    generate: Annotated[Literal["YES", "NO"], about("histories of the inner pipe are made", default="YES")]
    periods: Annotated[Whole | None, about("number of periods", default="1", at_least=1, usual=COUNT)] = None
    points: Annotated[Whole | None, about("number of points in a period", default="40", at_least=2, usual=COUNT)] = None


class SimulatedSeastate(Record):
    """Run, and its share of the time."""

    rule = "simulated_seastate"
    file: Annotated[Name, setting("FILE", "name of the run, without a suffix")]
    share: Annotated[Real, setting("PERCENT", "percentage of the time", at_least=0, at_most=100, usual=OF_THE_RUN)]
    frequency: Annotated[
        Real | None,
        setting("FREQUENCY", "frequency of the mode, in fatigue by vortices", inline=True, at_least=0, usual=ANY),
    ] = None


class SeastateFiles(Block):
    """Runs that are counted."""

    rule = "seastate_files"
    sections = ("LIFETIME FATIGUE",)
    subject = "post-processing"
    page = "kwd_lifetimefatigue_seastatefiles"
    summary = "The runs whose stresses are counted, and the percentage of the time for which each stands."
    example = "*SEASTATE FILES\n FILE=Sea 01\n PERCENT=62.5\n FILE=Sea 02\n PERCENT=37.5\n"

    keyword: Literal["SEASTATE FILES"] = "SEASTATE FILES"
    generated: Annotated[
        GeneratedHistories | None, setting("PIP VIV AUTOGENERATE", "in fatigue by vortices of pipes in pipes")
    ] = None
    seastates: Records[SimulatedSeastate] = Records()
