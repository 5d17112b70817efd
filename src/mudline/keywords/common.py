"""Fields that several keywords share."""

from __future__ import annotations

from typing import Annotated

from mudline.keywords.about import about
from mudline.keywords.layout import Slot
from mudline.keywords.model import Block, Row, RowAt, layout
from mudline.keywords.table import Table
from mudline.keywords.table_field import rows
from mudline.keywords.values import Real

POINTS = "points of the curve in any order; at least two"

AXIAL_FRICTION = about("longitudinal friction coefficient", unit="-", default="0", at_least=0)
LATERAL_FRICTION = about("transverse friction coefficient", unit="-", default="0", at_least=0)
CONSTANT_FRICTION = about("constant friction force coefficient", inferred="kept, not used")
_RANGE = "the manual gives no range"
AXIAL_MOBILISATION = about("longitudinal mobilisation length", unit="L", above=0, inferred=_RANGE)
LATERAL_MOBILISATION = about("transverse mobilisation length", unit="L", above=0, inferred=_RANGE)

_LENGTH = "10 ft or 3.048 m"
AXIAL_LENGTH = about("largest longitudinal characteristic length", unit="L", default=_LENGTH, above=0)
LATERAL_LENGTH = about("largest transverse characteristic length", unit="L", default=_LENGTH, above=0)

_PER_LENGTH = "the force is per unit length, as the linear stiffness"
_PROFILE = "arbitrary profile: Y and elevation, a line of two values a point"


class CurvePoint(Row):
    """A point of a force-embedment curve."""

    ratio: Annotated[Real, about("embedment ratio: mean depth of the element's nodes over external diameter", unit="-")]
    force: Annotated[Real, about("seabed force at that ratio", unit="F/L", inferred=_PER_LENGTH)]


class ProfilePoint(Row):
    """A point of an inline profile."""

    y: Annotated[Real, about("horizontal coordinate Y", unit="L")]
    elevation: Annotated[Real, about("elevation of the bed there", unit="L")]


class Surface(Block):
    """A legacy surface: a line of properties, then a slope or a profile."""

    properties: Annotated[Row, about("properties of the surface")]
    slope: Annotated[
        Real | None,
        about("slope of the bed about the origin", unit="deg", default="flat", inferred="one value on its line"),
    ] = None
    profile: Annotated[Table, rows(ProfilePoint, _PROFILE)] | None = None

    @classmethod
    def row_slot(cls, row: RowAt) -> Slot:
        """The first line holds the properties; then one value is a slope, two are a point of the profile."""
        name = "properties" if row.number == 0 else "slope" if row.fields == 1 else "profile"
        return layout(cls).named(name)
