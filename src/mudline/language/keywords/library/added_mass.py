"""`*ADDED MASS`: added mass of floating bodies."""

from __future__ import annotations

from typing import Literal

from mudline.language.keywords.matrices import BodyMatrices
from mudline.language.keywords.model import Block


class AddedMass(Block):
    """Matrices of bodies."""

    rule = "added_mass"
    subject = "vessels"
    page = "kwd_model_addedmass"
    summary = "Added mass of floating bodies in a coupled analysis: a file, a constant matrix, or one a frequency."
    tabular = True
    example = (
        "*ADDED MASS\n FLOATING BODY=Buoy\n TYPE=CONSTANT\n"
        " 9.0E4, 0.0, 0.0, 0.0, 0.0, 0.0\n 0.0, 5.0E4, 0.0, 0.0, 0.0, 0.0\n 0.0, 0.0, 5.0E4, 0.0, 0.0, 0.0\n"
        " 0.0, 0.0, 0.0, 2.0E4, 0.0, 0.0\n 0.0, 0.0, 0.0, 0.0, 3.0E4, 0.0\n 0.0, 0.0, 0.0, 0.0, 0.0, 3.0E4\n"
    )

    keyword: Literal["ADDED MASS"] = "ADDED MASS"
    bodies: list[BodyMatrices] = []


BLOCK = AddedMass
