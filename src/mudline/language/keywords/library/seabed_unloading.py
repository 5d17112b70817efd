"""`*SEABED UNLOADING`: the path of the reaction on reversal (extension)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.usual import LEAST_BED
from mudline.language.keywords.values import Facts, Name, Names, Real


class UnloadingSet(Record):
    """What one SET= gets."""

    rule = "unloading_set"
    set_name: Annotated[Name, setting("SET", "element set", names=Names.SET)] = Field(alias="set")
    stiffness: Annotated[
        Real,
        setting("STIFFNESS", "stiffness of unloading and reloading per unit length", unit="F/L2", usual=LEAST_BED),
    ]


class SeabedUnloading(Block):
    """Unloading stiffness by set."""

    rule = "seabed_unloading"
    subject = "seabed"
    facts = Facts(extension=True, later_wins=True, computed_in="unloading")
    summary = "The full cycle of penetration, unloading and re-penetration: stiffness on reversal (extension)."
    example = "*SEABED UNLOADING\n SET=ALL\n STIFFNESS=500000.0\n"

    keyword: Literal["SEABED UNLOADING"] = "SEABED UNLOADING"
    sets: list[UnloadingSet] = []


BLOCK = SeabedUnloading
