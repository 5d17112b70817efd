"""Command `mudline show`."""

from __future__ import annotations

from collections import Counter
from functools import partial
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import click

from mudline.api.commands import show
from mudline.basics.quantities import shown
from mudline.basics.short_repr import counted
from mudline.basics.units import UNITS
from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import GivenDeck, require_text, takes_deck
from mudline.cli.result_files import require_library, write_tables
from mudline.cli.streams import emit, emit_json, notify
from mudline.cli.view import View
from mudline.language.diagnostics import Coverage
from mudline.language.keywords import catalogue
from mudline.language.keywords.values import SUBJECTS
from mudline.model.results.forms.text import text_writer
from mudline.model.results.summary_tables import sheet_data, sheet_tables, tables_of

if TYPE_CHECKING:
    from mudline.cli.printing import Printer


@options.command("show")
@options.flag("--sheet", help="Show only the sheet: a row for each run of elements with the same properties.")
@options.output(group=options.OUTPUT, metavar="FILE", help="Write the sheet: .csv, .json, .xlsx.")
@options.output_format("text", "json", "csv", "xlsx")
@takes_deck
def command(*, deck: GivenDeck, sheet: bool, output: str | None, output_format: str, view: View) -> int:
    """Summarise a deck: sections, keywords, sets, curves, diameters, laws, and the sheet of its elements.

    CSV and workbooks hold the sheet; a workbook needs -o. A deck with errors is shown as far as it can be read; the
    exit code is then 1.
    """
    form = _form(output, output_format)
    if form == "xlsx":
        require_library(form)
    summary, elements, errors = show(require_text(deck.load()))
    units = summary["units"]
    if output is not None:
        write_tables(sheet_data(elements, units), Path(output))
    elif form == "csv" or (form == "json" and sheet):
        sheet_data(elements, units).write(partial(text_writer, form, writes={"sheet": emit}))
    elif form == "json":
        emit_json(summary)
    else:
        printer, of_sheet = view.printer(), sheet_tables(elements)
        if not sheet:
            _print_head(printer, summary)
        elif not of_sheet:
            notify(f"{summary['file']}: the deck has no elements to list in a sheet")
        tables = [] if sheet else tables_of(summary, view.most)
        for table in (*tables, *(each.first(view.most) for each in of_sheet)):
            printer.table(table)
    for file, count in Counter(error.file for error in errors).items():
        notify(f"{file} has {counted(count, 'error')}: see mudline lint")
    return FOUND if errors else DONE


def _form(output: str | None, output_format: str) -> str:
    """Return the form to write or print: that of the file, if there is one."""
    if output is None:
        if output_format == "xlsx":
            raise click.UsageError("--output-format xlsx: give the file of the workbook with -o FILE.xlsx")
        return output_format
    form = options.form_of_file(output, ("csv", "json", "xlsx"))
    if output_format not in ("text", form):
        raise click.UsageError(f"{output} is not {output_format}: give a .{output_format} file, or no format")
    return form


def _print_head(printer: Printer, summary: dict[str, Any]) -> None:
    """Print counts, sections and keywords."""
    unit = UNITS[summary["units"]].behind("L")
    length = f", {shown(summary['length'])}{unit} long" if summary["length"] is not None else ""
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
"""Number of subjects from which on the keywords of a section are listed by subject."""


def _by_subject(section: str, keywords: list[str]) -> dict[str, list[str]]:
    """Return the keywords of a section by subject, in the order of the subjects."""
    by_subject: dict[str, list[str]] = {}
    for keyword in keywords:
        entry = next(each for each in catalogue.entries(keyword) if section in each.sections)
        by_subject.setdefault(entry.subject, []).append(keyword)
    return {subject: by_subject[subject] for subject in SUBJECTS if subject in by_subject}


def _bed(floor: dict[str, Any]) -> str:
    """Return the shape of a seabed that is not flat, in words."""
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
    """Return each keyword once, with the number of its blocks if there are several."""
    counts = Counter(keywords)
    return ", ".join(
        f"*{printer.visible(name)}" + (f" ({count} blocks)" if count > 1 else "") for name, count in counts.items()
    )


def _print_folded(printer: Printer, text: str, indent: str) -> None:
    for line in wrap(text, printer.width, initial_indent=indent, subsequent_indent="      "):
        printer.line(line)
