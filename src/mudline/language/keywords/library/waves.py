"""Regular, irregular and tabulated waves of a load case, and the spectra of a wave scatter."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from mudline.language.keywords.assigning import Records
from mudline.language.keywords.common import Direction, require_one
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.keeping import OpenBlock, OpenRecord
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import (
    AMPLITUDE,
    ANY,
    COUNT,
    CUTOFF,
    DIRECTION,
    DIRECTIONS,
    EXPONENT,
    HARMONICS,
    HEIGHT,
    INCREMENT,
    OF_THE_RUN,
    PEAKEDNESS,
    PHILLIPS,
    POSITION,
    PROGRESSION,
    SEA_FREQUENCY,
    SEA_HEIGHT,
    SEA_PERIOD,
    WAVE_PERIOD,
)
from mudline.language.keywords.values import Contents, Name, Names, Other, Real, Whole

_MORE = "more forms follow on the page, which were not seen: their lines are passed through unchanged"
_CUT = about("largest frequency", unit="Hz", above=0, usual=CUTOFF)
_COUNT = about("number of directions", at_least=1, usual=DIRECTIONS)


class _Shape(Row):
    peak: Annotated[Real, about("peak frequency", unit="Hz", above=0, usual=SEA_FREQUENCY)]
    phillips: Annotated[Real, about("Phillips constant", unit="-", above=0, usual=PHILLIPS)]
    peakedness: Annotated[Real, about("peakedness", unit="-", above=0, usual=PEAKEDNESS)]


class _Height(Row):
    height: Annotated[Real, about("significant wave height", unit="L", at_least=0, usual=SEA_HEIGHT)]
    period: Annotated[
        Real, about("mean zero up-crossing period (HSTZ) or peak period (HSTP)", unit="T", above=0, usual=SEA_PERIOD)
    ]


class _Area(Row):
    increment: Annotated[Real, about("largest frequency increment", unit="Hz", above=0, usual=INCREMENT)]
    cutoff: Annotated[Real, _CUT]
    harmonics: Annotated[Whole, about("number of harmonics", at_least=1, usual=HARMONICS)]


class _Progression(Row):
    cutoff: Annotated[Real, _CUT]
    factor: Annotated[Real, about("progression factor of the frequencies", unit="-", above=0, usual=PROGRESSION)]


class _Directions(Row):
    directions: Annotated[Whole, _COUNT]
    direction: Direction = None
    exponent: Annotated[Real | None, about("spreading exponent", unit="-", at_least=0, usual=EXPONENT)] = None


class AreaShape(_Directions, _Area, _Shape):  # the last base's fields first
    """A line of FREQUENCY=AREA, SPEC=NORMAL."""


class ProgressionShape(_Directions, _Progression, _Shape):
    """A line of FREQUENCY=GP, SPEC=NORMAL."""


class AreaHeight(_Directions, _Area, _Height):
    """A line of FREQUENCY=AREA, SPEC=HSTZ or HSTP."""


class ProgressionHeight(_Directions, _Progression, _Height):
    """A line of FREQUENCY=GP, SPEC=HSTZ or HSTP."""


class JonswapSea(OpenRecord):
    """A sea; `frequency` and `spec` are given where they change."""

    rule = "jonswap_sea"
    sticky = "frequency"
    frequency: Annotated[
        Literal["AREA", "GP"] | None, setting("FREQUENCY", "frequencies by equal areas, or a geometric progression")
    ] = None
    spec: Annotated[
        Literal["NORMAL", "HSTZ", "HSTP"] | Other | None,
        setting("SPEC", "what the line gives", default="NORMAL", inline=True, inferred=_MORE, opaque=()),
    ] = None
    area_shape: Annotated[AreaShape | None, about("of AREA and NORMAL")] = None
    progression_shape: Annotated[ProgressionShape | None, about("of GP and NORMAL")] = None
    area_height: Annotated[AreaHeight | None, about("of AREA and HSTZ or HSTP")] = None
    progression_height: Annotated[ProgressionHeight | None, about("of GP and HSTZ or HSTP")] = None

    @classmethod
    def carries(cls, given: dict[str, object], last: object) -> object:
        """The field that later lines fill."""
        return cls.row_slot(0, 0, given, last)

    @classmethod
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """What FREQUENCY= and SPEC= chose, here or on an earlier line."""
        if not given.get("frequency"):
            return str(last or "area_shape")
        chosen = "area" if given["frequency"] == "AREA" else "progression"
        return f"{chosen}_shape" if given.get("spec") in (None, "NORMAL") else f"{chosen}_height"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """One line, where its form is known."""
        if self.spec in (None, "NORMAL", "HSTZ", "HSTP"):
            require_one(self, "area_shape", "progression_shape", "area_height", "progression_height")
        return self


class JonswapSeas(OpenBlock):
    """Seas."""

    rule = "wave_jonswap"
    sections = ("LOAD CASE",)
    subject = "waves"
    page = "kwd_loadcase_wavejonswap"
    known_forms = True
    summary = "Random seas with a Jonswap spectrum, by its parameters or by wave height and period."
    example = "*WAVE-JONSWAP\n FREQUENCY=AREA, SPEC=HSTP\n 4.5, 11.0, 0.01, 0.35, 80, 1, 180.0\n"

    keyword: Literal["WAVE-JONSWAP"] = "WAVE-JONSWAP"
    seas: Records[JonswapSea] = Records()


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
    def _fits(self) -> Self:
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
    waves: Records[RegularWave] = Records()


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


class WaveSpectrum(Block):
    """The kind of spectrum."""

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
    """A seastate."""

    height: Annotated[Real, about("significant wave height", unit="L", above=0, usual=SEA_HEIGHT)]
    period: Annotated[Real, about("period: Tz, Tp or Te, as *WAVE SPECTRUM says", unit="T", above=0, usual=SEA_PERIOD)]
    occurrences: Annotated[Real, about("number of occurrences", at_least=0, usual=COUNT)]


class OtherSeastate(Record):
    """A seastate whose results are estimated from those of the reference."""

    rule = "other_seastate"
    seastate: Annotated[Seastate, about("seastate")]


class SeastateBlock(Record):
    """A block of seastates."""

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
    """Options."""

    rule = "scatter_options"
    sections = ("SUMMARY WAVE SCATTER",)
    subject = "post-processing"
    page = "kwd_summarywavescatter_options"
    summary = "Whether summaries that are there are written again, and the largest power of a wave scatter."
    example = "*OPTIONS\n OVERWRITE DATA=YES\n POWER RATING=250.0\n"

    keyword: Literal["OPTIONS"] = "OPTIONS"
    overwrite: Annotated[
        Literal["YES", "NO"] | None, setting("OVERWRITE DATA", "write summaries that are there again", default="NO")
    ] = None
    rating: Annotated[
        Real | None, setting("POWER RATING", "average powers are cut off at", default="no limit", at_least=0, usual=ANY)
    ] = None
