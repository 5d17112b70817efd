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
from mudline.results.quantities import UnitNames, headed, shown, unit_names

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
    if summary["bed"]:
        _print_bed(printer, summary["bed"], names)
    if summary["extensions"]:
        blocks = [(f"*{row['keyword']}", row["set"] or "", str(row["elements"])) for row in summary["extensions"]]
        print_table(printer, "Extensions", ("keyword", "set", "elements"), blocks, left=("keyword", "set"))
    if summary["static_embedment"]:
        _print_static(printer, summary["static_embedment"], names)


def _print_static(printer: Console, rows: list[dict[str, Any]], names: UnitNames) -> None:
    columns = ["set", "law", headed("weight", names.line_force), "ratio"]
    columns += [headed("penetration", names.length), "stiffness"]
    numbers = ("weight", "ratio", "penetration", "stiffness")
    cells = [[row["set"] or "", row["law"], *(shown(row[name]) for name in numbers)] for row in rows]
    if any(row["extrapolated"] for row in rows):
        columns.append("extrapolated")
        cells = [[*line, row["extrapolated"] or ""] for line, row in zip(cells, rows, strict=True)]
    print_table(printer, "Static embedment", columns, cells, left=("set", "law", "extrapolated"))


def _print_head(printer: Console, summary: dict[str, Any], names: UnitNames) -> None:
    length = f", {shown(summary['length'])} {names.length}".rstrip() + " long" if summary["length"] is not None else ""
    seabed = " and ".join(summary["seabed"]) or "no"
    counts = f"{summary['nodes']} nodes, {summary['elements']} elements{length}"
    bed = _bed(summary["floor"])
    head = f"{summary['file']}: {summary['units']} units, {counts}, {seabed} seabed{bed}"
    printer.print(Text(visible(head, printer.encoding), style="bold"), soft_wrap=False)
    for name in summary["continues"]:
        _print_folded(printer, f"continues {visible(name, printer.encoding)}", "  ")
    for section in summary["sections"]:
        keywords = section["keywords"]
        read = _listed(printer, [entry["keyword"] for entry in keywords if entry["read"]])
        kept = _listed(printer, [entry["keyword"] for entry in keywords if not entry["read"]])
        name = "$" + visible(section["name"], printer.encoding)
        _print_folded(printer, f"{name}: {read}" if read else name, "  ")
        if kept:
            _print_folded(printer, f"kept as they are: {kept}", "    ")
    printer.print()


def _bed(floor: dict[str, Any]) -> str:
    """The shape of a bed that is not flat."""
    turned = f", turned by {shown(floor['direction'])} degrees" if floor["direction"] else ""
    if floor["kind"] == "flat":
        return ""
    if floor["kind"] == "sloping":
        return f", sloping {shown(floor['slope'])} degrees{turned}"
    if floor["kind"] == "planes":
        return f", {floor['planes']} plane{'s' * (floor['planes'] != 1)}"
    points = f"{floor['points']} points" if floor["missing"] is None else "not known"
    source = f" of {floor['file']}" if floor["file"] else ""
    return f", {floor['kind']}{source}: {points}{turned}"


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
            str(entry["elements"]) + "+" * entry["open"],
        )
        for entry in curves
    ]
    print_table(printer, "Force-embedment curves", columns, rows, left=("curve", "keyword"))


def _range(ends: list[float] | None) -> str:
    return "" if ends is None else f"{shown(ends[0])} to {shown(ends[1])}"


def _print_bed(printer: Console, bed: list[dict[str, Any]], names: UnitNames) -> None:
    """Friction and suction; a column that no row fills is left out."""
    columns = [
        ("friction\ncoefficients", [_pair(row["friction"]) for row in bed]),
        (headed("mobilisation\nlengths", names.length), [_pair(row["mobilisation"]) for row in bed]),
        (headed("lateral\nstiffness", names.stiffness), [shown(row["lateral"]) for row in bed]),
        (headed("suction\nstiffness", names.stiffness), [shown(row["suction"]) for row in bed]),
        (headed("suction\nzone", names.length), [shown(row["extent"]) for row in bed]),
    ]
    filled = [(head, cells) for head, cells in columns if any(cells)]
    sets = [row["set"] for row in bed]
    counts = [str(row["elements"]) for row in bed]
    rows = list(zip(sets, counts, *(cells for _, cells in filled), strict=True))
    heads = ("set", "elements", *(head for head, _ in filled))
    print_table(printer, "Friction, lateral resistance, suction", heads, rows, left=("set",))


def _pair(values: list[float | None]) -> str:
    return ", ".join(shown(value) or "-" for value in values) if values != [None, None] else ""


def _print_laws(printer: Console, laws: list[dict[str, Any]], names: UnitNames) -> None:
    linear = any(entry["stiffness"] is not None for entry in laws)
    columns = ("law", "set", "elements", *([headed("stiffness", names.stiffness)] if linear else []))
    rows = [
        (entry["law"], entry["set"] or "", str(entry["elements"]), shown(entry["stiffness"]))[: len(columns)]
        for entry in laws
    ]
    print_table(printer, "Normal laws", columns, rows, left=("law", "set"))
