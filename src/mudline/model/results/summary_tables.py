"""Tables of a deck and of its contact for a terminal and a page; the sheet of a deck for files too."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mudline.basics.display import Cell, DisplayColumn, DisplayTable, number, text
from mudline.basics.quantities import LINES, STEPS, shown
from mudline.basics.units import UNITS
from mudline.model.contact.columns import ResultColumn, coded
from mudline.model.results.forms import ResultTables
from mudline.model.results.totals import NOT_KNOWN
from mudline.model.scene.sheet import Sheet

OPEN = "+ a block that is not read may add elements to this set"
"""Meaning of a plus after the number of elements of a set."""

Rows = Sequence[dict[str, Any]]
"""Rows as in JSON."""


def span(first: int, last: int) -> str:
    """Return the numbers of the first and the last element of a run; only one if they are the same."""
    return str(first) if first == last else f"{first} to {last}"


def elements_of(row: dict[str, Any]) -> Cell:
    """Return the number of elements of a set, with a plus where it may have more."""
    return f"{row['elements']}+" if row["open"] else row["elements"]


def set_table(sets: Rows, units: str) -> DisplayTable:
    """Return the table of the element sets."""
    columns = (
        text("set", "name"),
        number("elements", elements_of),
        number("length", "length", UNITS[units].unit("L")),
    )
    return DisplayTable("Element sets", columns, sets, OPEN if any(row["open"] for row in sets) else "")


def diameter_table(diameters: Rows, units: str, none: Cell = None) -> DisplayTable:
    """Return the table of external diameters; `none` is the text for an unknown diameter."""
    columns = (number("diameter", "diameter", UNITS[units].unit("L"), missing=none), number("elements", "elements"))
    return DisplayTable("External diameters", columns, diameters)


def static_table(rows: Rows, units: str, left_out: Sequence[str], case: int | None, *, first: bool) -> DisplayTable:
    """Return the table of static embedment; `first` adds the first element of a row.

    `left_out` are weights not included, `case` is the load case of the contents if they differ.
    The stiffness of springs of nodes is that of a node, and has no unit here.
    """
    system, several = UNITS[units], any(row["filled"] for row in rows)
    unit = "" if any(row["law"] == "nodal" for row in rows) else system.unit("F/L2")
    columns = (
        text("set", "set"),
        *([number("first\nelement", "element")] if first else []),
        text("law", "law"),
        *([text("contents", lambda row: "with" if row["filled"] else "without")] if several else []),
        number("weight", "weight", system.unit("F/L")),
        number("ratio", "ratio"),
        number("penetration", "penetration", system.unit("L")),
        number("stiffness", "stiffness", unit),
    )
    return DisplayTable("Static embedment", columns, rows, weight_note(left_out, case))


def law_table(title: str, totals: Rows, units: str) -> DisplayTable:
    """Return the table of totals by law and set."""
    columns = (
        text("law", "law"),
        text("set", "set_name"),
        number("elements", "elements"),
        STEPS["touching"].column(units),
        STEPS["deepest"].column(units, lambda row: row["deepest"] if row["touching"] else None),
        STEPS["reaction"].column(units),
    )
    return DisplayTable(title, columns, totals)


def touchdown_table(
    lines: Rows, units: str, touchdown: Callable[[dict[str, Any]], str], note: str, *, timed: bool = False
) -> DisplayTable:
    """Return the table of touchdown, largest forces, reaction and weight, a row for each line, and step if `timed`.

    `touchdown` returns the text about the touchdown points of a line. Weights without contents are shown if they
    differ.
    """
    filled = any(row["submerged_weight"] != row["empty_weight"] for row in lines)
    columns = [
        *([number("time", "time", UNITS[units].unit("T"))] if timed else []),
        LINES["line"].column(units),
        text("elements", lambda row: span(row["first_element"], row["last_element"])),
        LINES["first_touchdown"].column(units, touchdown),
        LINES["contact_length"].column(units),
        LINES["largest_force"].column(units, "largest_force.force"),
        LINES["largest_force_element"].column(units, "largest_force.element"),
        LINES["largest_uplift"].column(units, "largest_uplift.force", optional=True),
        LINES["largest_uplift_element"].column(units, "largest_uplift.element", optional=True),
        LINES["reaction"].column(units, missing=NOT_KNOWN),
        LINES["submerged_weight"].column(units),
        *([LINES["empty_weight"].column(units)] if filled else []),
        LINES["ratio"].column(units),
    ]
    return DisplayTable("Touchdown", columns, lines, note)


def state_table(states: Rows) -> DisplayTable:
    """Return the table of the states of laws with states."""
    return DisplayTable("States", (text("law", "law"), text("state", "state"), number("count", "count")), states)


def plan_table(stages: Rows, steps: str) -> DisplayTable:
    """Return the table of the stages of an evaluation; `steps` is the order of its time steps."""
    active = text("active", lambda row: "yes" if row["active"] else "no")
    return DisplayTable(f"Plan, {steps}", (text("stage", "stage"), active, text("why", "why")), stages)


def weight_note(left_out: Sequence[str], case: int | None = None) -> str:
    """Return a note about the load case of the contents if they differ, and about weights that are left out."""
    notes = [f"weights with the contents of load case {case}"] if case else []
    return "; ".join(notes + ([f"weights without {', '.join(left_out)}"] if left_out else []))


def tables_of(summary: dict[str, Any], most: int) -> list[DisplayTable]:
    """Return the tables of a summary of a deck that have rows; `most` is the largest number of diameters."""
    units = summary["units"]
    of_set = (text("set", "set"), number("elements", "elements"))
    stiffness = number("stiffness", "stiffness", UNITS[units].unit("F/L2"), optional=True)
    tables = (
        set_table(summary["sets"], units),
        _curves(summary["curves"], units),
        diameter_table(summary["diameters"], units, none="none").first(most, "diameter"),
        DisplayTable("Normal laws", (text("law", "law"), *of_set, stiffness), summary["laws"]),
        _resistance(summary["bed"], units),
        DisplayTable("Extensions", (text("keyword", _keyword), *of_set), summary["extensions"]),
        _static(summary["static_embedment"], units, summary["weights_without"], summary["contents_case"]),
    )
    return [table for table in tables if table.rows]


def _curves(curves: Rows, units: str) -> DisplayTable:
    columns = (
        text("curve", "name"),
        text("keyword", _keyword),
        number("points", "points"),
        number("ratio", lambda row: _range(row["ratios"])),
        number("force", lambda row: _range(row["forces"]), UNITS[units].unit("F/L")),
        number("elements", elements_of),
    )
    return DisplayTable("Force-embedment curves", columns, curves)


def _keyword(row: dict[str, Any]) -> str:
    return f"*{row['keyword']}"


def _range(ends: list[float] | None) -> str:
    return "" if ends is None else f"{shown(ends[0])} to {shown(ends[1])}"


def _resistance(blocks: Rows, units: str) -> DisplayTable:
    unit = UNITS[units].unit
    columns = (
        text("set", "set"),
        number("elements", "elements"),
        number("friction\ncoefficients", lambda row: _pair(row["friction"]), optional=True),
        number("mobilisation\nlengths", lambda row: _pair(row["mobilisation"]), unit("L"), optional=True),
        number("lateral\nstiffness", "lateral", unit("F/L2"), optional=True),
        number("suction\nstiffness", "suction", unit("F/L2"), optional=True),
        number("suction\nzone", "extent", unit("L"), optional=True),
    )
    return DisplayTable("Friction, lateral resistance, suction", columns, blocks)


def _pair(values: list[float | None]) -> str:
    return ", ".join(shown(value) or "-" for value in values) if values != [None, None] else ""


def _static(rows: Rows, units: str, left_out: Sequence[str], case: int | None) -> DisplayTable:
    alike = len({(row["set"], row["law"], row["filled"]) for row in rows}) < len(rows)
    table = static_table(rows, units, left_out, case, first=alike)
    return replace(table, columns=[*table.columns, text("extrapolated", "extrapolated", optional=True)])


# ------------------------------------------------------------------------------------------------------------ the sheet

SHEET_FORMAT = "mudline-sheet/1"


def sheet_tables(sheet: Sheet) -> list[DisplayTable]:
    """Return the sheet for people: pipe, weights, surroundings, and other load cases if any."""
    tables, run = [], text("elements", lambda row: span(row["first_element"], row["last_element"]))
    for subject, columns in sheet.subjects.items() if sheet.rows else ():
        note = weight_note(sheet.left_out) if "weight" in subject else ""
        shown = [replace(each, value=_contents) if each.value == "contents" else each for each in columns]
        table = DisplayTable(f"Sheet: {subject}", [run, *shown], sheet.rows, note)
        tables += [table] if subject and columns else []
    return tables


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
        return ResultColumn(key, *coded(values))
    dtype = np.int64 if key in {"first_element", "last_element", "elements"} else np.float64  # None becomes NaN
    return ResultColumn(key, np.array(values, dtype), unit=column.unit)
