"""Command `mudline curves`: the curves of a deck by kind, as evaluated, as rows, tables and texts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import click

from mudline.basics.display import DisplayTable, number, text
from mudline.basics.quantities import csv_lines, labelled, shown
from mudline.basics.units import UNITS, UnitSystem
from mudline.checks.engine import naming_causes
from mudline.cli import DONE, options
from mudline.cli.inputs import GivenDeck, takes_deck
from mudline.cli.plots import Plot, plot_option, write_plot
from mudline.cli.streams import emit, emit_json, notify, refusing
from mudline.cli.view import View
from mudline.model.results.curve_rows import curve_rows, diameters_on, used_curves
from mudline.model.scene.curves import ENDS, OF_CURRENT, OF_SEABED
from mudline.model.scene.model import Scene, resolve

if TYPE_CHECKING:
    from mudline.cli.printing import Printer

_SHOWN_DIAMETERS = 3
_AT = ("ratio", "force", "slope", "segment", "extrapolated")
_KIND = ("kind", "abscissa", "ordinate")
_ENDS = ("from", "to")
_OF_DIAMETER = ("diameter", "depth", "stiffness")
_GOES_ON = "A force-embedment curve continues beyond its first and last point with the slope of its end segment."
_OF_WATER = "without values beyond them and above the surface"
_SOFTENS = "unstable: the curve softens there, and a pipe that is pushed deeper sinks to the next stable embedment"


@options.command("curves")
@options.option(
    "--at",
    "ratios",
    type=float,
    multiple=True,
    metavar="RATIO",
    help="Evaluate the curves at this embedment ratio, or at this value of their abscissa. Repeatable.",
)
@options.option(
    "--weight",
    type=options.ABOVE_ZERO,
    metavar="W",
    help="Find the static embedment under this submerged weight per unit length, in the deck's units.",
)
@plot_option("the curves")
@options.output_format("text", "json", "csv")
@takes_deck
def command(
    *, deck: GivenDeck, ratios: tuple[float, ...], weight: float | None, plot: Plot, output_format: str, view: View
) -> int:
    """Show each curve of a deck as evaluated: sorted, with the slope of every segment, and stiffnesses for the seabed.

    Force-embedment curves come first, then moment-curvature curves, soil springs, current profiles and so on. --weight
    applies to force-embedment curves only. CSV holds one table: the points, or the values for --at or --weight.
    """
    if output_format == "csv" and ratios and weight is not None:
        raise click.UsageError("CSV holds one table: give --at or --weight, not both")
    given = deck.load()
    with naming_causes(given):
        scene = resolve(given).require()
    with refusing(ValueError):
        rows = curve_rows(scene, ratios, weight)
    write_plot(plot, lambda plots: plots.curves.curves_figure(rows, scene.units))
    if output_format == "json":
        emit_json(rows)
    elif output_format == "csv":
        emit(csv_lines(_csv_rows(rows, ratios, weight)))
    elif rows:
        _print_curves(scene, rows, view)
    else:
        notify(f"{scene.deck.file} has no curve")
    return DONE


# ------------------------------------------------------------------------------------------------------------- CSV


def _csv_rows(
    rows: list[dict[str, Any]], ratios: tuple[float, ...], weight: float | None
) -> Iterator[Sequence[object]]:
    """Yield the table of all curves with its heading: values at ratios, static embedments by diameter, or points."""
    if ratios:
        yield ("curve", *_AT, *_KIND)
        yield from ((row["name"], *value.values(), *_kind(row)) for row in rows for value in row["at"])
    elif weight is not None:
        names = (*_AT, "stable", *_OF_DIAMETER)
        yield ("curve", *names)
        yield from ((row["name"], *map(static.get, names)) for row in rows for static in _static(row))
    else:
        yield ("curve", "ratio", "force", "slope", *_KIND)
        for row in rows:
            slopes = [*(segment["slope"] for segment in row["segments"]), None]
            points = zip(row["points"], slopes, strict=True)
            yield from ((row["name"], *point, slope, *_kind(row)) for point, slope in points)


def _kind(row: dict[str, Any]) -> list[str]:
    """Return the kind of a curve, its abscissa (below `ratio`) and its ordinate (below `force`), with units."""
    return [row["kind"], *(labelled(*axis) for axis in zip(row["axes"], row["units"], strict=True))]


def _static(row: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the static embedments of a curve, each with every diameter on it, or with none."""
    none = [dict.fromkeys(_OF_DIAMETER)]
    return [static | each for static in row.get("static", ()) for each in static["stiffness"] or none]


# ---------------------------------------------------------------------------------------------------------- output


def _print_curves(scene: Scene, rows: list[dict[str, Any]], view: View) -> None:
    """Print a table of segments for each curve, with the values for --at and --weight."""
    printer, system = view.printer(), UNITS[scene.units]
    of_seabed = iter(used_curves(scene))  # they come first
    for row in rows:
        drawn, note, beyond = list[float](), "", _OF_WATER if row["kind"] == OF_CURRENT else ENDS[row["ends"]]
        title = f"{row['kind']} {row['name']} (*{row['keyword']}): {len(row['points'])} points, {beyond}"
        if row["kind"] == OF_SEABED:
            index, entry, _ = next(of_seabed)
            sizes = diameters_on(scene, index)
            drawn = sizes if view.verbose or len(sizes) <= _SHOWN_DIAMETERS else [sizes[0], sizes[-1]]
            note = "" if drawn == sizes else f"{len(sizes)} diameters follow this curve: -v shows all"
            used = "" if len(scene.followers(index)) else ", diameters of *GEOMETRIC SETS"
            used = used if sizes else ", not used by an element with a diameter"
            title = f"{'set' if entry.embedment else 'curve'} {row['name']}: {len(row['points'])} points{used}"
        units = [unit if system.known and unit != "-" else "" for unit in row["units"]]
        heads = [(f"{end}\n{axis}", unit) for axis, unit in zip(row["axes"], units, strict=True) for end in _ENDS]
        heads += [("slope", _per(units)), *((f"stiffness\nD={shown(size)}", system.unit("F/L2")) for size in drawn)]
        columns = [number(head, place, unit) for place, (head, unit) in enumerate(heads)]
        points = row["points"]
        segments = [
            (start, end, first, last, segment["slope"], *(segment["slope"] / size for size in drawn))
            for segment, (start, first), (end, last) in zip(row["segments"], points, points[1:], strict=False)
        ]
        printer.table(DisplayTable(title, columns, segments, note))
        _print_values(printer, row, units)
        if "static" in row:
            _print_static(printer, row, system)
    if any(row["kind"] == OF_SEABED for row in rows):
        printer.line((_GOES_ON, "dim"))


def _per(units: Sequence[str]) -> str:
    """Return the unit of a slope."""
    over, value = units
    return f"{value or '1'} per {over}" if over else value


def _print_values(printer: Printer, row: dict[str, Any], units: Sequence[str]) -> None:
    """Print the values of a curve for --at."""
    over, value = row["axes"]
    columns = [
        number(over, "ratio", units[0]),
        number(value, "force", units[1]),
        number("slope", "slope", _per(units)),
        number("segment", "segment"),
        number("extrapolated", "extrapolated"),
    ]
    if row["at"]:
        printer.table(DisplayTable(f"{row['name']} at", columns, row["at"]))


def _print_static(printer: Printer, row: dict[str, Any], system: UnitSystem) -> None:
    embedments = _static(row)
    columns = (
        number("ratio", "ratio"),
        number("diameter", "diameter", system.unit("L")),
        number("depth", "depth", system.unit("L")),
        number("stiffness", "stiffness", system.unit("F/L2")),
        number("extrapolated", "extrapolated"),
        text("equilibrium", lambda embedment: "" if embedment["stable"] else "unstable", optional=True),
    )
    if embedments:
        note = "" if all(embedment["stable"] for embedment in embedments) else _SOFTENS
        printer.table(DisplayTable(f"{row['name']}: static embedment", columns, embedments, note))
    else:
        notify(f"curve {row['name']} never carries this weight")
