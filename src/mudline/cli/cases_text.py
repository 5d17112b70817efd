"""Many decks for people: a line for each, those that failed with the reason, and how many there are."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mudline.cli.evaluate_one import MOST_ROWS
from mudline.cli.streams import counted
from mudline.cli.view import View
from mudline.quantities import CASES, shown
from mudline.results.cases import CaseSummary

if TYPE_CHECKING:
    from mudline.cli.printing import Printer

_GAP = "  "
_SHORTEST = 20
"""Columns that a deck's name gets on the narrowest terminal."""
_DIGITS = 5
_LARGE = 1e7
"""Numbers from here on have an exponent."""

Cell = Callable[[CaseSummary], str]


def print_cases(rows: Sequence[CaseSummary], folder: str, names: Mapping[str, str], view: View) -> None:
    """Print a line for each deck, called by its name below the folder; most of many only with -v."""
    if not rows:
        return
    printer = view.printer()
    printer.write(_lines(rows, _title(len(rows), folder), names, printer, all_of=view.verbose))


def _title(count: int, folder: str) -> str:
    place, here = Path(folder), Path.cwd()
    inside = place.relative_to(here) if place.is_relative_to(here) else place
    return f"Contact of {counted(count, 'deck')}" + (f" in {inside.as_posix()}" if folder and inside.parts else "")


def _lines(
    rows: Sequence[CaseSummary], title: str, names: Mapping[str, str], printer: Printer, *, all_of: bool
) -> Iterator[str]:
    """The table: on a narrow terminal without the columns that are needed least, and with long names shortened."""
    listed = rows if all_of else rows[:MOST_ROWS]
    columns, dropped = _fitting(listed, printer.width)
    cells = {head: [cell(row) for row in listed] for head, cell in columns.items()}
    widths = {head: max(map(len, (*head.split("\n"), *texts))) for head, texts in cells.items()}
    available = max(printer.width - _width(widths), _SHORTEST)
    decks = [printer.elided(names[row.deck], available) for row in listed]
    first = max(map(printer.columns, ("deck", *decks)))
    yield _bold(printer.elided(title, max(printer.width, _SHORTEST)), printer)
    heads = [head.split("\n") for head in widths]
    depth = max(map(len, heads), default=1)
    for line in range(depth):
        parts = [head[line - depth + len(head)] if line >= depth - len(head) else "" for head in heads]
        yield _row("deck" if line == depth - 1 else "", first, parts, widths)
    yield printer.rule * (first + _width(widths))
    for number, (row, deck) in enumerate(zip(listed, decks, strict=True)):
        padding = " " * (first - printer.columns(deck))
        if row.failed:
            yield from _reason(row, f"{deck}{padding}{_GAP}", first, printer)
        else:
            yield _row(deck + padding, first, [texts[number] for texts in cells.values()], widths)
    if left := len(rows) - len(listed):
        yield _dim(f"{counted(left, 'more deck')}: -v shows all", printer)
    if dropped:
        note = f"left out on a narrow terminal: {', '.join(dropped)}"
        yield from (_dim(text, printer) for text in textwrap.wrap(note, max(printer.width, _SHORTEST)))
    yield ""
    yield _total(rows, printer)


def _reason(row: CaseSummary, before: str, first: int, printer: Printer) -> Iterator[str]:
    """A deck that failed and why, in as many lines as that needs."""
    indent = " " * (first + len(_GAP))
    width = max(printer.width - len(indent), _SHORTEST)
    texts = textwrap.wrap(printer.visible(f"failed: {row.reason}"), width, break_on_hyphens=False)
    for number, text in enumerate(texts):
        start = "" if number else click.style("failed", fg="red", bold=True) if printer.colored else "failed"
        yield f"{indent if number else before}{start}{text if number else text.removeprefix('failed')}"


def _fitting(rows: Sequence[CaseSummary], width: int) -> tuple[dict[str, Cell], list[str]]:
    """The columns that fit beside the names, and the names of those that do not."""
    columns, droppable = _columns([row for row in rows if not row.failed])
    dropped = []
    for head in droppable:
        widths = {head: max(map(len, (*head.split("\n"), *map(cell, rows)))) for head, cell in columns.items()}
        if _width(widths) + _SHORTEST <= width:
            break
        del columns[head]
        dropped.append(" ".join(head.split("\n")).split(" [")[0].replace("- ", ""))
    return columns, dropped


def _columns(rows: Sequence[CaseSummary]) -> tuple[dict[str, Cell], list[str]]:
    """The columns by their headings, and those that are left out first on a narrow terminal."""
    systems = {row.units for row in rows}
    units = next(iter(systems)) or "" if len(systems) == 1 else ""

    def head(name: str, label: str = "") -> str:
        quantity = CASES[name]
        unit = quantity.unit_name(units)
        text = label or quantity.label or name
        return f"{text}\n[{unit}]" if unit else text

    def number(name: str) -> Cell:
        return lambda row: _number(getattr(row, name))

    def count(name: str) -> Cell:
        return lambda row: "" if getattr(row, name) is None else str(getattr(row, name))

    optional = ("steps", "in_contact", "largest_force_element", "contact_length")
    cells: dict[str, Cell] = {
        "units": count("units"),
        "steps": count("steps"),
        "in_contact": count("in_contact"),
        "touchdown": _touchdown,
        **{name: number(name) for name in ("contact_length", "largest_force")},
        "largest_force_element": count("largest_force_element"),
        **{name: number(name) for name in ("largest_uplift", "reaction", "ratio")},
        "warnings": lambda row: str(row.warnings or ""),
    }
    unused = {name for name in ("largest_uplift", "warnings") if not any(map(cells[name], rows))}
    unused |= {"steps"} if all(row.steps == 1 for row in rows) else set()
    unused |= {"units"} if len(systems) < 2 else set()
    heads = {
        name: head("touchdown_from", "touchdown\nat") if name == "touchdown" else head(name)
        for name in cells
        if name not in unused
    }
    return {text: cells[name] for name, text in heads.items()}, [heads[name] for name in optional if name in heads]


def _touchdown(row: CaseSummary) -> str:
    """Between which arc lengths the touchdown points are, or that all of the line is on the seabed or above."""
    if row.failed:
        return ""
    if row.touchdown_from is None:
        return "all" if row.contact_length else "none"
    low, high = _number(row.touchdown_from), _number(row.touchdown_to)
    return low if low == high else f"{low} to {high}"


def _number(value: float | None) -> str:
    """A number with few digits; one that is large for that is whole, rather than with an exponent."""
    text = shown(value, _DIGITS)
    return f"{value:.0f}" if value is not None and "e+" in text and abs(value) < _LARGE else text


def _total(rows: Sequence[CaseSummary], printer: Printer) -> str:
    failed, doubtful = sum(row.failed for row in rows), sum(bool(row.warnings) for row in rows)
    parts = [f"{counted(len(rows), 'deck')}: {len(rows) - failed} evaluated"]
    parts += [f"{doubtful} with warnings"] if doubtful else []
    parts += [f"{failed} failed"] if failed else []
    text = ", ".join(parts)
    return click.style(text, fg="red" if failed else "green", bold=bool(failed)) if printer.colored else text


def _width(widths: Mapping[str, int]) -> int:
    """Columns of a line behind the name."""
    return sum(widths.values()) + len(_GAP) * len(widths)


def _row(deck: str, first: int, cells: Sequence[str], widths: Mapping[str, int]) -> str:
    padded = [cell.rjust(width) for cell, width in zip(cells, widths.values(), strict=True)]
    return _GAP.join([deck.ljust(first), *padded]).rstrip()


def _bold(text: str, printer: Printer) -> str:
    return click.style(text, bold=True) if printer.colored else text


def _dim(text: str, printer: Printer) -> str:
    return click.style(text, dim=True) if printer.colored else text
