"""`mudline curves`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

from mudline.cli import options
from mudline.cli.exits import DONE, FOUND
from mudline.cli.guard import refuses_bad_decks
from mudline.cli.inputs import load
from mudline.cli.lazy import drawing, printing
from mudline.cli.options import View
from mudline.cli.streams import emit
from mudline.cli.terminal import tell
from mudline.cli.writing import writing
from mudline.linting.output.visible import visible
from mudline.results.curves import curve_rows, point_table, static_table, value_table
from mudline.results.quantities import csv_lines
from mudline.scene.build import resolve
from mudline.scene.model import Scene


@click.command("curves")
@options.deck
@click.option(
    "--at", "ratios", type=float, multiple=True, metavar="RATIO", help="Value at an embedment ratio; repeatable."
)
@click.option(
    "--weight",
    type=float,
    metavar="W",
    help="Static embedment under a submerged weight per unit length, in the deck's units.",
)
@click.option("--plot", "picture", metavar="FILE.png|svg", help="Draw the curves (needs the extra mudline[plot]).")
@options.output_format("text", "json", "csv")
@options.stdin_name
@options.units
@options.common
@refuses_bad_decks
def command(
    *,
    deck: str,
    ratios: tuple[float, ...],
    weight: float | None,
    picture: str | None,
    output_format: str,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Show each force-embedment curve sorted, with the slope of every segment and the stiffness it gives.

    CSV holds one table: the points, or what --at or --weight ask for.
    """
    if output_format == "csv" and ratios and weight is not None:
        raise click.UsageError("CSV holds one table: give --at or --weight, not both")
    if picture and _picture_form(picture) not in {"png", "svg"}:
        raise click.UsageError(f"{picture}: a plot is a .png or a .svg")
    scene = resolve(load(deck, units=units, stdin_name=stdin_name)).require()
    try:
        rows = curve_rows(scene, ratios, weight)
    except ValueError as error:
        raise click.UsageError(str(error)) from error
    if picture and not _plot(scene, rows, picture):
        return FOUND
    if output_format == "json":
        emit([json.dumps(rows, indent=1, ensure_ascii=False, allow_nan=False), "\n"])
    elif output_format == "csv":
        emit(csv_lines(value_table(rows) if ratios else point_table(rows) if weight is None else static_table(rows)))
    elif rows:
        printing("curves").print_curves(scene, rows, view)
    else:
        tell(f"{scene.deck.file} has no force-embedment curve")
    return DONE


def _picture_form(picture: str) -> str:
    return Path(picture).suffix.lower().removeprefix(".")


def _plot(scene: Scene, rows: list[dict[str, Any]], picture: str) -> bool:
    try:
        draw = drawing("curve").draw
    except ImportError:
        tell("--plot needs matplotlib: pip install mudline[plot]")
        return False
    named = [{**row, "name": visible(row["name"])} for row in rows]
    with writing(Path(picture)) as stream:
        draw(named, scene.units, _picture_form(picture), stream)
    return True
