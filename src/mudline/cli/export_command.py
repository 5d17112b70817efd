"""Command `mudline export`: the model of a deck for another program, and a table of what does not carry over."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Literal

import click

from mudline.api.commands import export
from mudline.basics.display import DisplayColumn, DisplayTable
from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import STDIN, GivenDeck, takes_deck
from mudline.cli.streams import emit_json, notify, write_text
from mudline.cli.view import View
from mudline.tools.exporting.report import ExportReport

_TARGETS = ("moordyn", "orcaflex")


@options.command("export")
@options.option("--to", "target", type=click.Choice(_TARGETS), required=True, help="Write the input of this program.")
@options.output(required=True, help="Write to this file, and further files next to it.")
@options.flag(
    "--rest-shape", help="Export the resting shape, not the deck's own coordinates; it is also written to OUT-rest.csv."
)
@options.flag("--strict", help="Exit with 1 if anything was approximated or left out.")
@options.output_format("text", "json")
@takes_deck
def command(
    *,
    deck: GivenDeck,
    target: Literal["moordyn", "orcaflex"],
    output: str,
    rest_shape: bool,
    strict: bool,
    output_format: str,
    view: View,
) -> int:
    """Export seabed, line and soil of a deck as the input of another program, and list what does not carry over."""
    path = Path(output)
    if output == STDIN or not path.name:
        raise click.UsageError(f"-o {output}: a model may need several files; give the name of a file")
    read = deck.load()
    files, report, notes = export(read, to=target, name=path.name, rest_shape=rest_shape)
    for note in notes:
        notify(note)
    for name, text in files.items():
        write_text(path.with_name(name), [text])
    view.note(f"{read.file} -> {', '.join(path.with_name(name).as_posix() for name in files)}")
    if output_format == "json":
        entries = [asdict(entry) for entry in report.entries]
        places = [path.with_name(name).as_posix() for name in files]
        emit_json({"target": target, "deck": read.file, "files": places, "exact": report.is_exact, "entries": entries})
    else:
        _print(report, view)
    return FOUND if strict and not report.is_exact else DONE


def _print(report: ExportReport, view: View) -> None:
    """Print the table of keywords that do not carry over."""
    printer = view.printer()
    rows = report.rows()
    carried = len(report.entries) - len(report.lost)
    heads = ("keyword", "line", "status", "in the target", "effect")
    columns = [DisplayColumn(head, at, left=head != "line", whole=head == "status") for at, head in enumerate(heads)]
    note = f"{carried} carried; JSON lists them too"
    if rows:
        printer.table(DisplayTable("What does not carry over", columns, rows, note))
    else:
        printer.line(f"All carries over: {note}")
