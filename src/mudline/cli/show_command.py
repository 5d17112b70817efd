"""`mudline show`."""

from __future__ import annotations

from collections import Counter
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import GivenDeck, takes_deck
from mudline.cli.streams import emit_json, notify
from mudline.cli.view import View
from mudline.diagnostics import Coverage
from mudline.keywords import catalogue
from mudline.keywords.values import SUBJECTS
from mudline.limits import SHOWN_ROWS
from mudline.linting.context import LintContext
from mudline.linting.engine import of_base
from mudline.linting.verdict import all_findings, errors_of
from mudline.quantities import UnitNames, headed, shown, unit_names
from mudline.results.summary import OPEN, summarise
from mudline.short_repr import counted

if TYPE_CHECKING:
    from mudline.cli.printing import Printer


@options.command("show")
@options.output_format("text", "json")
@takes_deck
def command(*, deck: GivenDeck, output_format: str, view: View) -> int:
    """Summarise a deck: sections, keywords, sets, curves, diameters, laws.

    A deck with errors is shown as far as it can be read; the exit code is then 1.
    """
    context = LintContext(deck.load())
    scene = context.scene
    summary = summarise(scene)
    errors = [*errors_of(all_findings(context)), *(one for one in scene.errors() if of_base(context.deck, one))]
    if output_format == "json":
        emit_json(summary)
    else:
        _print_summary(summary, view)
    if errors:
        counts = Counter(diagnostic.file for diagnostic in scene.deck.diagnose(errors))
        for file, count in counts.items():
            notify(f"{file} has {counted(count, 'error')}: see mudline lint")
    return FOUND if errors else DONE


def _print_summary(summary: dict[str, Any], view: View) -> None:
    """Print sections and keywords, then a table each of sets, curves, diameters and laws."""
    printer = view.printer()
    most = None if view.verbose else SHOWN_ROWS
    names = unit_names(summary["units"])
    _print_head(printer, summary, names)
    _print_sets(printer, summary["sets"], names)
    if summary["curves"]:
        _print_curves(printer, summary["curves"], names)
    if summary["diameters"]:
        rows = [(shown(entry["diameter"]) or "none", entry["elements"]) for entry in summary["diameters"]]
        left = len(rows) - len(rows[:most])
        note = f"{left} more diameters: -v shows all" if left else ""
        printer.table("External diameters", (headed("diameter", names.length), "elements"), rows[:most], note=note)
    if summary["laws"]:
        _print_laws(printer, summary["laws"], names)
    if summary["bed"]:
        _print_bed(printer, summary["bed"], names)
    if summary["extensions"]:
        blocks = [(f"*{row['keyword']}", row["set"], row["elements"]) for row in summary["extensions"]]
        printer.table("Extensions", ("keyword", "set", "elements"), blocks, left=("keyword", "set"))
    if summary["static_embedment"]:
        _print_static(printer, summary["static_embedment"], names)


def _print_static(printer: Printer, rows: list[dict[str, Any]], names: UnitNames) -> None:
    alike = len({(row["set"], row["law"]) for row in rows}) < len(rows)
    columns = {
        "set": "set",
        **({"element": "first\nelement"} if alike else {}),
        "law": "law",
        "weight": headed("weight", names.line_force),
        "ratio": "ratio",
        "penetration": headed("penetration", names.length),
        "stiffness": "stiffness",
        "extrapolated": "extrapolated",
    }
    cells = [[row[key] for key in columns] for row in rows]
    text = ("set", "law", "extrapolated")
    printer.table("Static embedment", list(columns.values()), cells, left=text, optional=text[-1:])


def _print_head(printer: Printer, summary: dict[str, Any], names: UnitNames) -> None:
    length = f", {shown(summary['length'])} {names.length}".rstrip() + " long" if summary["length"] is not None else ""
    seabed = " and ".join(summary["seabed"]) or "no"
    more = "+" if summary["sets"][0]["open"] else ""  # of ALL, which comes first
    counts = f"{summary['nodes']}{more} nodes, {summary['elements']}{more} elements{length}"
    bed = _bed(summary["floor"])
    head = f"{summary['file']}: {summary['units']} units, {counts}, {seabed} seabed{bed}"
    printer.line((printer.visible(head), "bold"))
    for name in summary["continues"]:
        _print_folded(printer, f"continues {printer.visible(name)}", "  ")
    for section in summary["sections"]:
        keywords = section["keywords"]
        read, partly, kept = (
            _listed(printer, [entry["keyword"] for entry in keywords if (entry["read"], entry["partly"]) == extent])
            for extent in ((True, False), (True, True), (False, False))
        )
        name = "$" + printer.visible(section["name"])
        whole = [each["keyword"] for each in keywords if each["read"] and not each["partly"]]
        subjects = _by_subject(section["name"], whole)
        _print_folded(printer, f"{name}: {read}" if read and len(subjects) < _SEVERAL else name, "  ")
        for subject, about in subjects.items() if len(subjects) >= _SEVERAL else ():
            _print_folded(printer, f"{subject}: {_listed(printer, about)}", "    ")
        if partly:
            _print_folded(printer, f"read in part: {partly}", "    ")
        if kept:
            _print_folded(printer, f"passed through unchanged: {kept}", "    ")
    _print_folded(printer, printer.visible(Coverage(**summary["keywords"]).sentence()), "  ")
    printer.line()


_SEVERAL = 2
"""Subjects of the keywords of a section that are listed one by one."""


def _by_subject(section: str, keywords: list[str]) -> dict[str, list[str]]:
    """The keywords of a section by what they are about, in the order of the subjects."""
    found: dict[str, list[str]] = {}
    for keyword in keywords:
        entry = next(each for each in catalogue.entries(keyword) if section in each.sections)
        found.setdefault(entry.subject, []).append(keyword)
    return {subject: found[subject] for subject in SUBJECTS if subject in found}


def _bed(floor: dict[str, Any]) -> str:
    """The shape of a seabed that is not flat."""
    turned = f", turned by {shown(floor['direction'])} degrees" if floor["direction"] else ""
    if floor["kind"] == "flat":
        return ""
    if floor["kind"] == "sloping":
        return f", sloping {shown(floor['slope'])} degrees{turned}"
    if floor["kind"] == "planes":
        return f", {counted(floor['planes'], 'plane')}"
    points = f"{floor['points']} points" if floor["missing"] is None else "not known"
    source = f" of {floor['file']}" if floor["file"] else ""
    return f", {floor['kind']}{source}: {points}{turned}"


def _listed(printer: Printer, keywords: list[str]) -> str:
    """Names of keywords, each once, with the number of its blocks when there are more."""
    counts = Counter(keywords)
    return ", ".join(
        f"*{printer.visible(name)}" + (f" ({count} blocks)" if count > 1 else "") for name, count in counts.items()
    )


def _print_folded(printer: Printer, text: str, indent: str) -> None:
    for line in wrap(text, printer.width, initial_indent=indent, subsequent_indent="      "):
        printer.line(line)


def _print_sets(printer: Printer, sets: list[dict[str, Any]], names: UnitNames) -> None:
    rows = [(entry["name"], f"{entry['elements']}{'+' * entry['open']}", entry["length"]) for entry in sets]
    note = OPEN if any(entry["open"] for entry in sets) else ""
    columns = ("set", "elements", headed("length", names.length))
    printer.table("Element sets", columns, rows, left=("set",), note=note)


def _print_curves(printer: Printer, curves: list[dict[str, Any]], names: UnitNames) -> None:
    columns = ("curve", "keyword", "points", "ratio", headed("force", names.line_force), "elements")
    rows = [
        (
            entry["name"],
            f"*{entry['keyword']}",
            entry["points"],
            _range(entry["ratios"]),
            _range(entry["forces"]),
            f"{entry['elements']}{'+' * entry['open']}",
        )
        for entry in curves
    ]
    printer.table("Force-embedment curves", columns, rows, left=("curve", "keyword"))


def _range(ends: list[float] | None) -> str:
    return "" if ends is None else f"{shown(ends[0])} to {shown(ends[1])}"


def _print_bed(printer: Printer, bed: list[dict[str, Any]], names: UnitNames) -> None:
    columns = (
        "friction\ncoefficients",
        headed("mobilisation\nlengths", names.length),
        headed("lateral\nstiffness", names.stiffness),
        headed("suction\nstiffness", names.stiffness),
        headed("suction\nzone", names.length),
    )
    rows = [
        (
            row["set"],
            row["elements"],
            _pair(row["friction"]),
            _pair(row["mobilisation"]),
            row["lateral"],
            row["suction"],
            row["extent"],
        )
        for row in bed
    ]
    title = "Friction, lateral resistance, suction"
    printer.table(title, ("set", "elements", *columns), rows, left=("set",), optional=columns)


def _pair(values: list[float | None]) -> str:
    return ", ".join(shown(value) or "-" for value in values) if values != [None, None] else ""


def _print_laws(printer: Printer, laws: list[dict[str, Any]], names: UnitNames) -> None:
    stiffness = headed("stiffness", names.stiffness)
    rows = [[entry[key] for key in ("law", "set", "elements", "stiffness")] for entry in laws]
    columns = ("law", "set", "elements", stiffness)
    printer.table("Normal laws", columns, rows, left=("law", "set"), optional=(stiffness,))
