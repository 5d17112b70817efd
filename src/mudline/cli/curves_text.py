"""Force-embedment curves on the terminal."""

from __future__ import annotations

from typing import Any

from rich.console import Console
from rich.text import Text

from mudline.cli.console import console
from mudline.cli.options import View
from mudline.cli.tables import print_table
from mudline.cli.terminal import tell
from mudline.results.curves import diameters, used_curves
from mudline.results.quantities import headed, shown, unit_names
from mudline.scene.model import Scene

_MOST_DIAMETERS = 3
_GOES_ON = "Below its first and above its last point a curve goes on with the slope of its end segment."


def print_curves(scene: Scene, rows: list[dict[str, Any]], view: View) -> None:
    """A table of segments for each curve, with what was asked of it."""
    printer = console(view.color)
    names = unit_names(scene.units)
    force, slope = headed("force", names.line_force), headed("slope", names.line_force)
    stiffness = headed("stiffness", names.stiffness)
    for (index, entry, _), row in zip(used_curves(scene), rows, strict=True):
        sizes = diameters(scene, index)
        drawn = sizes if view.verbose or len(sizes) <= _MOST_DIAMETERS else [sizes[0], sizes[-1]]
        columns = (
            "from\nratio",
            "to\nratio",
            headed("from\nforce", names.line_force),
            headed("to\nforce", names.line_force),
            slope,
            *(headed(f"stiffness\nD={shown(size)}", names.stiffness) for size in drawn),
        )
        note = "" if drawn == sizes else f"{len(sizes)} diameters follow this curve: -v shows all"
        print_table(printer, _title(row, sizes, embedment=entry.embedment), columns, _segments(row, drawn), note=note)
        if row["at"]:
            columns = ("ratio", force, slope, "segment", "extrapolated")
            print_table(printer, f"{row['name']} at", columns, [_at(value) for value in row["at"]])
        if "static" in row:
            columns = (
                "ratio",
                headed("diameter", names.length),
                headed("depth", names.length),
                stiffness,
                "extrapolated",
            )
            _print_static(printer, row, columns)
    printer.print(Text(_GOES_ON, style="dim"), soft_wrap=False)


def _title(row: dict[str, Any], sizes: list[float], *, embedment: bool) -> str:
    what = "set" if embedment else "curve"
    used = "" if sizes else ", not used by an element with a diameter"
    return f"{what} {row['name']}: {len(row['points'])} points{used}"


def _segments(row: dict[str, Any], sizes: list[float]) -> list[tuple[str, ...]]:
    forces = [force for _, force in row["points"]]
    return [
        (
            shown(segment["from"]),
            shown(segment["to"]),
            shown(forces[i]),
            shown(forces[i + 1]),
            shown(segment["slope"]),
            *(shown(segment["slope"] / size) for size in sizes),
        )
        for i, segment in enumerate(row["segments"])
    ]


def _at(value: dict[str, Any]) -> tuple[str, ...]:
    numbers = (shown(value["ratio"]), shown(value["force"]), shown(value["slope"]))
    return (*numbers, str(value["segment"]), value["extrapolated"] or "")


def _print_static(printer: Console, row: dict[str, Any], columns: tuple[str, ...]) -> None:
    if not row["static"]:
        tell(f"curve {row['name']} never carries this weight")
        return
    rows: list[tuple[str, ...]] = []
    for static in row["static"]:
        ratio, outside = shown(static["ratio"]), static["extrapolated"] or ""
        rows += [
            (ratio, shown(each["diameter"]), shown(each["depth"]), shown(each["stiffness"]), outside)
            for each in static["stiffness"]
        ] or [(ratio, "", "", "", outside)]
    print_table(printer, f"{row['name']}: static embedment", columns, rows)
