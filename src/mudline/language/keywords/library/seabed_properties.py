"""`*SEABED PROPERTIES`: contact type, stiffness, friction, lateral resistance and suction by element set."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.common import CONSTANT_FRICTION, NO_SET, SUCTION_STIFFNESS
from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row
from mudline.language.keywords.usual import ANY, BED, FRICTION, LEAST_SIDE, MOBILISATION, Usual
from mudline.language.keywords.values import Facts, Name, Names, Real, RealOrName

_RANGE = "it is above 0, as friction divides by it; the manual gives no range"
_MODAL = "the unit, which the manual does not give: that of the linear stiffness"


class SeabedFriction(Row):
    """Values of FRICTION=."""

    longitudinal: Annotated[
        Real | None, about("longitudinal friction coefficient", unit="-", default="0", at_least=0, usual=FRICTION)
    ] = None
    transverse: Annotated[
        Real | None, about("transverse friction coefficient", unit="-", default="0", at_least=0, usual=FRICTION)
    ] = None
    longitudinal_mobilisation: Annotated[
        Real | None, about("longitudinal mobilisation length", unit="L", above=0, inferred=_RANGE, usual=MOBILISATION)
    ] = None
    transverse_mobilisation: Annotated[
        Real | None, about("transverse mobilisation length", unit="L", above=0, inferred=_RANGE, usual=MOBILISATION)
    ] = None
    constant: Annotated[
        Real | None, about("constant friction force coefficient", inferred=CONSTANT_FRICTION, usual=ANY)
    ] = None
    longitudinal_stiffness: Annotated[
        Real | None,
        about(
            "longitudinal friction stiffness of modal and frequency runs",
            unit="F/L2",
            at_least=0,
            inferred=_MODAL,
            usual=Usual(95.0, 2.1e11, remark=True),
        ),
    ] = None
    transverse_stiffness: Annotated[
        Real | None,
        about(
            "transverse friction stiffness of modal and frequency runs",
            unit="F/L2",
            at_least=0,
            inferred=_MODAL,
            usual=Usual(95.0, 2.1e11, remark=True),
        ),
    ] = None


class SeabedSuction(Row):
    """Values of SUCTION=."""

    stiffness: Annotated[
        Real, about("suction stiffness", unit="F/L2", at_least=0, inferred=SUCTION_STIFFNESS, usual=LEAST_SIDE)
    ]
    extent: Annotated[
        Real | None,
        about(
            "height of the suction zone above the seabed",
            unit="L",
            above=0,
            inferred="it is above 0, as a zone without a height holds nothing; the manual gives no range",
            usual=Usual(high=10.0, why="a few diameters", remark=True),
        ),
    ] = None


class SeabedSet(Record):
    """What one SET= gets, taken whole."""

    rule = "seabed_set"
    set_name: Annotated[Name | None, setting("SET", "element set", default="ALL", inferred=NO_SET, names=Names.SET)] = (
        Field(default=None, alias="set")
    )
    stiffness: Annotated[
        RealOrName | None,
        setting(
            "STIFFNESS",
            "linear stiffness per unit length, or the name of a curve",
            unit="F/L2",
            at_least=0,
            names=Names.CURVE,
            usual=BED,
        ),
    ] = None
    friction: Annotated[SeabedFriction | None, setting("FRICTION", "friction coefficients and mobilisation")] = None
    lateral: Annotated[
        Real | None,
        setting(
            "LATERAL", "lateral resistance; replaces transverse friction", unit="F/L2", at_least=0, usual=LEAST_SIDE
        ),
    ] = None
    suction: Annotated[SeabedSuction | None, setting("SUCTION", "suction stiffness and zone")] = None


class SeabedProperties(Block):
    """Seabed contact by set."""

    rule = "seabed_properties"
    subject = "seabed"
    facts = Facts(
        supersedes=True,
        later_wins=True,
        carried=("type_",),
        computed_in="normal-laws",
        telling=("TYPE=ELASTIC", "TYPE=RIGID"),
    )
    page = "kwd_model_seabedproperties"
    summary = "Rigid or elastic seabed; stiffness, friction, lateral resistance and suction by element set."
    example = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=50000.0\n FRICTION=0.3, 0.5, 0.03, 0.05\n"

    keyword: Literal["SEABED PROPERTIES"] = "SEABED PROPERTIES"
    type_: Annotated[
        Literal["RIGID", "ELASTIC"] | None, setting("TYPE", "contact model; one type in a model; mandatory")
    ] = Field(default=None, alias="type")
    sets: list[SeabedSet] = []


BLOCK = SeabedProperties
