"""`*NON LINEAR STATIC`: how the static solution before a run in the frequency domain is found."""

from __future__ import annotations

from typing import Annotated, Literal

from mudline.language.keywords.fields import about
from mudline.language.keywords.model import Block
from mudline.language.keywords.usual import COUNT, Usual
from mudline.language.keywords.values import Real, Whole


class NonLinearStatic(Block):
    """Steps and iterations."""

    rule = "non_linear_static"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_nonlinearstatic"
    summary = "Steps, tolerance and iterations of the static solution before dynamics in the frequency domain."
    example = "*NON LINEAR STATIC\n 5, 0.001, 40\n"

    keyword: Literal["NON LINEAR STATIC"] = "NON LINEAR STATIC"
    steps: Annotated[Whole | None, about("number of steps", default="1", at_least=1, usual=COUNT)] = None
    tolerance: Annotated[
        Real | None,
        about(
            "tolerance", unit="-", default="0.001", above=0, usual=Usual(high=0.1, why="0.001 by default", remark=True)
        ),
    ] = None
    iterations: Annotated[
        Whole | None, about("largest number of iterations", default="20", at_least=1, usual=COUNT)
    ] = None


BLOCK = NonLinearStatic
