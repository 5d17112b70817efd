"""`*WAVE-JONSWAP`: random seas with a Jonswap spectrum."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import model_validator

from mudline.language.keywords.common import require_one
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.keeping import OpenBlock, OpenRecord
from mudline.language.keywords.loads import Direction
from mudline.language.keywords.model import Row
from mudline.language.keywords.usual import (
    CUTOFF,
    DIRECTIONS,
    EXPONENT,
    HARMONICS,
    INCREMENT,
    PEAKEDNESS,
    PHILLIPS,
    PROGRESSION,
    SEA_FREQUENCY,
    SEA_HEIGHT,
    SEA_PERIOD,
)
from mudline.language.keywords.values import Other, Real, Whole

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
    def _fits(self) -> JonswapSea:
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
    seas: list[JonswapSea] = []


BLOCK = JonswapSeas
