"""`mudline study`."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import cast

import click

from mudline.cli import options
from mudline.cli.exits import DONE, FOUND
from mudline.cli.guard import refuses_bad_decks
from mudline.cli.inputs import load
from mudline.cli.lazy import printing
from mudline.cli.options import View
from mudline.cli.streams import emit
from mudline.cli.terminal import reason, tell
from mudline.scene.build import resolve
from mudline.scene.model import Scene
from mudline.study.report import StudyError, StudyOptions, StudyReport, silent

STUDIES = ("precision", "stability", "pruning")
_EXTRAS = frozenset({"matplotlib", "mpmath", "scipy"})


@click.command("study")
@click.argument("study", type=click.Choice(STUDIES))
@click.argument("deck", required=False, metavar="[DECK]", shell_complete=click.Path().shell_complete)
@click.option("-o", "--output", metavar="DIR", help="Write CSV, JSON and PNG files into this folder.")
@click.option("--full", is_flag=True, help="Finer ladders and more repeats; takes longer than two minutes.")
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
    """Measure how exact, how stable and how costly the numbers of a deck are.

    precision: error against run time of curves, time integration and smoothing. stability: critical steps, energy at
    touchdown, extreme values. pruning: what each feature costs. Without DECK a built-in sample is studied.
    """
    scene = _scene(deck, units, stdin_name)
    telling = silent if view.quiet else lambda message: tell(f"{study}: {message}")
    try:
        report = cast("StudyReport", import_module(f"mudline.study.{study}").run(scene, StudyOptions(full, telling)))
        if output:
            _write(report, Path(output), quiet=view.quiet)
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package not in _EXTRAS:
            raise
        tell(f"this study needs {package}: pip install 'mudline[study]'")
        return FOUND
    except StudyError as error:
        tell(f"{scene.deck.file}: {error}")
        return FOUND
    if output_format == "json":
        emit([report.json()])
    elif output_format == "csv":
        for index, table in enumerate(report.tables):
            emit(["\n"] * (index > 0))
            emit(table.csv())
    elif not (output and view.quiet):
        printing("study").print_report(report, view)
    return DONE


def _scene(deck: str | None, units: str | None, stdin_name: str) -> Scene:
    if deck is None:
        return cast("Scene", import_module("mudline.study.sample").sample_scene())
    return resolve(load(deck, units=units, stdin_name=stdin_name)).require()


def _write(report: StudyReport, folder: Path, *, quiet: bool) -> None:
    try:
        files = report.write(folder)
    except OSError as error:
        raise click.ClickException(f"{folder}: cannot be written: {reason(error)}") from error
    if not quiet:
        tell(f"{len(files)} files -> {folder.as_posix()}")
