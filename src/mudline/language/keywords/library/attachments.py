"""Masses, buoys and drag chains at nodes."""

from typing import Annotated, Literal, Self

from mudline.language.keywords.common import *


class PointMass(Record):
    """Mass at a node."""

    rule = "point_mass"
    node: Node
    mass: Annotated[
        Real,
        about(
            "mass, or rotary inertia",
            unit="M",
            at_least=0,
            usual=Usual(1.0, 1e7, "1 kg is nothing, a hull more", remark=True),
            written_in=("M", "ML2"),
        ),
    ]
    type_: Annotated[
        Literal["MASS", "NO WEIGHT MASS", "ROTARY INERTIA"] | None,
        setting("TYPE", "mass, mass without weight, or rotary inertia (ML2)", default="MASS", inline=True),
    ] = Field(default=None, alias="type")


class Masses(Block):
    """Masses."""

    rule = "mass"
    page = "kwd_model_mass"
    summary = "Masses and rotary inertias at nodes."
    example = "*MASS\n 12, 2500.0\n {Hang-off}, 400.0, TYPE=NO WEIGHT MASS\n 12, 900.0, TYPE=ROTARY INERTIA\n"

    keyword: Literal["MASS"] = "MASS"
    masses: Records[PointMass] = Records()


_AXES = "the three lines are those of the local axes x, y and z, or of the global ones"
_HEAVY = Usual(100.0, 1e8, "10 litres of foam lift 100 N, the tank of a riser tower 5 MN", remark=True)


class BuoyLine(Row):
    """Products along an axis, or about it."""

    drag: Annotated[Real, about("drag coefficient times area, of rotations area moment", inferred=_AXES, usual=ANY)]
    inertia: Annotated[Real, about("inertia coefficient times volume, of rotations its moment", usual=ANY)]
    added_mass: Annotated[Real, about("added mass coefficient times volume, of rotations its moment", usual=ANY)]


class PointBuoy(Record):
    """Buoy at a node; `option` says that the lines about its rotations follow."""

    rule = "point_buoy_lines"
    option: Annotated[Literal["6D_BUOY"] | None, setting("OPTION", "buoy with lines about its rotations")] = None
    node: Node
    buoyancy: Annotated[Real, about("total buoyancy", unit="F", at_least=0, usual=_HEAVY)]
    weight: Annotated[
        Real,
        about(
            "total weight in air",
            unit="F",
            at_least=0,
            usual=(_HEAVY, Usual(high=1.0, why="a buoy floats", of="/buoyancy", remark=True)),
        ),
    ]
    inertia_x: Annotated[Real | None, about("rotary inertia about x", unit="ML2", at_least=0, usual=ANY)] = None
    inertia_y: Annotated[Real | None, about("rotary inertia about y", unit="ML2", at_least=0, usual=ANY)] = None
    inertia_z: Annotated[Real | None, about("rotary inertia about z", unit="ML2", at_least=0, usual=ANY)] = None
    axis: Annotated[Name | None, setting("AXIS", "axes of *LOCAL AXIS SYSTEM", default="global", inline=True)] = None
    lines: Annotated[Table, Rows("three lines; with OPTION= six, those of rotations last", row=BuoyLine)]

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the field of a row: the first one gives the buoy itself."""
        return "node" if number == 0 else "lines"

    @model_validator(mode="after")
    def _whole(self) -> Self:
        """Raise ValueError unless all lines are there."""
        expected = 6 if self.option else 3
        if len(self.lines) != expected:
            message = f"a buoy {'with' if self.option else 'without'} OPTION=6D_BUOY has {expected} lines below its own"
            raise misfit(f"{message}, found {len(self.lines)}", "lines")
        return self


class PointBuoys(Block):
    """Buoys."""

    rule = "point_buoy"
    page = "kwd_model_pointbuoy"
    summary = "Buoys at nodes: buoyancy, weight, and products of coefficients and sizes for the forces of the water."
    example = "*POINT BUOY\n 12, 25000.0, 9000.0\n 2.4, 3.8, 1.3\n 1.9, 3.8, 1.3\n 1.9, 3.8, 1.3\n"

    keyword: Literal["POINT BUOY"] = "POINT BUOY"
    buoys: Records[PointBuoy] = Records()


class Chain(Record):
    """Chain at a node."""

    rule = "chain"
    node: Node
    length: Annotated[Real, about("total length of the chain", unit="L", above=0, usual=ALONG)]
    mass: Annotated[
        Real,
        about(
            "mass per unit length",
            unit="M/L",
            at_least=0,
            usual=Usual(0.01, 2000.0, "the largest chains, of 0.22 m, have 960 kg/m", remark=True),
        ),
    ]
    lift: Annotated[Real | None, about("lift coefficient", unit="-", usual=LIFT)] = None


class ChainRange(ListRow):
    """Chains like that of a master node, which is defined above them."""

    master: Annotated[Ident, about("node with the chain that is repeated", names=Names.NODE)]
    number: Annotated[Whole, about("number of chains, including the master", at_least=1, usual=COUNT)]
    increment: Annotated[Whole | None, about("step between node numbers", default="1", usual=COUNT)] = None


class ChainGenerate(Record):
    """More chains."""

    rule = "chain_generate"
    generate: Annotated[ChainRange, setting("GEN", "chains at further nodes")]


class DragChains(Block):
    """Chains."""

    rule = "drag_chain"
    page = "kwd_model_dragchain"
    summary = "Chains that hang from nodes and drag on the seabed."
    example = "*DRAG CHAIN\n 12, 20.0, 140.0\n GEN=12, 5, 2\n"

    keyword: Literal["DRAG CHAIN"] = "DRAG CHAIN"
    chains: Records[Chain | ChainGenerate] = Records()
