"""Regular and tabulated waves of a load case, and the spectra of a wave scatter."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *

_AMPLITUDE = about("wave amplitude, half of its height", unit="L", at_least=0, usual=AMPLITUDE)
_LEAST = about("smallest period", unit="T", above=0, usual=WAVE_PERIOD)
_LARGEST = about("largest period", unit="T", above=0, usual=WAVE_PERIOD)
_NUMBER = about("number of periods", at_least=1, usual=COUNT)
_FIELDS = "a line of four values has no direction"


class Wave(Row):
    """Wave, in the time domain or under OPTION=ONE."""

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
    """Waves of several periods, with a direction."""

    amplitude: Annotated[Real, _AMPLITUDE]
    direction: Direction = None
    least: Annotated[Real, _LEAST]
    largest: Annotated[Real, _LARGEST]
    number: Annotated[Whole, _NUMBER]


class RegularWave(Record):
    """Line of waves; `option` is given where it changes."""

    rule = "regular_wave"
    sticky = "option"
    option: Annotated[
        Literal["ONE", "MANY"] | None, setting("OPTION", "of the frequency domain: one period, or many")
    ] = None
    wave: Annotated[Wave | None, about("wave of one period")] = None
    band: Annotated[Band | None, about("waves of many periods", inferred=_FIELDS)] = None
    directed_band: Annotated[DirectedBand | None, about("the same with a direction", inferred=_FIELDS)] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the form in OPTION=, here or on an earlier line."""
        if (values.get("option") or last) != "MANY":
            return "wave"
        return "band" if fields == len(Band.model_fields) else "directed_band"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the line has exactly one form."""
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
    waves: Records[RegularWave] = Records()


_AIRY = "of the Airy wave that moves the vessel"
_AiryAmplitude = Annotated[Real | None, about(f"amplitude {_AIRY}", unit="L", default="0", at_least=0, usual=AMPLITUDE)]
_AiryPeriod = Annotated[
    Real | None, about(f"period {_AIRY}; it needs an amplitude above 0", unit="T", at_least=0, usual=WAVE_PERIOD)
]


class _SteepWave(Block):
    """Wave with a shape of its own, for which an Airy wave stands in the motions of vessels."""

    sections = ("LOAD CASE",)
    subject = "waves"
    option: Annotated[Literal["SUPERPOSE"] | None, setting("OPTION", "how the response of a vessel is found")] = None
    height: Annotated[Real, about("wave height", unit="L", at_least=0, usual=HEIGHT)]
    period: Annotated[Real, about("wave period", unit="T", above=0, usual=WAVE_PERIOD)]
    direction: Direction = None


class StokesWave(_SteepWave):
    """Stokes wave."""

    rule = "wave_stokes"
    page = "kwd_loadcase_wavestokes"
    summary = "A Stokes V wave, and the Airy wave that replaces it for the motions of vessels."
    example = "*WAVE-STOKES\n OPTION=SUPERPOSE\n 6.0, 12.0, 180.0, 3.0, 12.0\n"

    keyword: Literal["WAVE-STOKES"] = "WAVE-STOKES"
    airy_amplitude: _AiryAmplitude = None
    airy_period: _AiryPeriod = None


class DeanWave(_SteepWave):
    """Stream function wave."""

    rule = "wave_deans"
    page = "kwd_loadcase_wavedeans"
    summary = "A wave of Dean's stream function, and the Airy wave that replaces it for the motions of vessels."
    example = "*WAVE-DEANS\n 6.0, 12.0, 180.0, 0.5, 15, 100, 5, 3.0, 12.0\n"

    keyword: Literal["WAVE-DEANS"] = "WAVE-DEANS"
    current: Annotated[
        Real | None, about("velocity of the current below the wave", unit="L/T", default="0", usual=CURRENT)
    ] = None
    order: Annotated[Whole | None, about("order of the stream function", default="15", at_least=1, usual=COUNT)] = None
    iterations: Annotated[
        Whole | None, about("largest number of iterations", default="100", at_least=1, usual=COUNT)
    ] = None
    ramp: Annotated[
        Whole | None, about("steps in which the wave grows to its height", default="5", at_least=1, usual=COUNT)
    ] = None
    airy_amplitude: _AiryAmplitude = None
    airy_period: _AiryPeriod = None


class WaveTimeHistory(Block):
    """Sea from a file."""

    rule = "wave_time_history"
    sections = ("LOAD CASE",)
    subject = "waves"
    page = "kwd_loadcase_wavetimehistory"
    summary = "A random sea by a time history of the water surface, from a file; in the time domain."
    example = "*WAVE-TIME-HISTORY\n FILE=sea.dat\n 180.0, 0.0, 0.0, 0.25, ENSEMBLES=4\n"

    keyword: Literal["WAVE-TIME-HISTORY"] = "WAVE-TIME-HISTORY"
    file: Annotated[
        Name,
        setting("FILE", "text file with a time and an elevation a line", names=Names.FILE, holds=DataFile.ELEVATIONS),
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


class WaveSpectrum(Block):
    """Kind of spectrum."""

    rule = "wave_spectrum"
    sections = ("SUMMARY WAVE SCATTER",)
    subject = "post-processing"
    page = "kwd_summarywavescatter_wavespectrum"
    summary = "Spectrum and period of the seastates of a wave scatter diagram."
    example = "*WAVE SPECTRUM\n TYPE=JONSWAP, OPTION=TP\n"

    keyword: Literal["WAVE SPECTRUM"] = "WAVE SPECTRUM"
    type_: Annotated[Literal["PIERSON-MOSKOWITZ", "JONSWAP"], setting("TYPE", "kind of spectrum")] = Field(alias="type")
    option: Annotated[
        Literal["TZ", "TP", "TE"] | None,
        setting("OPTION", "period: mean zero up-crossing, peak, or of energy", default="TZ", inline=True),
    ] = None


class Seastate(Row):
    """Seastate."""

    height: Annotated[Real, about("significant wave height", unit="L", above=0, usual=SEA_HEIGHT)]
    period: Annotated[Real, about("period: Tz, Tp or Te, as *WAVE SPECTRUM says", unit="T", above=0, usual=SEA_PERIOD)]
    occurrences: Annotated[Real, about("number of occurrences", at_least=0, usual=COUNT)]


class OtherSeastate(Record):
    """Seastate whose results are estimated from those of the reference."""

    rule = "other_seastate"
    seastate: Annotated[Seastate, about("seastate")]


class SeastateBlock(Record):
    """Block of seastates."""

    rule = "seastate_block"
    reference: Annotated[Seastate, setting("REFERENCE", "seastate that was simulated")]
    file: Annotated[Name, setting("FILE", "run with its simulation", inline=True)]
    others: Records[OtherSeastate] = Records()


class ScatterDiagram(Block):
    """Seastates."""

    rule = "scatter_diagram"
    sections = ("SUMMARY WAVE SCATTER",)
    subject = "post-processing"
    page = "kwd_summarywavescatter_scatterdiagram"
    summary = "Wave scatter diagram in blocks, each with the seastate that was simulated for it."
    example = "*SCATTER DIAGRAM\n REFERENCE=2.5, 8.5, 410, FILE=Sea 3\n 2.0, 8.5, 620\n 2.5, 9.5, 300\n"

    keyword: Literal["SCATTER DIAGRAM"] = "SCATTER DIAGRAM"
    blocks: Records[SeastateBlock] = Records()


class ScatterOptions(Block):
    """Options of the scatter diagram."""

    rule = "scatter_options"
    sections = ("SUMMARY WAVE SCATTER",)
    subject = "post-processing"
    page = "kwd_summarywavescatter_options"
    summary = "Options of a wave scatter: overwriting of existing summaries, and the largest power."
    example = "*OPTIONS\n OVERWRITE DATA=YES\n POWER RATING=250.0\n"

    keyword: Literal["OPTIONS"] = "OPTIONS"
    overwrite: Annotated[
        Literal["YES", "NO"] | None, setting("OVERWRITE DATA", "overwrite existing summaries", default="NO")
    ] = None
    rating: Annotated[
        Real | None, setting("POWER RATING", "upper limit of average powers", default="no limit", at_least=0, usual=ANY)
    ] = None
