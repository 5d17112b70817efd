"""The sheet of a deck as tables for people, and as data for CSV, JSON and workbooks."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mudline.basics.display import Cell, DisplayColumn, DisplayTable, text
from mudline.model.contact.columns import ResultColumn
from mudline.model.results.forms import ResultTables
from mudline.model.results.summary_tables import weight_note
from mudline.model.scene.sheet import Sheet

SHEET_FORMAT = "mudline-sheet/1"


def sheet_tables(sheet: Sheet) -> list[DisplayTable]:
    """Return the sheet for people: pipe, weights, surroundings, and other load cases if any."""
    tables = []
    for subject, columns in sheet.subjects.items() if sheet.rows else ():
        note = weight_note(sheet.left_out) if "weight" in subject else ""
        shown = [replace(each, value=_contents) if each.value == "contents" else each for each in columns]
        table = DisplayTable(f"Sheet: {subject}", [text("elements", _elements), *shown], sheet.rows, note)
        tables += [table] if subject and columns else []
    return tables


def _elements(row: dict[str, Any]) -> str:
    first, last = row["first_element"], row["last_element"]
    return str(first) if first == last else f"{first} to {last}"


def _contents(row: dict[str, Any]) -> Cell:
    value: Cell = row["contents"]
    return ("not read", "bold yellow") if value is None and row["inner_diameter"] else value


def sheet_data(sheet: Sheet, units: str) -> ResultTables:
    """Return the sheet as a table for files, with the additional keys `left_out` and `unit_of` of JSON."""
    columns = [_data(key, column, [row[key] for row in sheet.rows]) for key, column in sheet.columns.items()]
    unit_of = {column.name: column.unit or None for column in columns}
    return ResultTables({"sheet": columns}, SHEET_FORMAT, units, {"left_out": list(sheet.left_out), "unit_of": unit_of})


def _data(key: str, column: DisplayColumn, values: list[Any]) -> ResultColumn:
    if column.left:
        names = tuple(dict.fromkeys(value for value in values if value is not None))
        codes = [-1 if value is None else names.index(value) for value in values]
        return ResultColumn(key, np.array(codes, np.int32), (*names, None))
    dtype = np.int64 if key in {"first_element", "last_element", "elements"} else np.float64  # None becomes NaN
    return ResultColumn(key, np.array(values, dtype), unit=column.unit)
