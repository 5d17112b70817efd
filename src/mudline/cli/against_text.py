"""Differences to another program's results, for people."""

from __future__ import annotations

from typing import Any

from mudline.cli.console import console
from mudline.cli.options import View
from mudline.cli.tables import print_table
from mudline.results.against import Comparison
from mudline.results.quantities import shown


def print_comparison(comparison: Comparison, view: View) -> None:
    """A line a column: how many values were compared, the largest differences and where they are."""
    timed = comparison.timed
    place = ("at\nelement", "at\ntime") if timed else ("at\nelement",)
    columns = (
        "column",
        "compared",
        "largest\ndifference",
        *place,
        "largest\nrelative",
        *place,
        "rms\ndifference",
    )
    rows = []
    for found in comparison.differences:
        row = found.row()
        absolute, relative = row["largest_difference"], row["largest_relative"]
        rows.append(
            (
                found.column,
                str(found.compared),
                *_cells(absolute, "difference", timed=timed),
                *_cells(relative, "relative", timed=timed),
                shown(found.rms, 4),
            )
        )
    print_table(console(view.color), f"Compared with {comparison.reference.file}", columns, rows, left=("column",))


def _cells(extreme: dict[str, Any] | None, name: str, *, timed: bool) -> tuple[str, ...]:
    """Value, element and time of a largest difference; nothing where nothing was compared."""
    if extreme is None:
        return ("",) * (2 + timed)
    cells = (shown(extreme[name], 4), str(extreme["element"]))
    return (*cells, shown(extreme["time"])) if timed else cells
