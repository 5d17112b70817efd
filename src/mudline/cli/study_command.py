"""`mudline study`."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mudline.basics.display import DisplayColumn, DisplayTable
from mudline.basics.files import suffix_of
from mudline.basics.quantities import csv_lines
from mudline.checks.engine import naming_causes
from mudline.cli import DONE, options
from mudline.cli.inputs import GivenDeck, refuses_bad_decks
from mudline.cli.plots import Plot, plot_option
from mudline.cli.streams import emit, emit_json, notify, write_text
from mudline.cli.view import View, tracked
from mudline.model.scene.model import resolve
from mudline.tools.study import PARTS, Study, jump_note, study
from mudline.tools.study.screen import ScreenTable, extremes_sentences, precision_table, stability_table, stages_table

if TYPE_CHECKING:
    from mudline.cli.printing import Printer

_WIDTH = 100
_MOST_NOTES = 3


@options.command("study")
@options.deck
@options.option("--only", multiple=True, type=click.Choice(PARTS), help="Study this part alone; repeatable.")
@plot_option("error against run time, with the deck's own step")
@options.option(
    "-o", "--output", type=options.OUTPUT_FILE, metavar="FILE.json", help="Write the study as JSON into this file."
)
@options.output_format("text", "json", "csv")
@options.stdin_name
@options.units
@options.common
@refuses_bad_decks
def command(
    *,
    deck: str,
    only: tuple[str, ...],
    plot: Plot,
    output: str | None,
    output_format: str,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Measure what accuracy costs on a deck, which steps are stable, and what the deck does not need.

    precision: error against run time of three schemes on the deck's stiffest contacts. stability: critical steps, the
    largest steps at which landings keep their speed, and extreme values. pruning: what the stages of the evaluation
    take, and what those would add that the deck does not have.
    """
    if output is not None and suffix_of(output) != "json":
        raise click.UsageError(f"-o {output}: unknown file format: give a name ending in .json")
    given = GivenDeck(deck, stdin_name, units).load()
    with naming_causes(given):
        scene = resolve(given).require()
    found = study(scene, only or PARTS, draw=plot.path is not None, tracked=lambda parts: tracked(parts, view))
    if plot.path is not None:
        _plot(found, plot, view)
    if output:
        write_text(Path(output), [json.dumps(found.json(), indent=1, ensure_ascii=False, allow_nan=False), "\n"])
        if not view.quiet:
            notify(f"study -> {Path(output).as_posix()}")
    if output_format == "json":
        emit_json(found.json())
    elif output_format == "csv":
        emit(_csv(found.json()))
    elif not (output and view.quiet):
        _print(found, view.printer())
    return DONE


def _plot(found: Study, plot: Plot, view: View) -> None:
    if found.drawn is None or not found.drawn.curves:
        notify("--plot: there is nothing to draw, as no contact of this deck has a motion")
        return
    from mudline.tools.study.picture import study_figure  # noqa: PLC0415 - needs the extra `plot`

    plot.write(lambda _: study_figure(found), view)


def _csv(whole: dict[str, Any]) -> Iterator[str]:
    """The tables of the parts, each under its heading, with an empty line between them."""
    failed = whole["extremes"]["failed"] if whole["extremes"] else None
    tables = [rows for rows in (whole["precision"], whole["stability"], failed, whole["stages"]) if rows]
    for number, rows in enumerate(tables):
        lines = [_flat(row) for row in rows]
        yield from ["\n"] * (number > 0)
        yield from csv_lines(chain([list(lines[0])], (list(line.values()) for line in lines)))


def _flat(row: dict[str, Any]) -> dict[str, Any]:
    """A row without rows inside it."""
    jump = row.pop("without_jump", ...)
    if jump is not ...:
        row |= {f"without_jump_{name}": jump and jump[name] for name in ("step", "deck_line")}
    return row


# ----------------------------------------------------------------------------------------------------------- the screen


def _print(found: Study, printer: Printer) -> None:
    if found.advice.text and not any(found.advice.text in notes for notes in found.notes.values()):
        _paragraph(printer, found.advice.text, "bold")
        printer.line("")
    for part, table in (("precision", _print_precision), ("stability", _print_stability), ("pruning", _print_stages)):
        if part in found.notes and (part != "precision" or found.precision is not None):
            table(found, printer)


def _paragraph(printer: Printer, text: str, style: str = "", indent: str = "") -> None:
    width = min(printer.width, _WIDTH)
    for line in textwrap.wrap(printer.visible(text), width, subsequent_indent=indent, break_on_hyphens=False):
        printer.line((line, style), fold=False)


def _print_table(table: ScreenTable | None, printer: Printer) -> None:
    if table is not None:
        columns = [DisplayColumn(head, at, left=head in table.left) for at, head in enumerate(table.heads)]
        printer.table(DisplayTable(table.title, columns, table.rows, table.note))


def _print_notes(found: Study, part: str, printer: Printer) -> None:
    notes = found.notes[part]
    for note in notes[:_MOST_NOTES]:
        _paragraph(printer, note, "dim")
    if len(notes) > _MOST_NOTES:
        printer.line((f"{len(notes) - _MOST_NOTES} more such reasons", "dim"))
    if notes:
        printer.line("")


def _print_precision(found: Study, printer: Printer) -> None:
    _print_table(precision_table(found), printer)
    _print_notes(found, "precision", printer)


def _print_stability(found: Study, printer: Printer) -> None:
    _print_table(stability_table(found), printer)
    for one in (found.stability or [])[:_MOST_NOTES]:
        if one.row.jump:
            _paragraph(printer, jump_note(found, one.row))
            printer.line("")
    if sentences := extremes_sentences(found):
        _paragraph(printer, sentences[0])
        for failure in sentences[1:]:
            _paragraph(printer, f"  {failure}", "red", indent="    ")
        printer.line("")
    _print_notes(found, "stability", printer)


def _print_stages(found: Study, printer: Printer) -> None:
    if found.stages is not None:
        _print_table(stages_table(found), printer)
        _print_notes(found, "pruning", printer)
