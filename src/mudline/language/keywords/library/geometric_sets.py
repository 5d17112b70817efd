"""`*GEOMETRIC SETS`: stiffness, mass and diameters by element set."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *

_DO = "external diameter"
_CURVE = "curve of non-linear {}; the number on the property line is then left empty"
_AUXILIARY = "an auxiliary value whose meaning is not known"


class FlexibleSection(Row):
    """Property line under OPTION=FLEXIBLE."""

    eiyy: Annotated[Real | None, about("bending stiffness about local y", unit="FL2", at_least=0, usual=BENDING)] = (
        Field(None, alias="EIyy")
    )
    eizz: Annotated[
        Real | None, about("bending stiffness about local z", unit="FL2", at_least=0, usual=(*BENDING, ROUND))
    ] = Field(None, alias="EIzz")
    gj: Annotated[Real | None, about("torsional stiffness", unit="FL2", at_least=0, usual=MODEL)] = Field(
        None, alias="GJ"
    )
    ea: Annotated[Real | None, about("axial stiffness", unit="F", at_least=0, usual=STRETCH)] = Field(None, alias="EA")
    mass: Annotated[Real, about("mass per unit length", unit="M/L", at_least=0, usual=MODEL)]
    inertia: Annotated[
        Real,
        about(
            "polar inertia per unit length",
            unit="ML",
            at_least=0,
            usual=Usual(high=4.0, why="the mass lies within the radius", of="times the mass and the radius squared"),
        ),
    ]
    di: Annotated[Real, about("internal diameter", unit="L", at_least=0, usual=WIDTH)] = Field(alias="Di")
    dd: Annotated[Real, about("drag diameter", unit="L", at_least=0, usual=(WIDTH, OTHER_WIDTH, DRAG_WIDTH))] = Field(
        alias="Dd"
    )
    db: Annotated[
        Real, about("buoyancy diameter", unit="L", at_least=0, usual=(WIDTH, OTHER_WIDTH, MASS_WIDTH, DENSE))
    ] = Field(alias="Db")
    do: Annotated[Real | None, about(_DO, unit="L", default="Dd", above=0, usual=(WIDTH, OUTER_WIDTH))] = Field(
        None, alias="Do"
    )
    dc: Annotated[Real | None, about("contact diameter", unit="L", above=0, usual=WIDTH)] = Field(None, alias="Dc")
    aux_1: Annotated[RealOrName | None, about(_AUXILIARY, inferred=OLDER, older=True, usual=NOT_KNOWN)] = None
    aux_2: Annotated[RealOrName | None, about(_AUXILIARY, inferred=OLDER, older=True, usual=NOT_KNOWN)] = None
    aux_3: Annotated[RealOrName | None, about(_AUXILIARY, inferred=OLDER, older=True, usual=NOT_KNOWN)] = None
    aux_4: Annotated[RealOrName | None, about(_AUXILIARY, inferred=OLDER, older=True, usual=NOT_KNOWN)] = None


class RigidSection(Row):
    """Property line under OPTION=RIGID."""

    e: Annotated[Real | None, about("Young's modulus", unit="F/L2", at_least=0, usual=YOUNG)] = Field(None, alias="E")
    g: Annotated[Real, about("shear modulus", unit="F/L2", at_least=0, usual=SHEAR)] = Field(alias="G")
    do: Annotated[Real, about(_DO, unit="L", above=0, usual=(WIDTH, PIPE_WALL, OUTER_WIDTH))] = Field(alias="Do")
    di: Annotated[Real, about("internal diameter", unit="L", at_least=0, usual=STEEL_BORE)] = Field(alias="Di")
    density: Annotated[Real, about("density of the wall", unit="M/L3", at_least=0, usual=WALL)]
    area: Annotated[Real | None, about("area of the section", unit="L2", above=0, usual=MODEL)] = Field(None, alias="A")
    second_moment: Annotated[Real | None, about("second moment of area", unit="L4", above=0, usual=MODEL)] = Field(
        None, alias="I"
    )
    polar_moment: Annotated[Real | None, about("polar second moment of area", unit="L4", above=0, usual=MODEL)] = Field(
        None, alias="J"
    )
    dd: Annotated[
        Real | None,
        about(
            "drag diameter",
            unit="L",
            at_least=0,
            usual=Usual(high=11.5, why="coatings and strakes are no wider", of="/do", code="UNT006"),
        ),
    ] = Field(None, alias="Dd")
    db: Annotated[
        Real | None,
        about(
            "buoyancy diameter",
            unit="L",
            at_least=0,
            usual=Usual(high=11.5, why="coatings and strakes are no wider", of="/do", code="UNT006"),
        ),
    ] = Field(None, alias="Db")
    dc: Annotated[Real | None, about("contact diameter", unit="L", above=0, usual=WIDTH)] = Field(None, alias="Dc")


class MooringSection(Row):
    """Property line under OPTION=MOORING."""

    ea: Annotated[Real, about("axial stiffness", unit="F", at_least=0, usual=STRETCH)] = Field(alias="EA")
    mass: Annotated[Real, about("mass per unit length", unit="M/L", at_least=0, usual=MODEL)]
    do: Annotated[Real, about(_DO, unit="L", above=0, usual=(WIDTH, OUTER_WIDTH, MASS_WIDTH))] = Field(alias="Do")
    dd: Annotated[Real | None, about("drag diameter", unit="L", at_least=0, usual=(WIDTH, OTHER_WIDTH))] = Field(
        None, alias="Dd"
    )
    db: Annotated[Real | None, about("buoyancy diameter", unit="L", at_least=0, usual=(WIDTH, OTHER_WIDTH))] = Field(
        None, alias="Db"
    )


class TrussSection(Row):
    """Property line under OPTION=TRUSS."""

    ea: Annotated[Real | None, about("axial stiffness", unit="F", at_least=0, usual=STRETCH)] = Field(None, alias="EA")
    mass: Annotated[Real, about("mass per unit length", unit="M/L", at_least=0, usual=MODEL)]
    do: Annotated[Real, about(_DO, unit="L", above=0, usual=(WIDTH, OUTER_WIDTH, MASS_WIDTH))] = Field(alias="Do")
    di: Annotated[Real | None, about("internal diameter", unit="L", at_least=0, usual=WIDTH)] = Field(None, alias="Di")
    dd: Annotated[Real | None, about("drag diameter", unit="L", at_least=0, usual=(WIDTH, OTHER_WIDTH))] = Field(
        None, alias="Dd"
    )
    db: Annotated[Real | None, about("buoyancy diameter", unit="L", at_least=0, usual=(WIDTH, OTHER_WIDTH))] = Field(
        None, alias="Db"
    )
    dc: Annotated[Real | None, about("contact diameter", unit="L", above=0, usual=WIDTH)] = Field(None, alias="Dc")


class GeometricSet(Record):
    """Properties of a set; `option` is given where it changes."""

    rule = "geometric_set"
    sticky = "option"
    option: Annotated[
        Literal["FLEXIBLE", "RIGID", "MOORING", "TRUSS"] | None,
        setting("OPTION", "format of the property line; holds until it is changed", default="FLEXIBLE"),
    ] = None
    set_name: Annotated[Name, setting("SET", "element set", names=Names.SET, unique=True)] = Field(alias="set")
    buoyancy: Annotated[Literal["DISTRIBUTED"] | None, setting("BUOYANCY", "distributed buoyancy", inline=True)] = None
    eiyy_curve: Annotated[
        Name | None, setting("EIYY", _CURVE.format("EIyy"), inline=True, names=Names.MOMENT_CURVATURE)
    ] = None
    eizz_curve: Annotated[
        Name | None, setting("EIZZ", _CURVE.format("EIzz"), inline=True, names=Names.MOMENT_CURVATURE)
    ] = None
    gj_curve: Annotated[Name | None, setting("GJ", _CURVE.format("GJ"), inline=True, names=Names.TORQUE_TWIST)] = None
    ea_curve: Annotated[Name | None, setting("EA", _CURVE.format("EA"), inline=True, names=Names.FORCE_STRAIN)] = None
    ei_curve: Annotated[Name | None, setting("EI", _CURVE.format("EI"), inline=True, names=Names.MOMENT_CURVATURE)] = (
        None
    )
    hysteresis_curve: Annotated[Name | None, setting("EI_HYSTERESIS", _CURVE.format("EI"), inline=True)] = None
    e_curve: Annotated[Name | None, setting("E", _CURVE.format("E"), inline=True, names=Names.STRESS_STRAIN)] = None
    plastic_hardening: Annotated[
        Name | None, setting("PLASTIC HARDENING", "plastic hardening model", inline=True, names=Names.HARDENING)
    ] = None
    flexible: Annotated[FlexibleSection | None, about("section under OPTION=FLEXIBLE")] = None
    rigid: Annotated[RigidSection | None, about("section under OPTION=RIGID")] = None
    mooring: Annotated[MooringSection | None, about("section under OPTION=MOORING")] = None
    truss: Annotated[TrussSection | None, about("section under OPTION=TRUSS")] = None
    compression_check: Annotated[Name | None, setting("COMPRESSION CHECK", "check for compression")] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the format in OPTION=, here or at an earlier set."""
        return str(values.get("option") or last or "FLEXIBLE").lower()

    @property
    def section(self) -> FlexibleSection | RigidSection | MooringSection | TrussSection | None:
        """Property line of any format."""
        return self.flexible or self.rigid or self.mooring or self.truss

    @property
    def diameter(self) -> tuple[str, object]:
        """Name and value of the external diameter: Do, else (FLEXIBLE) Dd; ("", None) without one."""
        section = self.section
        if section is None:
            return "", None
        if isinstance(section, FlexibleSection) and section.do is None:
            return "Dd", section.dd
        return "Do", section.do


FORMATS_OF = {
    **dict.fromkeys(("EIYY", "EIZZ", "GJ", "EI", "EI_HYSTERESIS"), ("FLEXIBLE",)),
    "EA": ("FLEXIBLE", "TRUSS"),
    **dict.fromkeys(("E", "PLASTIC HARDENING"), ("RIGID",)),
}
"""Formats in which a curve may replace a number, by field."""


class GeometricSets(Block):
    """Section properties by set."""

    rule = "geometric_sets"
    facts = Facts(gives=("sections",), later_wins=True)
    page = "kwd_model_geometricsets"
    summary = "Stiffness, mass and diameters of element sets, in one of four formats."
    example = "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.9E9, 0.3239, 0.2731, 7850.0\n"

    keyword: Literal["GEOMETRIC SETS"] = "GEOMETRIC SETS"
    sets: Records[GeometricSet] = Records()

    @model_validator(mode="after")
    def _formats(self) -> Self:
        """Raise ValueError unless every set has one property line, in the format of its OPTION=."""
        option = "FLEXIBLE"
        for index, entry in enumerate(self.sets):
            option = entry.option or option
            names = [name for name in ("flexible", "rigid", "mooring", "truss") if getattr(entry, name) is not None]
            if names != [option.lower()]:
                listed = " and ".join(names) or "none"
                message = f"OPTION={option} needs the section {option.lower()!r}, found {listed}"
                raise misfit(message, "sets", index)
            for slot in record_schema(GeometricSet).slots:
                if slot.key in FORMATS_OF and option not in FORMATS_OF[slot.key] and getattr(entry, slot.name):
                    formats = " or ".join(FORMATS_OF[slot.key])
                    message = f"OPTION={option} takes no {slot.key}=, which is of {formats}"
                    raise misfit(message, "sets", index, slot.json)
        return self
