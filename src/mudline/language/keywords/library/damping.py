"""`*DAMPING FORMULATION`: the matrices from which structural damping follows."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *


class DampingFormulation(Block):
    """Formulation."""

    rule = "damping_formulation"
    sections = ("LOAD CASE",)
    subject = "analysis"
    page = "kwd_loadcase_dampingformulation"
    summary = "Structural damping in the time domain: from the matrices of each step, or from those at its start."
    example = "*DAMPING FORMULATION\n OPTION=CONSTANT\n"

    keyword: Literal["DAMPING FORMULATION"] = "DAMPING FORMULATION"
    option: Annotated[
        Literal["UPDATED", "CONSTANT"] | None,
        setting("OPTION", "matrices of each step, or those of the static equilibrium", default="UPDATED"),
    ] = None
