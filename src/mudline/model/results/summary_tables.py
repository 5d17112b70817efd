"""Tables of the summary of a deck, of its sheet and of its contact, for a terminal, a page and files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mudline.basics.display import Cell, DisplayColumn, DisplayTable, number, text
from mudline.basics.quantities import UnitNames
from mudline.model.contact.columns import ResultColumn
from mudline.model.results.forms import ResultTables
from mudline.model.scene.sheet import AROUND, PIPE, RUN, WEIGHTS, Sheet, SheetColumn

OPEN = "+ a block that is not read may add elements to this set"
"""Meaning of a plus after the number of elements of a set."""

Rows = Sequence[dict[str, Any]]
"""Rows as in JSON."""


def elements_of(row: dict[str, Any]) -> Cell:
    """Return the number of elements of a set, with a plus where it may have more."""
    return f"{row['elements']}+" if row["open"] else row["elements"]


def set_table(sets: Rows, names: UnitNames) -> DisplayTable:
    """Return the table of the element sets."""
    columns = (text("set", "name"), number("elements", elements_of), number("length", "length", names.length))
    return DisplayTable("Element sets", columns, sets, OPEN if any(row["open"] for row in sets) else "")


def diameter_table(diameters: Rows, names: UnitNames, none: Cell = None) -> DisplayTable:
    """Return the table of external diameters; `none` is the text for an unknown diameter."""

    def diameter(row: dict[str, Any]) -> Cell:
        return none if row["diameter"] is None else row["diameter"]

    columns = (number("diameter", diameter, names.length), number("elements", "elements"))
    return DisplayTable("External diameters", columns, diameters)


def static_table(rows: Rows, names: UnitNames, left_out: Sequence[str], *, first: bool) -> DisplayTable:
    """Return the table of static embedment; `first` adds the first element of a row.

    `left_out` are weights not included. The stiffness of springs of nodes is that of a node, and has no unit here.
    """
    several = any(row["filled"] for row in rows)
    unit = "" if any(row["law"] == "nodal" for row in rows) else names.stiffness
    columns = (
        text("set", "set"),
        *([number("first\nelement", "element")] if first else []),
        text("law", "law"),
        *([text("contents", lambda row: "with" if row["filled"] else "without")] if several else []),
        number("weight", "weight", names.line_force),
        number("ratio", "ratio"),
        number("penetration", "penetration", names.length),
        number("stiffness", "stiffness", unit),
    )
    return DisplayTable("Static embedment", columns, rows, weight_note(left_out))


def law_table(title: str, totals: Rows, names: UnitNames, reaction: str) -> DisplayTable:
    """Return the table of totals by law and set, with a heading for the reaction."""
    columns = (
        text("law", "law"),
        text("set", "set_name"),
        number("elements", "elements"),
        number("in\ncontact", "touching"),
        number("largest\ndepth", lambda row: row["deepest"] if row["touching"] else None, names.length),
        number(reaction, "reaction", names.force),
    )
    return DisplayTable(title, columns, totals)


def weight_note(left_out: Sequence[str]) -> str:
    """Return a note about the weights that a table leaves out, "" for none."""
    return f"weights without {', '.join(left_out)}" if left_out else ""


# ---------------------------------------------------------------------------------------------------------------- sheet

SHEET_FORMAT = "mudline-sheet/1"

_UNKNOWN = {"mass", "filled_mass", "empty_weight", "filled_weight"}
_GAPS = {**dict.fromkeys(("section", "drag", "added_mass", "law"), "none"), **dict.fromkeys(_UNKNOWN, "unknown")}
"""Texts for columns of the sheet in which a missing value is a gap of the deck."""
_WORDS = {"section", "law"}


def sheet_tables(sheet: Sheet, units: str) -> list[DisplayTable]:
    """Return the sheet for people: pipe, weights, surroundings, and other load cases if any."""
    spare = [column for column in sheet.columns if column not in (*RUN, *PIPE, *WEIGHTS, *AROUND)]
    parts = {
        "pipe": PIPE,
        "mass and submerged weight": WEIGHTS,
        "stiffness, water and seabed": AROUND,
        "other load cases": spare,
    }
    tables = []
    for title, part in parts.items():
        columns = [text("elements", _elements), *(_sheet_column(column, units) for column in part)]
        tables += [DisplayTable(f"Sheet: {title}", columns, sheet.rows)] if part and sheet.rows else []
    if tables:
        tables[1] = replace(tables[1], note=weight_note(sheet.left_out))
    return tables


def _elements(row: dict[str, Any]) -> str:
    first, last = row["first_element"], row["last_element"]
    return str(first) if first == last else f"{first} to {last}"


def _sheet_column(column: SheetColumn, units: str) -> DisplayColumn:
    def cell(row: dict[str, Any]) -> Cell:
        value: Cell = row[column.key]
        return (_GAPS[column.key], "bold yellow") if value is None and column.key in _GAPS else value

    is_bare = column.key in {"masses_at_nodes", "stiffness"}
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
