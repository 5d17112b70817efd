"""`*MOMENTS`: yaw moments of a moored vessel."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about
from mudline.language.keywords.model import Block
from mudline.language.keywords.usual import ANY
from mudline.language.keywords.values import Real


class Moments(Block):
    """Factors of moments."""

    rule = "moments"
    sections = ("LOAD CASE",)
    subject = "loads"
    page = "kwd_loadcase_moments"
    summary = "Factors of the yaw moments of a moored vessel; in mooring analyses."
    example = "*MOMENTS\n 0.5, 1.0, 0.0\n"

    keyword: Literal["MOMENTS"] = "MOMENTS"
    molin: Annotated[Real | None, about("coefficient of Molin", default="0", usual=ANY)] = None
    yaw: Annotated[Real | None, about("yaw factor of Molin", default="0", at_least=0, at_most=1, usual=ANY)] = None
    munk: Annotated[Real | None, about("factor of Munk", default="0", at_least=0, at_most=1, usual=ANY)] = None


BLOCK = Moments
