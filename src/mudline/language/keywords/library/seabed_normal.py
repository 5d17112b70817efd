"""Resistance of the seabed normal to its surface: contact, soil, unloading, suction (extensions)."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *


class ContactSet(Record):
    """Contact of one SET=, taken as a whole."""

    rule = "contact_set"
    set_name: SetName = Field(alias="set")
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
    sets: Records[ContactSet] = Records()


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
    """Soil of one SET=, taken as a whole."""

    rule = "soil_set"
    set_name: SetName = Field(alias="set")
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
    sets: Records[SoilSet] = Records()


class UnloadingSet(Record):
    """Unloading of one SET=."""

    rule = "unloading_set"
    set_name: SetName = Field(alias="set")
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
    sets: Records[UnloadingSet] = Records()


class MaximumForce(Row):
    """Values of FORCE=: maximum suction force per unit length, a factor times a power of velocity."""

    factor: Annotated[
        Real, about("factor of the largest suction force per unit length", unit="F/L", at_least=0, usual=ANY)
    ]
    exponent: Annotated[Real, about("power of the pull-out velocity", unit="-", at_least=0, usual=ANY)]


class SuctionDepth(Row):
    """Values of DEPTH=: uplift at breakout, a factor times a power of velocity."""

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
    """Suction of one SET=, taken as a whole."""

    rule = "suction_set"
    set_name: SetName = Field(alias="set")
    cohesion: Annotated[
        Real | None,
        setting(
            "COHESION",
            "undrained shear strength of the soil; gives force and depth after Bridge et al. (2004)",
            unit="F/L2",
            at_least=0,
            usual=Usual(95.0, 1e6, "less is a fluid, more is rock", code="UNT002", typical=3e3, within=30.0),
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
    sets: Records[SuctionSet] = Records()
