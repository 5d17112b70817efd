"""`mudline study`."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import ModuleType, TracebackType
from typing import TYPE_CHECKING, Self, cast

import click

from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import GivenDeck, refuses_bad_decks
from mudline.cli.streams import emit, notify, notify_missing, reason
from mudline.cli.view import View, wants_bar
from mudline.quantities import headed, shown
from mudline.scene.model import Scene, resolve
from mudline.short_repr import counted
from mudline.study import sample_scene
from mudline.study.report import Cell, StudyError, StudyOptions, StudyReport, StudyTable

if TYPE_CHECKING:
    from mudline.cli.printing import Printer
    from mudline.study.running import Study

STUDIES = {"precision": ["scipy.integrate"], "stability": ["mpmath"], "pruning": ["scipy.interpolate"]}
"""The studies, and what each needs of the extra `mudline[study]`."""
_PICTURES = "matplotlib.figure"
_EXTRAS = frozenset({"matplotlib", "mpmath", "scipy"})
_DIGITS = 4


@options.command("study")
@click.argument("study", type=click.Choice(list(STUDIES)))
@click.argument("deck", required=False, metavar="[DECK]", shell_complete=click.Path().shell_complete)
@click.option("-o", "--output", metavar="DIR", help="Write the page, CSV, JSON and PNG files into this folder.")
@click.option(
    "--only", metavar="PART[,PART]", help="Run these parts of the study alone; a name that it lacks lists them."
)
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
    only: str | None,
    full: bool,
    output_format: str,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Measure precision, stability and cost of the numbers of a deck.

    precision: error against run time of curves, time integration and smoothing. stability: critical steps, energy at
    touchdown, extreme values. pruning: what each feature costs. Without DECK a built-in sample is studied.

    With -o, what is finished is written at once, and an interrupted study goes on there when it is run again.
    """
    if not all(map(_is_installed, [*STUDIES[study], *([_PICTURES] if output else [])])):
        return FOUND
    module = import_module(f"mudline.study.{study}")
    parts = _parts(only, cast("Study", module.STUDY))
    scene = _scene(deck, units, stdin_name)
    report = _report(module, scene, StudyOptions(full, only=parts, folder=Path(output) if output else None), view)
    if report is None:
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


def _parts(only: str | None, study: Study) -> tuple[str, ...]:
    """The parts that the user names; ends the command for a name that the study does not have."""
    names = tuple(dict.fromkeys(name.strip() for name in only.split(","))) if only is not None else ()
    if unknown := study.unknown(names):
        known = ", ".join(part.name for part in study.parts)
        raise click.UsageError(f"{study.name} has no part {unknown[0]!r}: its parts are {known}")
    return names


class _Shown:
    """What a study is doing: a bar with the time that is left on a terminal, else a line for each thing."""

    def __init__(self, study: str, view: View, folder: Path | None) -> None:
        self._study, self._view, self._folder = study, view, folder
        self._bar = view.bar(1.0) if wants_bar(view) else None
        self._words, self._share = "", 0.0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar:
            self._bar.erase()
        if self._folder and isinstance(error, KeyboardInterrupt):
            notify(f"interrupted: the same command goes on with what is finished in {self._folder.as_posix()}")

    def say(self, words: str) -> None:
        """Show what comes next."""
        self._words = words
        if self._bar:
            self._bar.draw(self._share, words)
        elif not self._view.quiet:
            notify(f"{self._study}: {words}")

    def advance(self, share: float) -> None:
        """Show how far the study is, 0 to 1."""
        self._share = share
        if self._bar:
            self._bar.draw(share, self._words)


def _report(module: ModuleType, scene: Scene, wanted: StudyOptions, view: View) -> StudyReport | None:
    """Run the study and write its files; None where it cannot be made, which is reported."""
    folder = wanted.folder
    try:
        with _Shown(module.STUDY.name, view, folder) as shown_progress:
            wanted = replace(wanted, progress=shown_progress.say, advance=shown_progress.advance)
            report = cast("StudyReport", module.run(scene, wanted))
        if folder:
            files = report.write(folder)
            if not view.quiet:
                notify(f"{counted(len(files), 'file')} -> {folder.as_posix()}")
    except OSError as error:
        if not folder:
            raise
        raise click.ClickException(f"{folder}: cannot be written: {reason(error)}") from error
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package not in _EXTRAS:
            raise
        notify_missing("this study", package, "study")
    except StudyError as error:
        notify(f"{scene.deck.file}: {error}")
    else:
        return report
    return None


def _print_report(report: StudyReport, view: View) -> None:
    """Print short tables, with -v all of them; then failures, notes and the machine."""
    printer = view.printer()
    if report.advice:
        printer.line(printer.visible(report.advice))
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
