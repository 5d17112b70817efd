"""Tables of the summary of a deck and of its contact, for a terminal and for a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mudline.basics.display import Cell, DisplayTable, number, text
from mudline.basics.quantities import UnitNames

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
    columns = (number("diameter", "diameter", names.length, missing=none), number("elements", "elements"))
    return DisplayTable("External diameters", columns, diameters)


def static_table(
    rows: Rows, names: UnitNames, left_out: Sequence[str], case: int | None, *, first: bool
) -> DisplayTable:
    """Return the table of static embedment; `first` adds the first element of a row.

    `left_out` are weights not included, `case` is the load case of the contents if they differ.
    The stiffness of springs of nodes is that of a node, and has no unit here.
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
    return DisplayTable("Static embedment", columns, rows, weight_note(left_out, case))


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


def weight_note(left_out: Sequence[str], case: int | None = None) -> str:
    """Return a note about the load case of the contents if they differ, and about weights that are left out."""
    notes = [f"weights with the contents of load case {case}"] if case else []
    return "; ".join(notes + ([f"weights without {', '.join(left_out)}"] if left_out else []))
