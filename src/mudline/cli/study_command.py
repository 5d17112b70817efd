"""Command `mudline study`."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mudline.api.commands import study
from mudline.basics.files import suffix_of
from mudline.basics.quantities import csv_lines
from mudline.cli import DONE, options
from mudline.cli.inputs import GivenDeck, takes_deck
from mudline.cli.options import ABOVE_ZERO
from mudline.cli.plots import Plot, plot_option, write_plot
from mudline.cli.streams import emit, emit_json, notify
from mudline.cli.view import View, tracked
from mudline.tools.touchdown_study.screen import TABLES, description, sentences
from mudline.tools.touchdown_study.study import PARTS, Study

if TYPE_CHECKING:
    from mudline.cli.printing import Printer

_WIDTH = 110


@options.command("study")
@options.option("--only", multiple=True, type=click.Choice(PARTS), help="Study only this part. Repeatable.")
@options.option("--heave", type=ABOVE_ZERO, metavar="A", help="Set the heave amplitude of the hang-off, without surge.")
@options.option("--period", type=ABOVE_ZERO, metavar="T", help="Set the period of the hang-off's motion.")
@plot_option("error against run time, with the deck's own step")
@options.output(metavar="FILE.json", help="Write the study as JSON into this file.")
@options.output_format("text", "json", "csv")
@takes_deck
def command(
    *,
    deck: GivenDeck,
    only: tuple[str, ...],
    heave: float | None,
    period: float | None,
    plot: Plot,
    output: str | None,
    output_format: str,
    view: View,
) -> int:
    """Study the touchdown zone of a deck: time step, and convergence of a solver on its soil.

    accuracy: error against run time of the deck's own time integration, while the touchdown zone is laid down and
    lifted as in its waves. stability: stiffer and softer soils, curves that fall or jump, friction. pruning: run time
    of the stages of the evaluation, and of stages that the deck does not need.
    """
    if output is not None and suffix_of(output) != "json":
        raise click.UsageError(f"-o {output}: unknown file format: give a name ending in .json")
    result = study(deck.load(), only=only, heave=heave, period=period, tracked=lambda parts: tracked(parts, view))
    if plot is not None and not result.drawable:
        notify("--plot: there is nothing to draw, as no step of this deck was measured")
    else:
        write_plot(plot, lambda _: result.figure(), view)
    if output:
        emit_json(result.json(), output)
        view.note(f"study -> {Path(output).as_posix()}")
    if output_format == "json":
        emit_json(result.json())
    elif output_format == "csv":
        emit(_csv(result.json()))
    elif not (output and view.quiet):
        _print(result, view.printer())
    return DONE


def _csv(whole: dict[str, Any]) -> Iterator[str]:
    """Yield the tables of the parts, each with its heading, and an empty line between tables."""
    tables = [rows for rows in (whole["steps"], whole["extremes"], whole["friction"], whole["stages"]) if rows]
    for number, rows in enumerate(tables):
        lines = [_flat(row) for row in rows]
        yield from ["\n"] * (number > 0)
        yield from csv_lines(chain([list(lines[0])], (list(line.values()) for line in lines)))


def _flat(row: dict[str, Any]) -> dict[str, Any]:
    """Return a row without rows or pairs inside it."""
    flat: dict[str, Any] = {}
    for name, value in row.items():
        if name == "touchdown":
            flat |= dict(zip(("touchdown_from", "touchdown_to"), value or (None, None), strict=True))
        elif isinstance(value, dict):
            flat |= {f"{name}_{inner}": each for inner, each in value.items()}
        else:
            flat[name] = value
    return flat


# ----------------------------------------------------------------------------------------------------------- the screen


def _print(result: Study, printer: Printer) -> None:
    for text, style in ((result.advice.text, "bold"), (description(result), "")):
        if text:
            _paragraph(printer, text, style)
            printer.line("")
    for part in result.parts:
        if table := TABLES[part](result):
            printer.table(table)
        remarks = sentences(result, part)
        for text in remarks:
            _paragraph(printer, text, "dim")
        if remarks:
            printer.line("")


def _paragraph(printer: Printer, text: str, style: str = "") -> None:
    width = min(printer.width, _WIDTH)
    for line in textwrap.wrap(printer.visible(text), width, break_on_hyphens=False):
        printer.line((line, style), fold=False)
