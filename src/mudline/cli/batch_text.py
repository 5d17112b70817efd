"""Batch results for people: decks that failed with the reasons, then the extremes of the others."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from mudline.basics.display import Cell, DisplayColumn, DisplayTable, Value, number, text
from mudline.basics.quantities import shown
from mudline.cli.streams import View, counted
from mudline.model.results.cases import CASES, CaseSummary

_DIGITS = 5
_SHORT = 24
"""Letters of a name that is never wrapped."""
_OF_FORCES = (
    "largest_force",
    "largest_force_element",
    "largest_uplift",
    "largest_uplift_element",
    "reaction",
    "submerged_weight",
    "empty_weight",
    "contents_case",
    "ratio",
)
_LARGE = 1e7
"""Limit above which numbers have an exponent."""


def print_cases(ranked: Sequence[CaseSummary], folder: str, names: Mapping[str, str], view: View) -> None:
    """Print the failed decks and then the others, with their `names` below a folder; -v prints all."""
    printer = view.printer()
    failed = [row for row in ranked if row.failed]
    evaluated = ranked[len(failed) :]
    where = f" in {inside}" if (inside := _inside(folder)) else ""
    short = all(len(names[row.deck]) <= _SHORT for row in ranked)
    deck = text("deck", lambda row: names[row.deck], whole=short)
    if failed:
        table = DisplayTable(f"Failed{where}", [deck, text("reason", "reason")], failed)
        printer.table(_first(table, view.most))
    if evaluated:
        title, columns = f"Contact of {counted(len(evaluated), 'deck')}{where}", _columns(evaluated[: view.most])
        printer.table(_first(DisplayTable(title, [deck, *columns], evaluated), view.most))
    doubtful = sum(bool(row.warnings) for row in evaluated)
    parts = [f"{counted(len(ranked), 'deck')}: {len(evaluated)} evaluated"]
    parts += [f"{doubtful} with warnings"] if doubtful else []
    parts += [f"{len(failed)} failed"] if failed else []
    printer.line((", ".join(parts), "bold red" if failed else "green"))


def _inside(folder: str) -> str:
    """Return a folder relative to the working folder; "" for the working folder itself."""
    place, here = Path(folder), Path.cwd()
    if place == here:
        return ""
    return (place.relative_to(here) if place.is_relative_to(here) else place).as_posix()


def _first(table: DisplayTable, most: int) -> DisplayTable:
    decks = "more deck" if len(table.rows) - most == 1 else "more decks"
    return table.first(most, f"{decks}: -v shows all")


def _columns(listed: Sequence[CaseSummary]) -> Iterator[DisplayColumn]:
    """Yield the columns of the evaluated decks; columns in which all rows agree on nothing are left out when empty."""
    systems = {row.units for row in listed}
    units = listed[0].units or "" if len(systems) == 1 else ""

    def column(name: str, heading: str = "", value: Value = "") -> DisplayColumn:
        quantity = CASES[name]

        def shortened(row: CaseSummary) -> Cell:
            cell: Cell = getattr(row, name)
            return _number(cell) if isinstance(cell, float) else cell

        return number(heading or quantity.label or name, value or shortened, quantity.unit_name(units), optional=True)

    if len(systems) > 1:
        yield column("units")
    if any(row.steps != 1 for row in listed):
        yield column("steps")
    yield column("in_contact")
    yield column("touchdown_from", "TDP\nat", _touchdown)
    yield column("contact_length", value=lambda row: _number(row.contact_length) if row.contact_length else "")
    filled = any(row.submerged_weight != row.empty_weight for row in listed)
    for name in _OF_FORCES:
        if filled or name != "empty_weight":
            yield column(name)
    yield column("warnings", value=lambda row: row.warnings or "")


def _touchdown(row: CaseSummary) -> str:
    """Return the range of arc lengths of the touchdown points; "all" or "none" for a line without touchdown point."""
    if row.touchdown_from is None:
        return "all" if row.contact_length else "none"
    low, high = _number(row.touchdown_from), _number(row.touchdown_to)
    return low if low == high else f"{low} to {high}"


def _number(value: float | None) -> str:
    """Return a number with few digits, without an exponent below 1e7."""
    short = shown(value, _DIGITS)
    return f"{value:.0f}" if value is not None and "e+" in short and abs(value) < _LARGE else short
