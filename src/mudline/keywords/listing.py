"""Tables in documents: rows as lists or as text to a table, and a table to the text of its rows."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from pydantic import ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError, to_json

from mudline.keywords.table import Cell, CellError, Column, Table, from_cells, from_text

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
