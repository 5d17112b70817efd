"""Force-embedment curves on the terminal."""

from __future__ import annotations

from typing import Any

from mudline.cli.console import console
from mudline.cli.tables import table
from mudline.cli.terminal import tell
from mudline.results.curves import diameters, used_curves
from mudline.results.numbers import shown
from mudline.scene.model import Scene


def print_curves(scene: Scene, rows: list[dict[str, Any]], color: str) -> None:
    """A table of segments for each curve, with what was asked of it."""
    printer = console(color)
    for (index, entry, _), row in zip(used_curves(scene), rows, strict=True):
        sizes = diameters(scene, index)
        columns = (
            "from ratio",
            "to ratio",
            "from force",
            "to force",
            "slope",
            *(f"stiffness D={shown(d)}" for d in sizes),
        )
        printer.print(table(_title(row, sizes, embedment=entry.embedment), columns, _segments(row, sizes)))
        if row["at"]:
            columns = ("ratio", "force", "slope", "segment", "extrapolated")
            printer.print(table("At", columns, [_at(value) for value in row["at"]]))
        for static in row.get("static", []):
            printer.print(table("Static embedment", *_static(static)))
        if "static" in row and not row["static"]:
            tell(f"curve {row['name']} never carries this weight")


def _title(row: dict[str, Any], sizes: list[float], *, embedment: bool) -> str:
    what = "set" if embedment else "curve"
    used = "" if sizes else ", not used by an element with a diameter"
    return f"{what} {row['name']}: {len(row['points'])} points{used}"


def _segments(row: dict[str, Any], sizes: list[float]) -> list[tuple[str, ...]]:
    """A row a segment; the end slopes hold outside as well."""
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


def _static(static: dict[str, Any]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    columns = ("ratio", "diameter", "depth", "stiffness", "extrapolated")
    ratio, outside = shown(static["ratio"]), str(static["extrapolated"] or "")
    rows: list[tuple[str, ...]] = [
        (ratio, shown(each["diameter"]), shown(each["depth"]), shown(each["stiffness"]), outside)
        for each in static["stiffness"]
    ]
    return columns, rows or [(ratio, "", "", "", outside)]
