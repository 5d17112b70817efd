"""`*GEOMETRIC SETS`: stiffness, mass and diameters by element set."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator

from mudline.keywords.about import Setting, about, setting
from mudline.keywords.faults import at_places
from mudline.keywords.layout import Slot
from mudline.keywords.model import Block, Record, Row, RowAt, layout
from mudline.keywords.values import Name, Real

_EA = about("axial stiffness", unit="F", at_least=0)
_MASS = about("mass per unit length", unit="M/L", at_least=0)
_DO = about("external diameter", unit="L", above=0)
_DI = about("internal diameter", unit="L", at_least=0)
_DD = about("drag diameter", unit="L", at_least=0)
_DB = about("buoyancy diameter", unit="L", at_least=0)
_DC = about("contact diameter", unit="L", above=0)


class FlexibleSection(Row):
    """Property line under OPTION=FLEXIBLE."""

    eiyy: Annotated[Real | None, about("bending stiffness about local y", unit="FL2", at_least=0)] = Field(
        default=None, alias="EIyy"
    )
    eizz: Annotated[Real | None, about("bending stiffness about local z", unit="FL2", at_least=0)] = Field(
        default=None, alias="EIzz"
    )
    gj: Annotated[Real | None, about("torsional stiffness", unit="FL2", at_least=0)] = Field(default=None, alias="GJ")
    ea: Annotated[Real | None, _EA] = Field(default=None, alias="EA")
    mass: Annotated[Real, _MASS]
    inertia: Annotated[Real, about("polar inertia per unit length", unit="ML", at_least=0)]
    di: Annotated[Real, _DI] = Field(alias="Di")
    dd: Annotated[Real, _DD] = Field(alias="Dd")
    db: Annotated[Real, _DB] = Field(alias="Db")
    do: Annotated[Real | None, about("external diameter", unit="L", default="Dd", above=0)] = Field(
        default=None, alias="Do"
    )
    dc: Annotated[Real | None, _DC] = Field(default=None, alias="Dc")


class RigidSection(Row):
    """Property line under OPTION=RIGID."""

    e: Annotated[Real | None, about("Young's modulus", unit="F/L2", at_least=0)] = Field(default=None, alias="E")
    g: Annotated[Real, about("shear modulus", unit="F/L2", at_least=0)] = Field(alias="G")
    do: Annotated[Real, _DO] = Field(alias="Do")
    di: Annotated[Real, _DI] = Field(alias="Di")
    density: Annotated[Real, about("density of the wall", unit="M/L3", at_least=0)]
    area: Annotated[Real | None, about("area of the section", unit="L2", above=0)] = Field(default=None, alias="A")
    second_moment: Annotated[Real | None, about("second moment of area", unit="L4", above=0)] = Field(
        default=None, alias="I"
    )
    polar_moment: Annotated[Real | None, about("polar second moment of area", unit="L4", above=0)] = Field(
        default=None, alias="J"
    )
    dd: Annotated[Real | None, _DD] = Field(default=None, alias="Dd")
    db: Annotated[Real | None, _DB] = Field(default=None, alias="Db")
    dc: Annotated[Real | None, _DC] = Field(default=None, alias="Dc")


class MooringSection(Row):
    """Property line under OPTION=MOORING."""

    ea: Annotated[Real, _EA] = Field(alias="EA")
    mass: Annotated[Real, _MASS]
    do: Annotated[Real, _DO] = Field(alias="Do")
    dd: Annotated[Real | None, _DD] = Field(default=None, alias="Dd")
    db: Annotated[Real | None, _DB] = Field(default=None, alias="Db")


class TrussSection(Row):
    """Property line under OPTION=TRUSS."""

    ea: Annotated[Real | None, _EA] = Field(default=None, alias="EA")
    mass: Annotated[Real, _MASS]
    do: Annotated[Real, _DO] = Field(alias="Do")
    di: Annotated[Real | None, _DI] = Field(default=None, alias="Di")
    dd: Annotated[Real | None, _DD] = Field(default=None, alias="Dd")
    db: Annotated[Real | None, _DB] = Field(default=None, alias="Db")
    dc: Annotated[Real | None, _DC] = Field(default=None, alias="Dc")


Section = FlexibleSection | RigidSection | MooringSection | TrussSection


def _curve(key: str, stiffness: str) -> Setting:
    """The curve of a non-linear stiffness, named on the line of SET=."""
    return setting(
        key, f"curve of non-linear {stiffness}; the number on the property line is then left empty", inline=True
    )


class GeometricSet(Record):
    """The properties of a set; `option` is given where it changes."""

    rule: ClassVar[str] = "geometric_set"
    option: Annotated[
        Literal["FLEXIBLE", "RIGID", "MOORING", "TRUSS"] | None,
        setting("OPTION", "format of the property line; holds until it is changed", default="FLEXIBLE", sticky=True),
    ] = None
    set_name: Annotated[Name, setting("SET", "element set")] = Field(alias="set")
    buoyancy: Annotated[Literal["DISTRIBUTED"] | None, setting("BUOYANCY", "distributed buoyancy", inline=True)] = None
    eiyy_curve: Annotated[Name | None, _curve("EIYY", "EIyy")] = None
    eizz_curve: Annotated[Name | None, _curve("EIZZ", "EIzz")] = None
    gj_curve: Annotated[Name | None, _curve("GJ", "GJ")] = None
    ea_curve: Annotated[Name | None, _curve("EA", "EA")] = None
    ei_curve: Annotated[Name | None, _curve("EI", "EI")] = None
    hysteresis_curve: Annotated[Name | None, _curve("EI_HYSTERESIS", "EI")] = None
    e_curve: Annotated[Name | None, _curve("E", "E")] = None
    plastic_hardening: Annotated[
        Name | None, setting("PLASTIC HARDENING", "name of the plastic hardening model", inline=True)
    ] = None
    flexible: Annotated[FlexibleSection | None, about("section under OPTION=FLEXIBLE")] = None
    rigid: Annotated[RigidSection | None, about("section under OPTION=RIGID")] = None
    mooring: Annotated[MooringSection | None, about("section under OPTION=MOORING")] = None
    truss: Annotated[TrussSection | None, about("section under OPTION=TRUSS")] = None
    compression_check: Annotated[Name | None, setting("COMPRESSION CHECK", "check for compression")] = None

    @classmethod
    def row_slot(cls, row: RowAt) -> Slot:
        """The format that OPTION= chose, here or at an earlier set."""
        return layout(cls).named(str(row.settings.get("option", "FLEXIBLE")).lower())

    @property
    def section(self) -> Section | None:
        """The property line, whatever its format."""
        return self.flexible or self.rigid or self.mooring or self.truss

    @property
    def diameter(self) -> tuple[str, object]:
        """Name and value of the external diameter: Do, else (FLEXIBLE) Dd; ("", None) without one."""
        section = self.section
        if section is not None and section.do is not None:
            return "Do", section.do
        return ("Dd", section.dd) if isinstance(section, FlexibleSection) else ("", None)


class GeometricSets(Block):
    """Section properties by set."""

    rule: ClassVar[str] = "geometric_sets"
    names: ClassVar[tuple[str, ...]] = ("GEOMETRIC SETS",)
    summary: ClassVar[str] = "Stiffness, mass and diameters of element sets, in one of four formats."
    example: ClassVar[str] = "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.9E9, 0.3239, 0.2731, 7850.0\n"

    keyword: Literal["GEOMETRIC SETS"] = "GEOMETRIC SETS"
    sets: list[GeometricSet] = Field(default_factory=list)

    @model_validator(mode="after")
    def _formats(self) -> Self:
        """Every set has one property line, in the format that OPTION= says."""
        option = "FLEXIBLE"
        for index, entry in enumerate(self.sets):
            option = entry.option or option
            given = [name for name in ("flexible", "rigid", "mooring", "truss") if getattr(entry, name) is not None]
            if given != [option.lower()]:
                found = " and ".join(f"`{name}`" for name in given) or "no section"
                message = f"OPTION={option} needs the section `{option.lower()}` and no other, found {found}"
                raise at_places([(("sets", index), message)])
        return self


BLOCK = GeometricSets
