"""What several keywords of the seabed or of lines share."""

from __future__ import annotations

from typing import Annotated

from mudline.language.keywords.fields import about, setting
from mudline.language.keywords.model import Part, Record, Row, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.usual import MODEL, OF_ITS_CURVE
from mudline.language.keywords.values import Name, Real

CONSTANT_FRICTION = (
    "no meaning: the manual names the field and says neither what it does nor its unit, so the value is kept and no "
    "friction is computed from it"
)
SUCTION_STIFFNESS = (
    "the unit, which the manual does not give: that of the linear stiffness, a force per unit length for each length "
    "that the pipe rises"
)
_PER_LENGTH = "the force is per unit length, as is the linear stiffness that the curve replaces"
NO_SET = (
    "lines before any SET= are read as those of SET=ALL, since the manual's default set of a force-embedment curve is "
    "every element on the seabed"
)
POINTS = "points of the curve in any order; at least two"


class CurvePoint(Row):
    """A point of a force-embedment curve."""

    ratio: Annotated[
        Real,
        about(
            "embedment ratio: mean depth of the element's nodes over external diameter",
            unit="-",
            heading="Embedment Ratio",
            usual=MODEL,
        ),
    ]
    force: Annotated[
        Real,
        about(
            "seabed force at that ratio", unit="F/L", inferred=_PER_LENGTH, heading="Seabed Force", usual=OF_ITS_CURVE
        ),
    ]


class AdditionalSets(Record):
    """More sets that the elements of a section belong to."""

    rule = "additional_sets"
    sets: Annotated[
        list[Name],
        setting("ADDITIONAL", "more element sets that hold this section", inferred="the line may be repeated"),
    ]


def require_one(part: Part, *names: str) -> None:
    """Raise ValueError unless a part has a value in exactly one of some fields."""
    slots = [slot for slot in record_schema(type(part)).slots if slot.name in names]
    given = [slot.label for slot in slots if not _is_empty(getattr(part, slot.name))]
    if len(given) != 1:
        wanted = " or ".join(slot.label for slot in slots)
        raise ValueError(f"{' and '.join(given) or 'nothing'} is given: expected {wanted}")


def _is_empty(value: object) -> bool:
    return value is None or (isinstance(value, list | Table) and not len(value))
