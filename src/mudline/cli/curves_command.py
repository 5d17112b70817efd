"""`mudline curves`."""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path
from typing import Any

import click

from mudline.cli import options
from mudline.cli.exits import DONE, FOUND
from mudline.cli.guard import refuses_bad_decks
from mudline.cli.inputs import load
from mudline.cli.lazy import drawing, printing
from mudline.cli.options import View
from mudline.cli.terminal import tell
from mudline.cli.writing import write
from mudline.results.curves import curve_rows
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
    units: str | None,
    view: View,
) -> int:
    """Show each force-embedment curve sorted, with the slope of every segment and the stiffness it gives."""
    scene = resolve(load(deck, units=units)).require()
    try:
        rows = curve_rows(scene, ratios, weight)
    except ValueError as error:
        raise click.UsageError(str(error)) from error
    if output_format == "json":
        click.echo(json.dumps(rows, indent=1, ensure_ascii=False, allow_nan=False))
    elif output_format == "csv":
        _csv(rows)
    elif not rows:
        tell(f"{scene.deck.file} has no force-embedment curve")
    else:
        printing("curves").print_curves(scene, rows, view.color)
    if picture:
        return _plot(scene, rows, Path(picture))
    return DONE


def _csv(rows: list[dict[str, Any]]) -> None:
    """The points and the segments behind them; with --at or --weight nothing more, as a table has one kind of row."""
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(("curve", "ratio", "force", "slope"))
    for row in rows:
        slopes = [repr(segment["slope"]) for segment in row["segments"]]
        for (ratio, force), slope in zip(row["points"], [*slopes, ""], strict=True):
            writer.writerow((row["name"], repr(ratio), repr(force), slope))


def _plot(scene: Scene, rows: list[dict[str, Any]], path: Path) -> int:
    try:
        draw = drawing("curve").draw
    except ImportError:
        tell("--plot needs matplotlib: pip install mudline[plot]")
        return FOUND
    if path.suffix.lower() not in {".png", ".svg"}:
        raise click.UsageError(f"{path}: a plot is a .png or a .svg")
    write(path, draw(rows, scene.units, path.suffix.lower().removeprefix(".")))
    return DONE
