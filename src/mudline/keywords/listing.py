"""Lists and tables of documents: tables as rows or text and back, and long lists checked a few entries at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from typing import Any, cast

from pydantic import ValidationError
from pydantic_core import CoreSchema, ErrorDetails, InitErrorDetails, PydanticCustomError, core_schema, to_json

from mudline.keywords.table import Cell, CellError, Column, Table, from_cells, from_text

_PART = 32
"""Entries checked at once; lists are nested three deep at most."""

_UNCHECKED = PydanticCustomError("unchecked", "not looked at, nor what follows: mend the entries before first")


def checked_by_parts(schema: CoreSchema) -> CoreSchema:
    """The schema of a model with a limit on each of its own lists; those of the models in it have theirs."""
    found = cast("dict[str, Any]", schema)
    if found["type"] == "list":
        return core_schema.no_info_wrap_validator_function(_by_parts, schema)
    if "schema" in found:
        found["schema"] = checked_by_parts(found["schema"])
    if found["type"] == "model-fields":
        for field in found["fields"].values():
            field["schema"] = checked_by_parts(field["schema"])
    return schema


def _by_parts(given: object, check: core_schema.ValidatorFunctionWrapHandler) -> list[object]:
    """All entries, or the faults of the first part that has any. Entries may be made as they are checked."""
    if not isinstance(given, list | Iterator) or (isinstance(given, list) and len(given) <= _PART):
        return cast("list[object]", check(given))
    made: list[object] = []
    entries = iter(given)
    while part := list(islice(entries, _PART)):
        try:
            made += check(part)
        except ValidationError as error:
            start = len(made)
            moved = [_moved(fault, start) for fault in error.errors(include_url=False)]
            if any(True for _ in entries):
                moved.append(InitErrorDetails(type=_UNCHECKED, loc=(start + _PART,), input=None))
            raise ValidationError.from_exception_data(error.title, moved) from error
    return made


def _moved(fault: ErrorDetails, start: int) -> InitErrorDetails:
    """A fault of a part as one of the whole list."""
    kind = PydanticCustomError(
        cast("Any", fault["type"]), "{message}", {**fault.get("ctx", {}), "message": fault["msg"]}
    )
    index, *rest = fault["loc"]
    return InitErrorDetails(type=kind, loc=(cast("int", index) + start, *rest), input=fault["input"])


AS_TABLES = "as tables"
"""The serialization context in which a table becomes a Listing, not lists."""


class Listing:
    """A table and its columns, to be written as text at once: lists of a million rows would take half a second more."""

    __slots__ = ("columns", "table")

    def __init__(self, table: Table, columns: Sequence[Column]) -> None:
        self.table = table
        self.columns = columns

    def __len__(self) -> int:
        return len(self.table)

    def rows(self) -> list[list[Cell]]:
        """The rows as lists."""
        return self.table.rows(self.columns)

    def lines(self, spelled: Callable[[list[Cell]], str]) -> Iterator[str]:
        """The rows as text, some thousand at a time, separated by line feeds.

        Cells are separated by a comma and a space; `spelled` writes a row that is not of numbers only.
        """
        for rows, plain in self.table.parts(self.columns):
            if plain:
                text = to_json(rows).decode("ascii")
                yield text[2:-2].replace("],[", "\n").replace(",", ", ")
            else:
                yield "\n".join(map(spelled, rows))


def read_table(given: object, columns: Sequence[Column]) -> Table:
    """The table of lists, or of a text of rows. Raises ValidationError with row and column, or ValueError."""
    if isinstance(given, Table):
        return given
    try:
        if isinstance(given, list):
            return from_cells(given, columns)
        if isinstance(given, str):
            return from_text(given, columns)
    except CellError as error:
        message = PydanticCustomError("table", "{fault}", {"fault": str(error)})
        place = InitErrorDetails(type=message, loc=error.place, input=None)
        raise ValidationError.from_exception_data("table", [place]) from error
    raise ValueError("expected rows: a list of lists, or a text with a row a line")
