"""A summary on the terminal."""

from __future__ import annotations

from collections import Counter
from textwrap import wrap
from typing import Any

from rich.console import Console
from rich.text import Text

from mudline.cli.console import console
from mudline.cli.options import View
from mudline.cli.tables import print_table
from mudline.linting.output.visible import visible
from mudline.results.numbers import shown
from mudline.results.units import UnitNames, headed, unit_names

_WIDEST = 120
_MOST_DIAMETERS = 10
_OPEN = "+ a block that is not read may add elements to this set"


def print_summary(summary: dict[str, Any], view: View) -> None:
    """Sections and keywords, then a table each of sets, curves, diameters and laws."""
    printer = console(view.color)
    most = None if view.verbose else _MOST_DIAMETERS
    names = unit_names(summary["units"])
    _print_head(printer, summary, names)
    _print_sets(printer, summary["sets"], names)
    if summary["curves"]:
        _print_curves(printer, summary["curves"], names)
    if summary["diameters"]:
        rows = [(shown(entry["diameter"]) or "none", str(entry["elements"])) for entry in summary["diameters"]]
        left = len(rows) - len(rows[:most])
        note = f"{left} more diameters: -v shows all" if left else ""
        print_table(
            printer, "External diameters", (headed("diameter", names.length), "elements"), rows[:most], note=note
        )
    if summary["laws"]:
        _print_laws(printer, summary["laws"], names)


def _print_head(printer: Console, summary: dict[str, Any], names: UnitNames) -> None:
    length = f", {shown(summary['length'])} {names.length}".rstrip() + " long" if summary["length"] is not None else ""
    seabed = " and ".join(summary["seabed"]) or "no"
    counts = f"{summary['nodes']} nodes, {summary['elements']} elements{length}"
    head = f"{summary['file']}: {summary['units']} units, {counts}, {seabed} seabed"
    printer.print(Text(visible(head, printer.encoding), style="bold"), soft_wrap=False)
    for section in summary["sections"]:
        keywords = section["keywords"]
        read = _listed(printer, [entry["keyword"] for entry in keywords if entry["read"]])
        kept = _listed(printer, [entry["keyword"] for entry in keywords if not entry["read"]])
        name = "$" + visible(section["name"], printer.encoding)
        _print_folded(printer, f"{name}: {read}" if read else name, "  ")
        if kept:
            _print_folded(printer, f"kept as they are: {kept}", "    ")
    printer.print()


def _listed(printer: Console, keywords: list[str]) -> str:
    """Names of keywords, each once, with the number of its blocks when there are more."""
    counts = Counter(keywords)
    return ", ".join(
        f"*{visible(name, printer.encoding)}" + (f" ({count} blocks)" if count > 1 else "")
        for name, count in counts.items()
    )


def _print_folded(printer: Console, text: str, indent: str) -> None:
    width = min(printer.width, _WIDEST)
    for line in wrap(text, width, initial_indent=indent, subsequent_indent="      "):
        printer.print(Text(line))


def _print_sets(printer: Console, sets: list[dict[str, Any]], names: UnitNames) -> None:
    rows = [
        (entry["name"], str(entry["elements"]) + ("+" if entry["open"] else ""), shown(entry["length"]))
        for entry in sets
    ]
    note = _OPEN if any(entry["open"] for entry in sets) else ""
    columns = ("set", "elements", headed("length", names.length))
    print_table(printer, "Element sets", columns, rows, left=("set",), note=note)


def _print_curves(printer: Console, curves: list[dict[str, Any]], names: UnitNames) -> None:
    force = headed("force", names.line_force)
    columns = ("curve", "keyword", "points", "ratio", force, "elements")
    rows = [
        (
            entry["name"],
            f"*{entry['keyword']}",
            str(entry["points"]),
            _range(entry["ratios"]),
            _range(entry["forces"]),
            str(entry["elements"]),
        )
        for entry in curves
    ]
    print_table(printer, "Force-embedment curves", columns, rows, left=("curve", "keyword"))


def _range(ends: list[float] | None) -> str:
    return "" if ends is None else f"{shown(ends[0])} to {shown(ends[1])}"


def _print_laws(printer: Console, laws: list[dict[str, Any]], names: UnitNames) -> None:
    linear = any(entry["stiffness"] is not None for entry in laws)
    columns = ("law", "set", "elements", *([headed("stiffness", names.stiffness)] if linear else []))
    rows = [
        (entry["law"], entry["set"] or "", str(entry["elements"]), shown(entry["stiffness"]))[: len(columns)]
        for entry in laws
    ]
    print_table(printer, "Normal laws", columns, rows, left=("law", "set"))
