"""A summary on the terminal."""

from __future__ import annotations

from typing import Any

from rich.text import Text

from mudline.cli.console import console
from mudline.cli.tables import table
from mudline.lint.output.text import visible
from mudline.results.numbers import shown


def print_summary(summary: dict[str, Any], color: str) -> None:
    """Sections and keywords, then a table each of sets, curves, diameters and laws."""
    printer = console(color)
    length = f", {shown(summary['length'])} long" if summary["length"] is not None else ""
    seabed = " and ".join(summary["seabed"]) or "no"
    counts = f"{summary['nodes']} nodes, {summary['elements']} elements{length}"
    head = f"{summary['file']}: {summary['units']} units, {counts}, {seabed} seabed"
    printer.print(Text(visible(head), style="bold"))
    for section in summary["sections"]:
        words = [f"*{entry['keyword']}{'' if entry['read'] else ' (kept as it is)'}" for entry in section["keywords"]]
        printer.print(Text(visible(f"  ${section['name']}: {', '.join(words) or 'empty'}")))
    printer.print(Text(""))
    sets = [
        (entry["name"], str(entry["elements"]) + ("+" if entry["open"] else ""), shown(entry["length"]))
        for entry in summary["sets"]
    ]
    printer.print(table("Element sets", ("set", "elements", "length"), sets, left=("set",)))
    if summary["curves"]:
        printer.print(table("Force-embedment curves", *_curve_rows(summary["curves"]), left=("curve", "keyword")))
    diameters = [(shown(entry["diameter"]) or "none", str(entry["elements"])) for entry in summary["diameters"]]
    printer.print(table("External diameters", ("diameter", "elements"), diameters))
    laws = [
        (entry["law"], entry["set"] or "", str(entry["elements"]), shown(entry["stiffness"]))
        for entry in summary["laws"]
    ]
    printer.print(table("Normal laws", ("law", "set", "elements", "stiffness"), laws, left=("law", "set")))


def _curve_rows(curves: list[dict[str, Any]]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    columns = ("curve", "keyword", "points", "first ratio", "last ratio", "least force", "largest force", "elements")
    rows = []
    for entry in curves:
        ratios, forces = entry["ratios"] or (None, None), entry["forces"] or (None, None)
        numbers = [shown(value) for value in (*ratios, *forces)]
        rows.append((entry["name"], f"*{entry['keyword']}", str(entry["points"]), *numbers, str(entry["elements"])))
    return columns, rows
