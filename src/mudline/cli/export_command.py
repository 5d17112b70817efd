"""`mudline export`: the model of a deck for another program, and the table of what does not carry over."""

from __future__ import annotations

from dataclasses import asdict
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

import click
import numpy as np

from mudline.basics.display import DisplayColumn, DisplayTable
from mudline.basics.quantities import csv_lines
from mudline.checks.engine import naming_causes
from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import STDIN, GivenDeck, takes_deck
from mudline.cli.streams import emit_json, notify, write_text
from mudline.cli.view import View
from mudline.model.scene.model import Scene, resolve
from mudline.model.scene.numbering import Floats
from mudline.tools.exporting.line_model import build

if TYPE_CHECKING:
    from mudline.tools.exporting.report import Report

_TARGETS = ("moordyn", "orcaflex")


@options.command("export")
@options.option("--to", "target", type=click.Choice(_TARGETS), required=True, help="Write the input of this program.")
@options.option(
    "-o",
    "--output",
    required=True,
    type=options.OUTPUT_FILE,
    metavar="OUT",
    help="Write to this file, and others beside it.",
)
@options.flag(
    "--rest-shape", help="Export the resting shape, not the deck's own coordinates; it is written to OUT-rest.csv."
)
@options.flag("--strict", help="Exit with 1 if anything was approximated or left out.")
@options.output_format("text", "json")
@takes_deck
def command(
    *,
    deck: GivenDeck,
    target: str,
    output: str,
    rest_shape: bool,
    strict: bool,
    output_format: str,
    view: View,
) -> int:
    """Export seabed, line and soil of a deck as the input of another program, and list what does not carry over."""
    path = Path(output)
    if output == STDIN:
        raise click.UsageError("-o -: a model may need several files; give the name of a file")
    read = deck.load()
    with naming_causes(read):
        scene = resolve(read).require_evaluable()
    model = build(scene, _at_rest(scene) if rest_shape else None)
    files = import_module(f"mudline.tools.exporting.{target}").write(model, path.name)
    if rest_shape:
        rows = np.column_stack([scene.node_ids.astype(np.int64), model.places])[model.line_nodes()].tolist()
        lines = csv_lines([("node", "x (m)", "y (m)", "z (m)"), *((int(row[0]), *row[1:]) for row in rows)])
        files = {**files, f"{path.stem}-rest.csv": "".join(lines)}
    for name, text in files.items():
        write_text(path.with_name(name), [text])
    if not view.quiet:
        notify(f"{read.file} -> {', '.join(path.with_name(name).as_posix() for name in files)}")
    if output_format == "json":
        entries = [asdict(entry) for entry in model.report.entries]
        places = [path.with_name(name).as_posix() for name in files]
        emit_json(
            {"target": target, "deck": read.file, "files": places, "exact": model.report.is_exact, "entries": entries}
        )
    else:
        _print(model.report, view)
    return FOUND if strict and not model.report.is_exact else DONE


def _at_rest(scene: Scene) -> Floats:
    """The positions (n, 3) of the resting shape; those of the deck for lines that have none."""
    from mudline.tools.touchdown_study.rest_shape import rest_shape  # noqa: PLC0415 - few runs ask for it

    found = rest_shape(scene)
    for sentence in found.sentences(scene.units):
        notify(sentence)
    return np.where(found.positions.present[:, None], found.positions.values[0], scene.coordinates)


def _print(report: Report, view: View) -> None:
    """The table of what does not carry over."""
    printer = view.printer()
    rows = report.rows()
    carried = len(report.entries) - len(report.lost)
    heads = ("keyword", "line", "status", "in the target", "effect")
    columns = [DisplayColumn(one, at, left=one != "line", whole=one == "status") for at, one in enumerate(heads)]
    note = f"{carried} carried; JSON lists them too"
    if rows:
        printer.table(DisplayTable("What does not carry over", columns, rows, note))
    else:
        printer.line(f"All carries over: {note}")
