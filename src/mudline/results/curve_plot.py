"""The force-embedment curves as a picture."""

from __future__ import annotations

import warnings
from typing import Any, BinaryIO

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mudline.results.quantities import ELEMENTS, labelled, unit_names

_MARGIN = 0.15
_LONGEST_NAME = 40
_COLORS = 10
_MARKERS = ("o", "s", "^", "v", "P")
"""The next one when the colours are used up."""
_MOST_MARKED = 60
"""Points of longer curves are not marked one by one."""

_DASHED = Line2D([], [], color="0.3", linestyle="--", linewidth=1.2)
_ASKED = Line2D([], [], color="0.3", linestyle="none", marker="x", markersize=8, markeredgewidth=1.5)
_STATIC = Line2D([], [], color="0.3", linestyle="none", marker="D", markersize=7, markerfacecolor="none")


def draw(rows: list[dict[str, Any]], units: str, form: str, stream: BinaryIO) -> None:
    """Write a picture ("png" or "svg") of all curves, dashed beyond their points, with the values asked for."""
    figure = Figure(figsize=(8, max(5.0, 1.5 + 0.21 * len(rows))), layout="constrained", dpi=150)
    axes = figure.add_subplot()
    handles = [_curve(axes, row, _MARKERS[index // _COLORS % len(_MARKERS)]) for index, row in enumerate(rows)]
    axes.axhline(0.0, color="0.4", linewidth=0.8, zorder=1)
    axes.axvline(0.0, color="0.4", linewidth=0.8, zorder=1)
    unit = unit_names(units).line_force or "force per length"
    axes.set_xlabel(labelled(ELEMENTS["ratio"].label, "-"))
    axes.set_ylabel(f"seabed reaction per unit length [{unit}]")
    axes.set_title("Force-embedment curves")
    axes.grid(visible=True, alpha=0.3)
    _legend(figure, handles, rows)
    with mpl.rc_context({"svg.hashsalt": "mudline"}), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a letter that the font lacks becomes a box
        figure.savefig(stream, format=form, metadata={"Date": None} if form == "svg" else None)


def _curve(axes: Axes, row: dict[str, Any], shape: str) -> Line2D:
    """One curve with its marks; returns what stands for it in the legend."""
    ratios, forces = np.array(row["points"]).T
    marker = shape if len(ratios) <= _MOST_MARKED else None
    (line,) = axes.plot(ratios, forces, marker=marker, markersize=3.5)
    color = line.get_color()
    static = [(each["ratio"], each["force"]) for each in row.get("static", [])]
    asked = [(each["ratio"], each["force"]) for each in row["at"]]
    marked = [ratio for ratio, _ in (*static, *asked)]
    ends = (
        (ratios[0], forces[0], row["segments"][0]["slope"], min([0.0, *marked])),
        (ratios[-1], forces[-1], row["segments"][-1]["slope"], max([ratios[-1] * (1.0 + _MARGIN), *marked])),
    )
    for (ratio, force, slope, to), outward in zip(ends, (-1.0, 1.0), strict=True):
        with np.errstate(over="ignore"):
            end = force + slope * (to - ratio)
        if outward * (to - ratio) > 0.0 and np.isfinite(end):
            axes.plot([ratio, to], [force, end], color=color, linestyle="--", linewidth=1)
    for points, mark in ((asked, _ASKED), (static, _STATIC)):
        for ratio, force in points:
            axes.plot(ratio, force, color=color, **_marker(mark))
    return line


def _marker(mark: Line2D) -> dict[str, Any]:
    return {
        "marker": mark.get_marker(),
        "markersize": mark.get_markersize(),
        "markeredgewidth": mark.get_markeredgewidth(),
        "markerfacecolor": mark.get_markerfacecolor(),
    }


def _legend(figure: Figure, handles: list[Line2D], rows: list[dict[str, Any]]) -> None:
    """Beside the axes, where it covers nothing; a name is plain text, whatever is in it."""
    entries = [(handle, _short(row["name"])) for handle, row in zip(handles, rows, strict=True)]
    entries.append((_DASHED, "beyond the points"))
    if any(row["at"] for row in rows):
        entries.append((_ASKED, "values asked for"))
    if any(row.get("static") for row in rows):
        entries.append((_STATIC, "static embedment"))
    shapes = [shape for shape, _ in entries]
    legend = figure.legend(shapes, ["x"] * len(shapes), loc="outside right upper", fontsize="small")
    for text, (_, name) in zip(legend.get_texts(), entries, strict=True):
        text.set_parse_math(False)
        text.set_text(name)


def _short(name: str) -> str:
    return name if len(name) <= _LONGEST_NAME else name[: _LONGEST_NAME - 3] + "..."
