"""What several keywords of the seabed, of its legacy surfaces, of soil springs or of lines share."""

from __future__ import annotations

from typing import Annotated

from mudline.codes.lines import SYN001, SYN004, SYN005
from mudline.diagnostics import Code
from mudline.keywords.model import Block, Record, Row, about, rows, setting
from mudline.keywords.table import Table
from mudline.keywords.values import Ident, Name, Names, Real, Successor

CONSTANT_FRICTION = (
    "no meaning: the manual names the field and says neither what it does nor its unit, so the value is kept and no "
    "friction is computed from it"
)
SUCTION_STIFFNESS = (
    "the unit, which the manual does not give: that of the linear stiffness, a force per unit length for each length "
    "that the pipe rises"
)
_PER_LENGTH = "the force is per unit length, as is the linear stiffness that the curve stands in for"
NO_SET = (
    "lines before any SET= are read as those of SET=ALL, since the manual's default set of a force-embedment curve is "
    "every element on the seabed"
)
POINTS = "points of the curve in any order; at least two"


class CurvePoint(Row):
    """A point of a force-embedment curve."""

    ratio: Annotated[Real, about("embedment ratio: mean depth of the element's nodes over external diameter", unit="-")]
    force: Annotated[
        Real,
        about("seabed force at that ratio", unit="F/L", inferred=_PER_LENGTH),
    ]


class AdditionalSets(Record):
    """More sets that the elements of a section belong to."""

    rule = "additional_sets"
    sets: Annotated[
        list[Name],
        setting("ADDITIONAL", "more element sets that hold this section", inferred="the line may be repeated"),
    ]


OTHER_SOIL_FORMS: tuple[Code, ...] = (SYN001, SYN004, SYN005)
"""Faults that may be one of the other forms of the keywords of soil springs, which are not public."""

_SOIL_POINTS = "points of the curve: resistance and displacement"


class SoilPoint(Row):
    """A point of a curve: resistance first."""

    resistance: Annotated[
        Real, about("soil resistance; it comes first", unit="F/L", inferred="P is per unit length, as T is")
    ]
    displacement: Annotated[Real, about("displacement of the pipe against the soil", unit="L")]


class DepthCurve(Record):
    """The curve of a depth."""

    rule = "depth_curve"
    depth: Annotated[Real, setting("DEPTH", "depth below the mudline, negative above it", unit="L")]
    points: Annotated[Table, rows(SoilPoint, _SOIL_POINTS, unordered=True)]


class NodeCurve(Record):
    """The curve of a node."""

    rule = "node_curve"
    node: Annotated[Ident, setting("NODE", "node that the curve belongs to", inferred="in place of DEPTH=")]
    points: Annotated[Table, rows(SoilPoint, _SOIL_POINTS, unordered=True)]


SoilCurves = list[DepthCurve | NodeCurve]
CurvesFile = Annotated[Name | None, setting("FILE", "file with the curves, instead of lines", names=Names.FILE)]


_CHARACTERISTIC_LENGTH = "10 ft or 3.048 m"
_SLOPE = "a line of one value is a slope, one of two a point of the profile: nothing else tells them apart"
SURFACE_SUCCESSORS = (Successor("SEABED PROPERTIES"), Successor("SEABED PROFILE"))


class ProfilePoint(Row):
    """A point of an inline profile."""

    y: Annotated[Real, about("horizontal coordinate Y", unit="L")]
    elevation: Annotated[Real, about("elevation of the bed there", unit="L")]


class FrictionCoefficients(Row):
    """Friction coefficients of a legacy surface."""

    longitudinal: Annotated[
        Real | None, about("longitudinal friction coefficient", unit="-", default="0", at_least=0)
    ] = None
    transverse: Annotated[Real | None, about("transverse friction coefficient", unit="-", default="0", at_least=0)] = (
        None
    )


class FrictionLengths(Row):
    """What else a legacy surface says of friction."""

    longitudinal_length: Annotated[
        Real | None,
        about("largest longitudinal characteristic length", unit="L", default=_CHARACTERISTIC_LENGTH, above=0),
    ] = None
    transverse_length: Annotated[
        Real | None,
        about("largest transverse characteristic length", unit="L", default=_CHARACTERISTIC_LENGTH, above=0),
    ] = None
    constant: Annotated[Real | None, about("constant friction force coefficient", inferred=CONSTANT_FRICTION)] = None
    longitudinal_mobilisation: Annotated[Real | None, about("longitudinal mobilisation length", unit="L", above=0)] = (
        None
    )
    transverse_mobilisation: Annotated[Real | None, about("transverse mobilisation length", unit="L", above=0)] = None


class Surface(Block):
    """A legacy surface: a line of properties, then a slope or a profile."""

    properties: Annotated[Row, about("properties of the surface")]
    slope: Annotated[
        Real | None,
        about("slope of the bed about the origin", unit="deg", default="flat", inferred=_SLOPE),
    ] = None
    profile: Annotated[
        Table | None,
        rows(ProfilePoint, "arbitrary profile: Y and elevation, a line of two values a point", unordered=True),
    ] = None

    @classmethod
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """The first line holds the properties; then one value is a slope, two are a point of the profile."""
        return "properties" if number == 0 else "slope" if fields == 1 else "profile"
