"""`*SEABED TRENCH`: lateral resistance of the walls of a trench (extension)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from mudline.keywords.model import Block, Record, Row, about, setting
from mudline.keywords.values import Name, Real


class TrenchGeometry(Row):
    """Values of GEOMETRY=."""

    depth: Annotated[Real, about("depth of the trench", unit="L", above=0)]
    bottom_width: Annotated[Real, about("width at the bottom", unit="L", above=0)]
    upper_width: Annotated[Real, about("width at the top", unit="L", above=0)]


class Centreline(Row):
    """Values of CENTRELINE=: two points of a straight line."""

    y0: Annotated[Real, about("Y of the first point", unit="L")]
    z0: Annotated[Real, about("Z of the first point", unit="L")]
    y1: Annotated[Real, about("Y of the second point", unit="L")]
    z1: Annotated[Real, about("Z of the second point", unit="L")]


class TrenchSet(Record):
    """What one SET= gets, taken whole."""

    rule: ClassVar[str] = "trench_set"
    set_name: Annotated[Name, setting("SET", "element set")] = Field(alias="set")
    geometry: Annotated[TrenchGeometry, setting("GEOMETRY", "depth and widths of the trench")]
    peak: Annotated[
        Real, setting("PEAK", "peak lateral resistance of the walls per unit length", unit="F/L", at_least=0)
    ]
    centreline: Annotated[
        Literal["LAID"] | Centreline | None,
        setting(
            "CENTRELINE",
            "LAID: through the nodes where they lie first; or two points of a straight line",
            default="LAID",
        ),
    ] = None


class SeabedTrench(Block):
    """Trenches by set."""

    rule: ClassVar[str] = "seabed_trench"
    names: ClassVar[tuple[str, ...]] = ("SEABED TRENCH",)
    summary: ClassVar[str] = "Peak lateral resistance of the walls of a trench, by element set (extension)."
    example: ClassVar[str] = "*SEABED TRENCH\n SET=ALL\n GEOMETRY=0.5, 1.0, 3.0\n PEAK=2000.0\n CENTRELINE=LAID\n"

    keyword: Literal["SEABED TRENCH"] = "SEABED TRENCH"
    sets: list[TrenchSet] = []


BLOCK = SeabedTrench
