"""Many decks for people: those that failed with the reasons, then what is worst in the results of the others."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from mudline.cli.streams import counted
from mudline.cli.view import View
from mudline.limits import SHOWN_ROWS
from mudline.quantities import CASES, headed, shown
from mudline.results.cases import CaseSummary

if TYPE_CHECKING:
    from mudline.cli.printing import Printer

_DIGITS = 5
_LARGE = 1e7
"""Numbers from here on have an exponent."""


def print_cases(ranked: Sequence[CaseSummary], folder: str, names: Mapping[str, str], view: View) -> None:
    """Print the decks that failed and the others, called by their `names` below a folder; most of many only with -v."""
    printer = view.printer()
    failed = [row for row in ranked if row.failed]
    evaluated = ranked[len(failed) :]
    most = None if view.verbose else SHOWN_ROWS
    where = f" in {inside}" if (inside := _inside(folder)) else ""
    if failed:
        reasons = [(names[row.deck], row.reason or "") for row in failed[:most]]
        printer.table(f"Failed{where}", ("deck", "reason"), reasons, left=("deck", "reason"), note=_more(failed, most))
    if evaluated:
        title = f"Contact of {counted(len(evaluated), 'deck')}{where}"
        _print_evaluated(printer, title, evaluated[:most], names, _more(evaluated, most))
    doubtful = sum(bool(row.warnings) for row in evaluated)
    parts = [f"{counted(len(ranked), 'deck')}: {len(evaluated)} evaluated"]
    parts += [f"{doubtful} with warnings"] if doubtful else []
    parts += [f"{len(failed)} failed"] if failed else []
    printer.line((", ".join(parts), "bold red" if failed else "green"))


def _print_evaluated(
    printer: Printer, title: str, listed: Sequence[CaseSummary], names: Mapping[str, str], note: str
) -> None:
    """A line for each deck, without columns that say nothing."""
    systems = {row.units for row in listed}
    columns = _columns(next(iter(systems)) or "" if len(systems) == 1 else "")
    if len(systems) == 1:
        del columns["units"]
    if all(row.steps == 1 for row in listed):
        del columns["steps"]
    cells = [[names[row.deck], *(cell(row) for cell in columns.values())] for row in listed]
    printer.table(title, ("deck", *columns), cells, left=("deck",), optional=tuple(columns), note=note)


def _inside(folder: str) -> str:
    """A folder as seen from this one; "" for this one, and for none."""
    place, here = Path(folder), Path.cwd()
    if place == here:
        return ""
    return (place.relative_to(here) if place.is_relative_to(here) else place).as_posix()


def _more(rows: Sequence[CaseSummary], most: int | None) -> str:
    left = 0 if most is None else len(rows) - most
    return f"{counted(left, 'more deck')}: -v shows all" if left > 0 else ""


def _columns(units: str) -> dict[str, Callable[[CaseSummary], str]]:
    """What is shown of an evaluated deck, by the headings."""

    def head(name: str, label: str = "") -> str:
        return headed(label or CASES[name].label or name, CASES[name].unit_name(units))

    return {
        "units": lambda row: row.units or "",
        "steps": lambda row: _count(row.steps),
        head("in_contact"): lambda row: _count(row.in_contact),
        head("touchdown_from", "touchdown\nat"): _touchdown,
        head("largest_force"): lambda row: _number(row.largest_force),
        head("largest_force_element"): lambda row: _count(row.largest_force_element),
        head("largest_uplift"): lambda row: _number(row.largest_uplift),
        head("reaction"): lambda row: _number(row.reaction),
        head("ratio"): lambda row: _number(row.ratio),
        head("warnings"): lambda row: str(row.warnings or ""),
    }


def _touchdown(row: CaseSummary) -> str:
    """Between which arc lengths the touchdown points are, or that all of the line is on the seabed or above."""
    if row.touchdown_from is None:
        return "all" if row.contact_length else "none"
    low, high = _number(row.touchdown_from), _number(row.touchdown_to)
    return low if low == high else f"{low} to {high}"


def _count(value: int | None) -> str:
    return "" if value is None else str(value)


def _number(value: float | None) -> str:
    """A number with few digits; one that is large for that is whole, rather than with an exponent."""
    text = shown(value, _DIGITS)
    return f"{value:.0f}" if value is not None and "e+" in text and abs(value) < _LARGE else text
