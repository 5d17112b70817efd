"""`mudline curves`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import load, refuses_bad_decks
from mudline.cli.options import View
from mudline.cli.streams import emit, emit_json, notify, notify_missing, writing
from mudline.linting.output import visible
from mudline.results.curves import curve_rows, diameters, point_table, static_table, used_curves, value_table
from mudline.results.quantities import UnitNames, csv_lines, headed, shown, unit_names
from mudline.scene.model import Scene, resolve

if TYPE_CHECKING:
    from mudline.cli.printing import Printer

_MOST_DIAMETERS = 3
_AT = ("ratio", "force", "slope", "segment", "extrapolated")
_GOES_ON = "Below its first and above its last point a curve goes on with the slope of its end segment."


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
    """Show each force-embedment curve as evaluated: sorted, with slope and stiffness of every segment.

    CSV holds one table: the points, or the values for --at or --weight.
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
        emit_json(rows)
    elif output_format == "csv":
        emit(csv_lines(value_table(rows) if ratios else point_table(rows) if weight is None else static_table(rows)))
    elif rows:
        _print_curves(scene, rows, view)
    else:
        notify(f"{scene.deck.file} has no force-embedment curve")
    return DONE


def _picture_form(picture: str) -> str:
    return Path(picture).suffix.lower().removeprefix(".")


def _plot(scene: Scene, rows: list[dict[str, Any]], picture: str) -> bool:
    try:
        from mudline.results.curve_plot import draw  # noqa: PLC0415 - needs the extra `plot`
    except ImportError:
        notify_missing("--plot", "matplotlib", "plot")
        return False
    named = [{**row, "name": visible(row["name"])} for row in rows]
    with writing(Path(picture)) as stream:
        draw(named, scene.units, _picture_form(picture), stream)
    return True


def _print_curves(scene: Scene, rows: list[dict[str, Any]], view: View) -> None:
    """Print a table of segments for each curve, with the values for --at and --weight."""
    printer = view.printer()
    names = unit_names(scene.units)
    force, slope = headed("force", names.line_force), headed("slope", names.line_force)
    ends = ("from\nratio", "to\nratio", *(headed(f"{end}\nforce", names.line_force) for end in ("from", "to")))
    for (index, entry, _), row in zip(used_curves(scene), rows, strict=True):
        sizes = diameters(scene, index)
        drawn = sizes if view.verbose or len(sizes) <= _MOST_DIAMETERS else [sizes[0], sizes[-1]]
        stiffnesses = (headed(f"stiffness\nD={shown(size)}", names.stiffness) for size in drawn)
        note = "" if drawn == sizes else f"{len(sizes)} diameters follow this curve: -v shows all"
        title = _title(row, sizes, embedment=entry.embedment)
        printer.table(title, (*ends, slope, *stiffnesses), _segments(row, drawn), note=note)
        if row["at"]:
            values = [
                [value[key] for key in ("ratio", "force", "slope", "segment", "extrapolated")] for value in row["at"]
            ]
            printer.table(f"{row['name']} at", ("ratio", force, slope, "segment", "extrapolated"), values)
        if "static" in row:
            _print_static(printer, row, names)
    printer.line((_GOES_ON, "dim"))


def _title(row: dict[str, Any], sizes: list[float], *, embedment: bool) -> str:
    what = "set" if embedment else "curve"
    used = "" if sizes else ", not used by an element with a diameter"
    return f"{what} {row['name']}: {len(row['points'])} points{used}"


def _segments(row: dict[str, Any], sizes: list[float]) -> list[tuple[float, ...]]:
    forces = [force for _, force in row["points"]]
    return [
        (one["from"], one["to"], forces[i], forces[i + 1], one["slope"], *(one["slope"] / size for size in sizes))
        for i, one in enumerate(row["segments"])
    ]


def _print_static(printer: Printer, row: dict[str, Any], names: UnitNames) -> None:
    if not row["static"]:
        notify(f"curve {row['name']} never carries this weight")
        return
    diameter, depth = headed("diameter", names.length), headed("depth", names.length)
    columns = ("ratio", diameter, depth, headed("stiffness", names.stiffness), "extrapolated")
    rows = [
        (static["ratio"], each["diameter"], each["depth"], each["stiffness"], static["extrapolated"])
        for static in row["static"]
        for each in static["stiffness"] or [dict.fromkeys(("diameter", "depth", "stiffness"))]
    ]
    printer.table(f"{row['name']}: static embedment", columns, rows)
