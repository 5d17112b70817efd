"""`*SEABED SOIL`: hysteretic penetration, uplift and re-penetration (extension)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import MODEL
from mudline.language.keywords.values import Facts, Name, Names, Real


class Strength(Row):
    """Values of STRENGTH=."""

    mudline: Annotated[Real, about("undrained shear strength at the mudline", unit="F/L2", usual=MODEL)]
    gradient: Annotated[Real | None, about("its increase per depth", unit="F/L3", default="0", usual=MODEL)] = None


class Bearing(Row):
    """Values of BEARING=: N_c = a (z/D)^b."""

    factor: Annotated[Real, about("a of the bearing factor", unit="-", default="6", usual=MODEL)]
    exponent: Annotated[Real, about("b of the bearing factor", unit="-", default="0.25", usual=MODEL)]


class Uplift(Row):
    """Values of SUCTION=."""

    ratio: Annotated[
        Real, about("resistance against uplift over that against penetration", unit="-", default="0.6", usual=MODEL)
    ]
    decay: Annotated[
        Real, about("length of its decay over the largest penetration", unit="-", default="1", usual=MODEL)
    ]


class Buoyancy(Row):
    """Values of BUOYANCY=."""

    factor: Annotated[Real, about("factor of the weight of displaced soil", unit="-", usual=MODEL)]
    weight: Annotated[Real, about("submerged weight of the soil per volume", unit="F/L3", usual=MODEL)]


class SoilSet(Record):
    """What one SET= gets, taken whole."""

    rule = "soil_set"
    set_name: Annotated[Name, setting("SET", "element set", names=Names.SET)] = Field(alias="set")
    strength: Annotated[Strength, setting("STRENGTH", "undrained shear strength")]
    bearing: Annotated[Bearing | None, setting("BEARING", "bearing factor", default="6, 0.25")] = None
    stiffness: Annotated[
        Real | None, setting("STIFFNESS", "normalised largest stiffness K_max", unit="-", default="200", usual=MODEL)
    ] = None
    suction: Annotated[Uplift | None, setting("SUCTION", "resistance against uplift", default="0.6, 1")] = None
    repenetration: Annotated[
        Real | None,
        setting(
            "REPENETRATION",
            "delay of re-penetration, over the largest penetration",
            unit="-",
            default="0.3",
            usual=MODEL,
        ),
    ] = None
    buoyancy: Annotated[Buoyancy | None, setting("BUOYANCY", "weight of displaced soil", default="none")] = None


class SeabedSoil(Block):
    """Soil by set."""

    rule = "seabed_soil"
    subject = "seabed"
    facts = Facts(extension=True, later_wins=True, gives_law=("soil", "strength"), computed_in="hysteretic-soil")
    summary = "Hysteretic penetration, uplift and re-penetration of a soil, by element set (extension)."
    example = "*SEABED SOIL\n SET=ALL\n STRENGTH=5000.0, 1500.0\n SUCTION=0.6, 1.0\n"

    keyword: Literal["SEABED SOIL"] = "SEABED SOIL"
    sets: list[SoilSet] = []


BLOCK = SeabedSoil
