"""`*WAVE SPECTRUM`: the spectra of a summary of a wave scatter diagram."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block


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


BLOCK = WaveSpectrum
