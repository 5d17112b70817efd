"""`*SEABED TRENCH`: lateral resistance of the walls of a trench (extension)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, ValidationInfo, field_validator

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Block, Record, Row, rows
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import MODEL, POSITION
from mudline.language.keywords.values import Facts, Name, Names, Real


class TrenchGeometry(Row):
    """Values of GEOMETRY=."""

    depth: Annotated[Real, about("depth of the trench", unit="L", above=0, usual=MODEL)]
    bottom_width: Annotated[Real, about("width at the bottom", unit="L", above=0, usual=MODEL)]
    upper_width: Annotated[Real, about("width at the top", unit="L", above=0, usual=MODEL)]


class ResistancePoint(Row):
    """A row below PEAK=TABLE."""

    offset: Annotated[
        Real, about("distance from the centreline; not negative, larger in each row", unit="L", usual=MODEL)
    ]
    resistance: Annotated[Real, about("lateral resistance per unit length there", unit="F/L", at_least=0, usual=MODEL)]


class TrenchResidual(Row):
    """Values of RESIDUAL=."""

    resistance: Annotated[
        Real, about("lateral resistance per unit length beyond the peak", unit="F/L", at_least=0, usual=MODEL)
    ]
    displacement: Annotated[
        Real, about("distance from the centreline from which on it holds", unit="L", above=0, usual=MODEL)
    ]


class Centreline(Row):
    """Values of CENTRELINE=: two points of a straight line."""

    y0: Annotated[Real, about("Y of the first point", unit="L", usual=POSITION)]
    z0: Annotated[Real, about("Z of the first point", unit="L", usual=POSITION)]
    y1: Annotated[Real, about("Y of the second point", unit="L", usual=POSITION)]
    z1: Annotated[Real, about("Z of the second point", unit="L", usual=POSITION)]


class TrenchSet(Record):
    """What one SET= gets, taken whole."""

    rule = "trench_set"
    set_name: Annotated[Name, setting("SET", "element set", names=Names.SET)] = Field(alias="set")
    geometry: Annotated[TrenchGeometry, setting("GEOMETRY", "depth and widths of the trench")]
    model: Annotated[
        Literal["PEAK", "WALL"] | None,
        setting(
            "MODEL",
            "PEAK: the resistance that PEAK= gives, which is then mandatory; WALL: that of sloped walls, by GEOMETRY= "
            "and friction",
            default="PEAK",
        ),
    ] = None
    peak: Annotated[
        Real | Literal["TABLE"] | None,
        setting(
            "PEAK",
            "peak lateral resistance of the walls per unit length; TABLE: by the distance from the centreline, in the "
            "rows below",
            unit="F/L",
            at_least=0,
            usual=MODEL,
        ),
    ] = None
    table: Annotated[
        Table | None,
        rows(
            ResistancePoint, "rows of PEAK=TABLE, at least two; linear between them, the first holds inside, 0 outside"
        ),
    ] = None
    level: Annotated[
        Literal["UNCHANGED", "LOWERED"] | None,
        setting(
            "LEVEL", "LOWERED: the seabed lies lower by the depth of the trench between its walls", default="UNCHANGED"
        ),
    ] = None
    residual: Annotated[
        TrenchResidual | None,
        setting("RESIDUAL", "resistance to which that of PEAK= falls beyond its peak, instead of to 0", default="none"),
    ] = None
    smoothing: Annotated[
        Real | None,
        setting(
            "SMOOTHING",
            "half width of parabolas in the corners of the resistance",
            unit="L",
            at_least=0,
            default="0",
            usual=MODEL,
        ),
    ] = None
    centreline: Annotated[
        Literal["LAID"] | Centreline | None,
        setting(
            "CENTRELINE",
            "LAID: through the nodes where they lie first; or two points of a straight line",
            default="LAID",
        ),
    ] = None

    @field_validator("table")
    @classmethod
    def _of_table(cls, table: Table | None, info: ValidationInfo) -> Table | None:
        """Rows stand below PEAK=TABLE only."""
        if table is not None and "peak" in info.data and info.data["peak"] != "TABLE":
            raise ValueError("rows belong to PEAK=TABLE only: write that, or remove them")
        return table


class SeabedTrench(Block):
    """Trenches by set."""

    rule = "seabed_trench"
    subject = "seabed"
    facts = Facts(extension=True, later_wins=True, computed_in="trenches")
    tabular = True
    summary = "Lateral resistance of the walls of a trench, by element set (extension)."
    example = "*SEABED TRENCH\n SET=ALL\n GEOMETRY=0.5, 1.0, 3.0\n PEAK=2000.0\n CENTRELINE=LAID\n"

    keyword: Literal["SEABED TRENCH"] = "SEABED TRENCH"
    sets: list[TrenchSet] = []


BLOCK = SeabedTrench
