"""Studies on the terminal."""

from __future__ import annotations

from rich.console import Console
from rich.text import Text

from mudline.cli.console import console
from mudline.cli.options import View
from mudline.cli.tables import print_table
from mudline.linting.output.visible import visible
from mudline.results.quantities import headed, shown
from mudline.study.report import Cell, StudyReport, StudyTable

_DIGITS = 4


def print_report(report: StudyReport, view: View) -> None:
    """Short tables, with -v all of them; then failures, notes and the machine."""
    printer = console(view.color)
    left_out = 0
    for table in report.tables:
        if table.brief or view.verbose:
            _print(printer, table)
        else:
            left_out += 1
    if report.omissions:
        rows = [tuple(omission) for omission in report.omissions]
        print_table(printer, "Failed or left out", ("what", "reason"), rows, left=("what", "reason"))
    for note in report.notes:
        printer.print(Text(visible(note, printer.encoding)), soft_wrap=False)
    if left_out:
        printer.print(Text(f"{left_out} long tables are not shown here: -v, or -o DIR for files"), soft_wrap=False)
    if not view.quiet:
        words = ", ".join(f"{name} {value}" for name, value in report.machine.items())
        printer.print(Text(visible(words, printer.encoding), style="dim"), soft_wrap=False)


def _print(printer: Console, table: StudyTable) -> None:
    columns = [headed(column.name, column.unit) for column in table.columns]
    texts = [
        heading
        for index, heading in enumerate(columns)
        if table.rows and all(isinstance(row[index], str) for row in table.rows)
    ]
    rows = [tuple(map(_cell, row)) for row in table.rows]
    print_table(printer, table.title, columns, rows, left=texts)


def _cell(cell: Cell) -> str:
    if isinstance(cell, bool):
        return "yes" if cell else "no"
    if isinstance(cell, float):
        return shown(cell, _DIGITS)
    return "" if cell is None else str(cell)
