"""Tables for people: one list of columns serves terminal and page."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from mudline.basics.short_repr import counted

Cell = str | int | float | tuple[str, str] | None
"""Content of a cell: a text, a number, a text with its style, or nothing."""
Value = str | int | Callable[[Any], Cell]
"""Source of a cell: a key, attribute or index of the row, `a.b` that of a part, or a function of the row."""


@dataclass(frozen=True, slots=True)
class DisplayColumn:
    """A column of a table.

    Attributes:
        heading: one line or several.
        value: source of the cells.
        unit: written below the heading; "" for none.
        left: aligned left and wrapped where too wide, as text; numbers are aligned right.
        whole: never wrapped, as a path.
        optional: left out where all its cells are empty.
        missing: cell of a value that is None.
        digits: significant digits of numbers on the terminal; a page has four.
    """

    heading: str
    value: Value
    unit: str = ""
    left: bool = False
    whole: bool = False
    optional: bool = False
    missing: Cell = None
    digits: int = 6

    @property
    def head(self) -> str:
        """The heading with its unit."""
        return f"{self.heading}\n[{self.unit}]" if self.unit else self.heading

    def cell(self, row: Any) -> Cell:  # noqa: ANN401 - rows of JSON, or objects
        """Return the cell of a row."""
        if callable(self.value):
            cell = self.value(row)
        elif isinstance(self.value, int):
            cell = row[self.value]
        else:
            cell = row
            for name in self.value.split("."):
                cell = None if cell is None else cell[name] if isinstance(cell, Mapping) else getattr(cell, name)
        return self.missing if cell is None else cell


number = DisplayColumn
"""Column of numbers, with the arguments of DisplayColumn."""


text = partial(DisplayColumn, left=True)
"""Column of texts, with the arguments of DisplayColumn."""


@dataclass(frozen=True, slots=True)
class DisplayTable:
    """A table.

    Attributes:
        title: its title.
        columns, rows: its columns and its rows.
        note: text below the table.
        more: sentence on rows that are left out.
        anchor, row_anchor: anchors of the table and, before their numbers, of its rows on a page.
        few: number of rows on a page before its appendix, which has all.
        longest: characters of a text on a page, behind which it is cut.
    """

    title: str
    columns: Sequence[DisplayColumn]
    rows: Sequence[Any]
    note: str = ""
    more: str = ""
    anchor: str = ""
    row_anchor: str = ""
    few: int = 8
    longest: int = 80

    def cells(self) -> list[list[Cell]]:
        """Return the cells, row by row."""
        return [[column.cell(row) for column in self.columns] for row in self.rows]

    def filled(self) -> DisplayTable:
        """Return the table without optional columns whose cells are all empty."""
        cells = list(zip(*self.cells(), strict=True)) or [()] * len(self.columns)
        kept = [
            column
            for column, values in zip(self.columns, cells, strict=True)
            if not column.optional or any(map(_is_full, values))
        ]
        return replace(self, columns=kept)

    def first(self, most: int, thing: str = "row", advice: str = "-v shows all") -> DisplayTable:
        """Return the table with the first `most` rows; `more` counts the rows left out, of which each is a `thing`."""
        left = len(self.rows) - most
        more = f"{counted(left, f'more {thing}')}: {advice}"
        return replace(self, rows=self.rows[:most], more=more) if left > 0 else self


def _is_full(cell: Cell) -> bool:
    return bool(cell[0]) if isinstance(cell, tuple) else cell is not None and cell != ""
