"""`mudline study`."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, cast

import click

from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import GivenDeck, refuses_bad_decks
from mudline.cli.streams import emit, notify, notify_missing, reason
from mudline.cli.view import View
from mudline.quantities import headed, shown
from mudline.scene.model import Scene, resolve
from mudline.short_repr import counted
from mudline.study import sample_scene
from mudline.study.report import Cell, StudyError, StudyOptions, StudyReport, StudyTable, silent

if TYPE_CHECKING:
    from mudline.cli.printing import Printer

STUDIES = {"precision": ["scipy.integrate"], "stability": ["mpmath"], "pruning": ["scipy.interpolate"]}
"""The studies, and what each needs of the extra `mudline[study]`."""
_PICTURES = "matplotlib.figure"
_EXTRAS = frozenset({"matplotlib", "mpmath", "scipy"})
_DIGITS = 4


@click.command("study")
@click.argument("study", type=click.Choice(list(STUDIES)))
@click.argument("deck", required=False, metavar="[DECK]", shell_complete=click.Path().shell_complete)
@click.option("-o", "--output", metavar="DIR", help="Write CSV, JSON and PNG files into this folder.")
@click.option("--full", is_flag=True, help="Use finer steps and more repeats; takes longer than two minutes.")
@options.output_format("text", "json", "csv")
@options.stdin_name
@options.units
@options.common
@refuses_bad_decks
def command(
    *,
    study: str,
    deck: str | None,
    output: str | None,
    full: bool,
    output_format: str,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Measure precision, stability and cost of the numbers of a deck.

    precision: error against run time of curves, time integration and smoothing. stability: critical steps, energy at
    touchdown, extreme values. pruning: what each feature costs. Without DECK a built-in sample is studied.
    """
    if not all(map(_is_installed, [*STUDIES[study], *([_PICTURES] if output else [])])):
        return FOUND
    scene = _scene(deck, units, stdin_name)
    progress = silent if view.quiet else lambda message: notify(f"{study}: {message}")
    try:
        report = cast("StudyReport", import_module(f"mudline.study.{study}").run(scene, StudyOptions(full, progress)))
        if output:
            _write(report, Path(output), quiet=view.quiet)
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package not in _EXTRAS:
            raise
        notify_missing("this study", package, "study")
        return FOUND
    except StudyError as error:
        notify(f"{scene.deck.file}: {error}")
        return FOUND
    if output_format == "json":
        emit([report.json()])
    elif output_format == "csv":
        for index, table in enumerate(report.tables):
            emit(["\n"] * (index > 0))
            emit(table.csv())
    elif not (output and view.quiet):
        _print_report(report, view)
    return DONE


def _is_installed(library: str) -> bool:
    """Whether a library can be imported; reports it if not, before a study has taken its time."""
    try:
        import_module(library)
    except ImportError:
        notify_missing("this study", library.partition(".")[0], "study")
        return False
    return True


def _scene(deck: str | None, units: str | None, stdin_name: str) -> Scene:
    if deck is None:
        return sample_scene()
    return resolve(GivenDeck(deck, stdin_name, units).load()).require()


def _write(report: StudyReport, folder: Path, *, quiet: bool) -> None:
    try:
        files = report.write(folder)
    except OSError as error:
        raise click.ClickException(f"{folder}: cannot be written: {reason(error)}") from error
    if not quiet:
        notify(f"{counted(len(files), 'file')} -> {folder.as_posix()}")


def _print_report(report: StudyReport, view: View) -> None:
    """Print short tables, with -v all of them; then failures, notes and the machine."""
    printer = view.printer()
    left_out = 0
    for table in report.tables:
        if table.brief or view.verbose:
            _print_table(printer, table)
        else:
            left_out += 1
    if report.omissions:
        rows = [tuple(omission) for omission in report.omissions]
        printer.table("Failed or left out", ("what", "reason"), rows, left=("what", "reason"))
    for note in report.notes:
        printer.line(printer.visible(note))
    if left_out:
        printer.line(f"{left_out} long tables are not shown here: -v, or -o DIR for files")
    if not view.quiet:
        words = ", ".join(f"{name} {value}" for name, value in report.machine.items())
        printer.line((printer.visible(words), "dim"))


def _print_table(printer: Printer, table: StudyTable) -> None:
    columns = [headed(column.name, column.unit) for column in table.columns]
    texts = [
        heading
        for index, heading in enumerate(columns)
        if table.rows and all(isinstance(row[index], str) for row in table.rows)
    ]
    rows = [tuple(map(_cell, row)) for row in table.rows]
    printer.table(table.title, columns, rows, left=texts)


def _cell(cell: Cell) -> str:
    if isinstance(cell, bool):
        return "yes" if cell else "no"
    if isinstance(cell, float):
        return shown(cell, _DIGITS)
    return "" if cell is None else str(cell)
