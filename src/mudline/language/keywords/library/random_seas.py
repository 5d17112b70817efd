"""Random seas of a load case, by their spectra."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *

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
    """Line of FREQUENCY=AREA, SPEC=NORMAL."""


class ProgressionShape(_Directions, _Progression, _Shape):
    """Line of FREQUENCY=GP, SPEC=NORMAL."""


class AreaHeight(_Directions, _Area, _Height):
    """Line of FREQUENCY=AREA, SPEC=HSTZ or HSTP."""


class ProgressionHeight(_Directions, _Progression, _Height):
    """Line of FREQUENCY=GP, SPEC=HSTZ or HSTP."""


class JonswapSea(OpenRecord):
    """Sea; `frequency` and `spec` are given where they change."""

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
    def carries(cls, values: dict[str, object], last: object) -> object:
        """Return the name of the field that the next lines fill."""
        return cls.row_slot(0, 0, values, last)

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the form in FREQUENCY= and SPEC=, here or on an earlier line."""
        if not values.get("frequency"):
            return str(last or "area_shape")
        chosen = "area" if values["frequency"] == "AREA" else "progression"
        return f"{chosen}_shape" if values.get("spec") in (None, "NORMAL") else f"{chosen}_height"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the sea has one line, if its form is known."""
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


class _Sea(Record):
    """Sea with a form for each FREQUENCY=, which is given where it changes."""

    sticky = "frequency"
    frequency: Annotated[
        Literal["AREA", "GP"] | None, setting("FREQUENCY", "frequencies by equal areas, or a geometric progression")
    ] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the form in FREQUENCY=, here or on an earlier line."""
        return "progression" if (values.get("frequency") or last) == "GP" else "area"

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Raise ValueError unless the sea has one line."""
        require_one(self, "area", "progression")
        return self


_SHORTER = Usual(high=1.0, why="high frequencies have short periods", of="/low_period")


class _Peaks(Row):
    low_height: Annotated[
        Real, about("significant wave height of the low frequencies", unit="L", at_least=0, usual=SEA_HEIGHT[0])
    ]
    low_period: Annotated[Real, about("peak period of the low frequencies", unit="T", above=0, usual=SEA_PERIOD)]
    low_shape: Annotated[Real, about("their shape factor", unit="-", above=0, usual=ANY)]
    high_height: Annotated[
        Real, about("significant wave height of the high frequencies", unit="L", at_least=0, usual=SEA_HEIGHT[0])
    ]
    high_period: Annotated[
        Real, about("peak period of the high frequencies", unit="T", above=0, usual=(SEA_PERIOD, _SHORTER))
    ]
    high_shape: Annotated[Real, about("their shape factor", unit="-", above=0, usual=ANY)]


class AreaPeaks(_Directions, _Area, _Peaks):
    """Line of FREQUENCY=AREA."""


class ProgressionPeaks(_Directions, _Progression, _Peaks):
    """Line of FREQUENCY=GP."""


class OchiHubbleSea(_Sea):
    """Sea of two peaks."""

    rule = "ochi_hubble_sea"
    area: Annotated[AreaPeaks | None, about("of AREA")] = None
    progression: Annotated[ProgressionPeaks | None, about("of GP")] = None


class OchiHubbleSeas(Block):
    """Seas."""

    rule = "wave_ochi_hubble"
    sections = ("LOAD CASE",)
    subject = "waves"
    page = "kwd_loadcase_waveochihubble"
    summary = "Random seas with an Ochi-Hubble spectrum: swell and wind sea, each by height, period and shape."
    example = "*WAVE-OCHI-HUBBLE\n FREQUENCY=AREA\n 3.0, 14.0, 3.0, 2.0, 8.0, 1.5, 0.01, 0.35, 80, 1, 180.0\n"

    keyword: Literal["WAVE-OCHI-HUBBLE"] = "WAVE-OCHI-HUBBLE"
    seas: Records[OchiHubbleSea] = Records()


class _Peak(Row):
    height: Annotated[Real, about("significant wave height", unit="L", at_least=0, usual=SEA_HEIGHT)]
    period: Annotated[Real, about("peak period", unit="T", above=0, usual=SEA_PERIOD)]


class _Fetch(Row):
    fetch: Annotated[Real | None, about("fetch factor", usual=ANY)] = None


class AreaFetch(_Fetch, _Directions, _Area, _Peak):
    """Line of FREQUENCY=AREA."""


class ProgressionFetch(_Fetch, _Directions, _Progression, _Peak):
    """Line of FREQUENCY=GP."""


class TorsethaugenSea(_Sea):
    """Sea of wind and swell."""

    rule = "torsethaugen_sea"
    area: Annotated[AreaFetch | None, about("of AREA")] = None
    progression: Annotated[ProgressionFetch | None, about("of GP")] = None


class TorsethaugenSeas(Block):
    """Seas."""

    rule = "wave_torsethaugen"
    sections = ("LOAD CASE",)
    subject = "waves"
    page = "kwd_loadcase_wavetorsethaugen"
    summary = "Random seas with a Torsethaugen spectrum: wind sea and swell that follow from height and period."
    example = "*WAVE-TORSETHAUGEN\n FREQUENCY=AREA\n 4.5, 11.0, 0.01, 0.35, 80, 1, 180.0\n"

    keyword: Literal["WAVE-TORSETHAUGEN"] = "WAVE-TORSETHAUGEN"
    seas: Records[TorsethaugenSea] = Records()


class _Harmonics(Row):
    increment: Annotated[Real, about("largest frequency increment", unit="Hz", above=0, usual=INCREMENT)]
    harmonics: Annotated[Whole, about("number of harmonics", at_least=1, usual=HARMONICS)]


class _Factor(Row):
    factor: Annotated[Real, about("progression factor of the frequencies", unit="-", above=0, usual=PROGRESSION)]


class AreaOfPoints(_Directions, _Harmonics):
    """Line below FREQUENCY=AREA."""


class ProgressionOfPoints(_Directions, _Factor):
    """Line below FREQUENCY=GP."""


class SpectralPoint(Record):
    """Point of a spectrum."""

    rule = "spectral_point"
    frequency: Annotated[
        Real,
        about(
            "frequency", unit="Hz", at_least=0, usual=Usual(high=2.0, why="beyond it a sea has no energy", remark=True)
        ),
    ]
    value: Annotated[Real, about("value of the spectrum there", unit="L2T", at_least=0, usual=ANY)]


class SpectrumByPoints(_Sea):
    """Sea whose spectrum is given by points."""

    rule = "spectrum_by_points"
    area: Annotated[AreaOfPoints | None, about("of AREA")] = None
    progression: Annotated[ProgressionOfPoints | None, about("of GP")] = None
    points: Records[SpectralPoint] = Records()


class SpectraByPoints(Block):
    """Seas."""

    rule = "wave_user_defined"
    sections = ("LOAD CASE",)
    subject = "waves"
    page = "kwd_loadcase_waveuserdefined"
    summary = "Random seas whose spectra are given by points: frequency and value."
    example = "*WAVE-USER-DEFINED\n FREQUENCY=AREA\n 0.01, 80, 1, 180.0\n 0.05, 0.0\n 0.09, 12.0\n 0.3, 0.0\n"

    keyword: Literal["WAVE-USER-DEFINED"] = "WAVE-USER-DEFINED"
    seas: Records[SpectrumByPoints] = Records()
