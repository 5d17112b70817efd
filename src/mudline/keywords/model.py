"""What a keyword module declares: rows, records and blocks, whose fields carry their meaning, unit and range."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from typing import Annotated, ClassVar, NamedTuple, Self

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    ModelWrapValidatorHandler,
    ValidationError,
    ValidationInfo,
    model_serializer,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from mudline.keywords.about import About, Setting, about, setting
from mudline.keywords.faults import by_index, told
from mudline.keywords.layout import Layout, Slot, annotated, choices, classes, is_list
from mudline.keywords.table import Column
from mudline.keywords.table_field import Rows, row_schema, rows
from mudline.keywords.table_reading import count, fewest, row_format, wanted
from mudline.keywords.values import Expected, Integer, Kind, Text

__all__ = [
    "DOCUMENT",
    "About",
    "Block",
    "Comment",
    "Layout",
    "ListRow",
    "Part",
    "Record",
    "Row",
    "RowAt",
    "Rows",
    "Setting",
    "Slot",
    "about",
    "given_values",
    "layout",
    "row_format",
    "rows",
    "setting",
]

DOCUMENT = "document"
"""Context of a validation whose input comes from a document, which has exactly one form."""


class Comment(BaseModel):
    """A comment line; `before` is the index of the item that it precedes, `text` what follows the C."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    before: Annotated[Integer, Field(ge=0), Expected("a whole number from 0 on")]
    text: Text


class Part(BaseModel):
    """Anything with declared fields."""

    model_config = ConfigDict(extra="forbid", serialize_by_alias=True)


class Row(Part):
    """A line of positional fields, or the values behind a KEY=."""

    @classmethod
    def table_columns(cls) -> list[Column]:
        """What its fields hold."""
        return [slot.column for slot in layout(cls).columns]


class ListRow(Row):
    """A row that JSON holds as a list, trailing fields left out."""

    @model_validator(mode="wrap")
    @classmethod
    def _from_list(cls, given: object, handler: ModelWrapValidatorHandler[Self], info: ValidationInfo) -> Self:
        """A program may give the fields by name; a document has to give the list."""
        columns = cls.table_columns()
        if not isinstance(given, list):
            if info.context == DOCUMENT:
                raise told(f"expected a list: `{wanted(columns)}`")
            return handler(given)
        if not fewest(columns) <= len(given) <= len(columns):
            raise told(f"{len(given)} values, expected {count(columns)}: `{wanted(columns)}`")
        names = [slot.json for slot in layout(cls).columns]
        try:
            return handler(dict(zip(names, given, strict=False)))
        except ValidationError as error:
            raise by_index(error, names) from error

    @model_serializer
    def _to_list(self) -> list[object]:
        return given_values(self, layout(type(self)).columns)

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        return row_schema(cls.table_columns())


class RowAt(NamedTuple):
    """A row among the lines of a record.

    `number` counts the record's rows from 0; `fields` is how many values stand on it; `settings` are those read
    before it, with the sticky ones of earlier records.
    """

    number: int
    fields: int
    settings: Mapping[str, object]


class Record(Part):
    """Lines that belong together; `rule` is the grammar rule that says in what order they stand."""

    rule: ClassVar[str]
    comments: list[Comment] = Field(default_factory=list)

    @classmethod
    def row_slot(cls, row: RowAt) -> Slot:
        """Which field a row fills: those that rows can fill in their order, the last one all that follow."""
        slots = layout(cls).row_slots
        return slots[min(row.number, len(slots) - 1)]


class Block(Record):
    """A keyword with its data. The class variables are its declaration.

    `names` are its spellings, `sections` those where it belongs; `tabular` keeps runs of numeric lines whole, as
    arrays; `slashes` says that /.../ is one field; `example` is a block that reads without a finding.
    """

    names: ClassVar[tuple[str, ...]]
    sections: ClassVar[tuple[str, ...]] = ("MODEL",)
    summary: ClassVar[str]
    tabular: ClassVar[bool] = False
    slashes: ClassVar[bool] = False
    example: ClassVar[str]
    keyword: str


@cache
def layout(part: type[Part]) -> Layout:
    """The declared fields of a class, found once."""
    found = Layout()
    for order, (name, info) in enumerate(part.model_fields.items()):
        about = annotated(info, About)
        records = classes(info, Record)
        if about is None and not records:
            continue
        table = about.row if isinstance(about, Rows) else None
        slot = Slot(
            name=name,
            json=info.alias or name,
            about=about or About(""),
            kind=annotated(info, Kind),
            choices=choices(info),
            row=table or next(iter(classes(info, Row)), None),
            record={record.rule: record for record in records},
            table=table is not None,
            required=info.is_required(),
            many=is_list(info.annotation),
            order=order,
        )
        found.add(slot)
    return found


def given_values(part: Part, slots: Sequence[Slot]) -> list[object]:
    """The values of some fields up to the last one given."""
    length = max((index + 1 for index, slot in enumerate(slots) if slot.name in part.model_fields_set), default=0)
    return [getattr(part, slot.name) for slot in slots[:length]]
