"""`*SEABED SUCTION`: resistance of the seabed to uplift (extension)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import ANY, MODEL, Usual
from mudline.language.keywords.values import Facts, Name, Names, Real


class MaximumForce(Row):
    """Values of FORCE=: largest suction per unit length, factor times velocity to a power."""

    factor: Annotated[
        Real, about("factor of the largest suction force per unit length", unit="F/L", at_least=0, usual=ANY)
    ]
    exponent: Annotated[Real, about("power of the pull-out velocity", unit="-", at_least=0, usual=ANY)]


class SuctionDepth(Row):
    """Values of DEPTH=: uplift at breakout, factor times velocity to a power."""

    factor: Annotated[Real, about("factor of the uplift at breakout", unit="L", above=0, usual=ANY)]
    exponent: Annotated[Real, about("power of the pull-out velocity", unit="-", at_least=0, usual=ANY)]


class CutOff(Row):
    """Values of CUTOFF=: corners of the trapezoid as fractions of the uplift at breakout."""

    first: Annotated[Real, about("end of the rise", unit="-", default="0.2", usual=MODEL)]
    second: Annotated[Real, about("start of the fall", unit="-", default="0.8", usual=MODEL)]


class CyclicLoading(Row):
    """Values of CYCLIC= with a floor."""

    factor: Annotated[
        Real, about("factor on the largest force for each completed uplift cycle", unit="-", at_least=0, usual=ANY)
    ]
    floor: Annotated[
        Real,
        about(
            "share of the first largest force below which the cycles do not lower it",
            unit="-",
            at_least=0,
            at_most=1,
            usual=MODEL,
        ),
    ]


class SuctionSet(Record):
    """What one SET= gets, taken whole."""

    rule = "suction_set"
    set_name: Annotated[Name, setting("SET", "element set", names=Names.SET)] = Field(alias="set")
    cohesion: Annotated[
        Real | None,
        setting(
            "COHESION",
            "undrained shear strength of the soil; gives force and depth after Bridge et al. (2004)",
            unit="F/L2",
            at_least=0,
            usual=Usual(95.0, 1e6, "less is a fluid, more is rock", code="UNT002", meant=3e3, within=30.0),
        ),
    ] = None
    force: Annotated[MaximumForce | None, setting("FORCE", "law of the largest suction force")] = None
    depth: Annotated[SuctionDepth | None, setting("DEPTH", "law of the uplift at breakout")] = None
    cutoff: Annotated[CutOff | None, setting("CUTOFF", "corners of the trapezoid", default="0.2, 0.8")] = None
    cyclic: Annotated[
        CyclicLoading | Real | None,
        setting(
            "CYCLIC",
            "factor on the largest force for cyclic loading: alone it holds from the start, with a floor it is applied "
            "once for each completed uplift cycle",
            unit="-",
            default="1",
            at_least=0,
        ),
    ] = None
    regularisation: Annotated[
        Real | None,
        setting(
            "REGULARISATION",
            "velocity below which the law of the largest force is capped",
            unit="L/T",
            default="1e-3 m/s",
            above=0,
            usual=ANY,
        ),
    ] = None


class SeabedSuction(Block):
    """Suction by set."""

    rule = "seabed_suction"
    subject = "seabed"
    facts = Facts(extension=True, later_wins=True, computed_in="suction")
    summary = "Resistance of the seabed to uplift, with mobilisation, plateau and breakout (extension)."
    example = "*SEABED SUCTION\n SET=ALL\n COHESION=5000.0\n CUTOFF=0.2, 0.8\n"

    keyword: Literal["SEABED SUCTION"] = "SEABED SUCTION"
    sets: list[SuctionSet] = []


BLOCK = SeabedSuction
