"""`*WIND COEFF`: coefficients of the wind on bodies."""

from __future__ import annotations

from typing import Literal

from mudline.language.keywords.coefficients import CoefficientBlock


class WindCoefficients(CoefficientBlock):
    """Coefficients of the wind."""

    rule = "wind_coeff"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "kwd_loadcase_windcoeff"
    summary = "Coefficients of the wind on floating bodies or a moored vessel, by heading, from rows or a file."
    example = "*WIND COEFF\n FLOATING BODY=Buoy\n 0.0, 1200.0, 0.0, 0.0\n 90.0, 0.0, 1500.0, 300.0\n"

    keyword: Literal["WIND COEFF"] = "WIND COEFF"


BLOCK = WindCoefficients
