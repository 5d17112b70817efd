"""`*SEABED CONTACT`: nodal normal stiffness and smoothing of the contact law (extension)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mudline.language.keywords.fields import setting
from mudline.language.keywords.model import Block, Record
from mudline.language.keywords.usual import ANY
from mudline.language.keywords.values import Facts, Name, Names, Real


class ContactSet(Record):
    """What one SET= gets, taken whole."""

    rule = "contact_set"
    set_name: Annotated[Name, setting("SET", "element set", names=Names.SET)] = Field(alias="set")
    nodal_stiffness: Annotated[
        Real | None,
        setting(
            "NODAL STIFFNESS",
            "normal stiffness of a node; replaces the stiffness or curve per unit length of this set",
            unit="F/L",
            at_least=0,
            usual=ANY,
        ),
    ] = None
    smoothing: Annotated[
        Real | Literal["AUTO", "NONE"] | None,
        setting(
            "SMOOTHING",
            "half width of the quadratic zone; AUTO takes the smaller of a tenth of the static penetration and a "
            "hundredth of the diameter",
            unit="L",
            default="AUTO",
            above=0,
            usual=ANY,
        ),
    ] = None
    form: Annotated[
        Literal["CENTRED", "ONE-SIDED"] | None,
        setting("FORM", "place of the quadratic zone: about the seabed, or below it", default="CENTRED"),
    ] = None
    damping: Annotated[
        Real | None,
        setting(
            "DAMPING",
            "damping per unit length, of inward motion in contact only; alone in a block it is all that this gives",
            unit="FT/L2",
            at_least=0,
            default="0",
            usual=ANY,
        ),
    ] = None


class SeabedContact(Block):
    """Nodal stiffness and smoothing by set."""

    rule = "seabed_contact"
    subject = "seabed"
    facts = Facts(extension=True, later_wins=True, gives_law=("nodal", "nodal_stiffness"), computed_in="smoothing")
    summary = "Nodal normal stiffness, and smoothing of linear contact laws, by element set (extension)."
    example = "*SEABED CONTACT\n SET=ALL\n NODAL STIFFNESS=50000.0\n SMOOTHING=0.005\n FORM=CENTRED\n"

    keyword: Literal["SEABED CONTACT"] = "SEABED CONTACT"
    sets: list[ContactSet] = []


BLOCK = SeabedContact
