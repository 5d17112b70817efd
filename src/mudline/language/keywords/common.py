"""Names for keyword modules, which import all of them with a star; parts shared by keywords of several subjects."""

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, ValidationInfo, field_validator, model_validator

from mudline.language.keywords.assigning import Records
from mudline.language.keywords.contents import OpenBlock, OpenRecord
from mudline.language.keywords.fields import Expected, FieldInfo, about, setting
from mudline.language.keywords.model import Block, ListRow, Part, Record, Row, Rows, record_schema, rows
from mudline.language.keywords.table import LARGEST_WHOLE, Table, misfit
from mudline.language.keywords.usual import *
from mudline.language.keywords.values import *

NO_SET = (
    "lines before any SET= are read as those of SET=ALL, since the manual's default set of a force-embedment curve is "
    "every element on the seabed"
)

OLDER = "from the public reader of .das decks, in which alone it stands"

Node = Annotated[Ident, about("node number, or its label", names=Names.NODE)]
Element = Annotated[Ident, about("element number, or its label", names=Names.ELEMENT)]
SetName = Annotated[Name, setting("SET", "element set", names=Names.SET)]
Freedom = Annotated[
    Whole, about("degree of freedom; 1 vertical, 2 and 3 horizontal, 4 to 6 rotations", at_least=1, at_most=6)
]
Direction = Annotated[
    Real | None, about("direction, anticlockwise from the global Y axis", unit="deg", default="0", usual=DIRECTION)
]


def require_one(part: Part, *names: str) -> None:
    """Raise ValueError unless exactly one of the fields of a part has a value."""
    slots = [slot for slot in record_schema(type(part)).slots if slot.name in names]
    labels = [slot.label for slot in slots if not _is_empty(getattr(part, slot.name))]
    if len(labels) != 1:
        expected = " or ".join(slot.label for slot in slots)
        raise ValueError(f"{' and '.join(labels) or 'nothing'} {'are' if labels else 'is'} given: expected {expected}")


def _is_empty(value: object) -> bool:
    return value is None or (isinstance(value, list | Table) and not len(value))


def curve_points(
    row: type[Row],
    meaning: str,
    kind: str,
    *,
    abscissa: str,
    ends: Literal["slope", "value", "none"] = "none",
    usual: Expected = (),
) -> Rows:
    """Return a table field that is a curve of a kind over its column `abscissa`; its points may stand in any order.

    `ends` is "slope" only if the keyword's page says that the end sections go on.
    """
    inferred = "beyond its last point a curve keeps its value" if ends == "value" else ""
    return Rows(
        meaning, row=row, unordered=True, inferred=inferred, curve=kind, abscissa=abscissa, ends=ends, usual=usual
    )
