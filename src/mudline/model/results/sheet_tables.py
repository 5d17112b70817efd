"""The sheet of a deck as tables for people, and as data for CSV, JSON and workbooks."""

from __future__ import annotations

from typing import Any

import numpy as np

from mudline.basics.display import Cell, DisplayColumn, DisplayTable, text
from mudline.model.contact.columns import ResultColumn
from mudline.model.results.forms import ResultTables
from mudline.model.results.summary_tables import weight_note
from mudline.model.scene.sheet import RUN, Sheet, SheetColumn

SHEET_FORMAT = "mudline-sheet/1"

_UNKNOWN = {"mass", "filled_mass", "empty_weight", "filled_weight"}
_GAPS = {**dict.fromkeys(("section", "drag", "added_mass", "law"), "none"), **dict.fromkeys(_UNKNOWN, "unknown")}
"""Texts for columns of the sheet in which a missing value is a gap of the deck."""
_WORDS = {"section", "law"}


def sheet_tables(sheet: Sheet, units: str) -> list[DisplayTable]:
    """Return the sheet for people: pipe, weights, surroundings, and other load cases if any."""
    elements = text("elements", _elements)
    return [
        DisplayTable(
            f"Sheet: {subject}",
            [elements, *(_sheet_column(column, units) for column in columns)],
            sheet.rows,
            weight_note(sheet.left_out) if columns[0].key == "mass" else "",
        )
        for subject, columns in sheet.subjects.items()
        if subject and columns and sheet.rows
    ]


def _elements(row: dict[str, Any]) -> str:
    first, last = row["first_element"], row["last_element"]
    return str(first) if first == last else f"{first} to {last}"


def _sheet_column(column: SheetColumn, units: str) -> DisplayColumn:
    def cell(row: dict[str, Any]) -> Cell:
        value: Cell = row[column.key]
        if column.key == "contents" and value is None and row["inner_diameter"]:
            return "not read", "bold yellow"
        return (_GAPS[column.key], "bold yellow") if value is None and column.key in _GAPS else value

    is_bare = column.key in {"drag_diameter", "buoyancy_diameter", "masses_at_nodes", "stiffness"}
    return DisplayColumn(column.heading, cell, column.unit(units), left=column.key in _WORDS, optional=is_bare)


def sheet_data(sheet: Sheet, units: str) -> ResultTables:
    """Return the sheet as a table for files, with the additional keys `left_out` and `unit_of` of JSON."""
    columns = [_data(column, [row[column.key] for row in sheet.rows], units) for column in sheet.columns]
    unit_of = {column.name: column.unit or None for column in columns}
    return ResultTables({"sheet": columns}, SHEET_FORMAT, units, {"left_out": list(sheet.left_out), "unit_of": unit_of})


def _data(column: SheetColumn, values: list[Any], units: str) -> ResultColumn:
    if column.key in _WORDS:
        names = tuple(dict.fromkeys(value for value in values if value is not None))
        codes = [-1 if value is None else names.index(value) for value in values]
        return ResultColumn(column.key, np.array(codes, np.int32), (*names, None))
    dtype = np.int64 if column in RUN else np.float64  # None becomes NaN, a missing value
    return ResultColumn(column.key, np.array(values, dtype), unit=column.unit(units))
