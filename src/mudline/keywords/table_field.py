"""A field that is a table: how it is checked, written out and described."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from mudline.keywords.about import About
from mudline.keywords.faults import at_places, told
from mudline.keywords.table import Column, Table
from mudline.keywords.table_reading import fewest, from_cells, from_text

if TYPE_CHECKING:
    from mudline.keywords.model import Row


@dataclass(frozen=True, slots=True, kw_only=True)
class Rows(About):
    """A field that is a table; `row` declares its columns."""

    row: type[Row]

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(
            self._table,
            serialization=core_schema.plain_serializer_function_ser_schema(
                lambda table: table.rows(self.row.table_columns())
            ),
        )

    def _table(self, given: object) -> Table:
        if isinstance(given, Table):
            return given
        columns = self.row.table_columns()
        if isinstance(given, str):
            table, faults = from_text(given, columns)
        elif isinstance(given, list):
            table, faults = from_cells(given, columns)
        else:
            raise told("expected a list of rows, or text with a row a line")
        if faults:
            raise at_places([(fault.place, fault.message) for fault in faults])
        return table

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        text = {"type": "string", "description": "the same rows as text, one a line, fields parted by commas"}
        listed = {"type": "array", "items": row_schema(self.row.table_columns())}
        return {"description": self.sentence, "anyOf": [listed, text]}


def rows(row: type[Row], meaning: str) -> Rows:
    """A table field."""
    return Rows(meaning, row=row)


def row_schema(columns: Sequence[Column]) -> JsonSchemaValue:
    """A row as a list whose trailing fields may be left out."""
    return {
        "type": "array",
        "prefixItems": [_cell_schema(column) for column in columns],
        "items": False,
        "minItems": fewest(columns),
    }


def _cell_schema(column: Column) -> JsonSchemaValue:
    number = {"type": "integer" if column.whole else "number"}
    word = {"type": "string", "pattern": column.word_type.form}
    empty = [] if column.required else [{"type": "null"}]
    return {"description": column.meaning, "anyOf": [number, word, *empty]}
