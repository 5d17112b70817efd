"""`*CURRENT COEFF`: coefficients of the current on bodies."""

from __future__ import annotations

from typing import Literal

from mudline.language.keywords.coefficients import CoefficientBlock


class CurrentCoefficients(CoefficientBlock):
    """Coefficients of the current."""

    rule = "current_coeff"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "kwd_loadcase_currentcoeff"
    summary = "Coefficients of the current on floating bodies or a moored vessel, by heading, from rows or a file."
    example = "*CURRENT COEFF\n FLOATING BODY=Buoy\n 0.0, 1200.0, 0.0, 0.0\n 90.0, 0.0, 1500.0, 300.0\n"

    keyword: Literal["CURRENT COEFF"] = "CURRENT COEFF"


BLOCK = CurrentCoefficients
