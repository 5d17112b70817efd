"""Force over embedment: the picture of `mudline curves`, evaluated points on their curves, paths of chosen elements."""

from __future__ import annotations

from typing import Any, BinaryIO

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mudline.quantities import ELEMENTS, STATES, labelled, unit_names
from mudline.results.plot_data import Cycle, PlotData, Points
from mudline.results.plots.style import (
    COLORS,
    MOST_MARKED,
    STATE_STYLES,
    Spelled,
    Style,
    above,
    plain_texts,
    style_of,
    write,
)
from mudline.scene.deck_curves import OF_SEABED
from mudline.scene.numbering import Floats, Indices, Mask
from mudline.short_repr import cut

_MARGIN = 0.15
"""Part of its largest ratio by which a curve is drawn beyond its last point."""
_CYCLE = 10
"""Colours that matplotlib gives one after the other."""
_MARKERS = ("o", "s", "^", "v", "P")
"""The next one when the colours are used up."""

_DASHED = Line2D([], [], color="0.3", linestyle="--", linewidth=1.2)
_ASKED = Line2D([], [], color="0.3", linestyle="none", marker="x", markersize=8, markeredgewidth=1.5)
_STATIC = Line2D([], [], color="0.3", linestyle="none", marker="D", markersize=7, markerfacecolor="none")


def draw_curves(rows: list[dict[str, Any]], units: str, form: str, stream: BinaryIO) -> None:
    """Write a picture ("png", "svg" or "pdf") of all curves, dashed beyond their points, with the values asked for."""
    write(lambda: _curves(rows, units), form, stream)


def _curves(rows: list[dict[str, Any]], units: str) -> Figure:
    kinds = list(dict.fromkeys((row["kind"], *row["axes"]) for row in rows))
    most = max(5.0, 1.5 + 0.21 * len(rows))
    figure = Figure(figsize=(8, max(most, 3.6 * len(kinds))), layout="constrained", dpi=150)
    handles: list[Line2D] = []
    ordered: list[dict[str, Any]] = []
    for number, (kind, *names) in enumerate(kinds, 1):
        axes = figure.add_subplot(len(kinds), 1, number)
        own = [row for row in rows if (row["kind"], *row["axes"]) == (kind, *names)]
        handles += [_curve(axes, row, at) for at, row in enumerate(own, len(handles))]
        ordered += own
        _name_axes(axes, kind, names, units)
    _legend(figure, handles, ordered)
    return figure


def _name_axes(axes: Axes, kind: str, names: list[str], units: str) -> None:
    """The title of the curves of a kind, and the words along the axes."""
    axes.axhline(0.0, color="0.4", linewidth=0.8, zorder=1)
    axes.axvline(0.0, color="0.4", linewidth=0.8, zorder=1)
    axes.set_title(f"{kind[:1].upper()}{kind[1:]}s")
    axes.grid(visible=True, alpha=0.3)
    if kind == OF_SEABED:
        unit = unit_names(units).line_force or "force per length"
        names = [labelled(ELEMENTS["ratio"].label, "-"), f"seabed reaction per unit length [{unit}]"]
    axes.set_xlabel(names[0])
    axes.set_ylabel(names[1])


def _curve(axes: Axes, row: dict[str, Any], number: int) -> Line2D:
    """One curve with its marks, in the colour of its number; returns what stands for it in the legend."""
    shape = _MARKERS[number // _CYCLE % len(_MARKERS)]
    ratios, forces = np.array(row["points"]).T
    marker = shape if len(ratios) <= MOST_MARKED else None
    (line,) = axes.plot(ratios, forces, color=f"C{number % _CYCLE}", marker=marker, markersize=3.5)
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
    entries = [(handle, cut(row["name"], 40)) for handle, row in zip(handles, rows, strict=True)]
    entries.append((_DASHED, "beyond the points"))
    if any(row["at"] for row in rows):
        entries.append((_ASKED, "values asked for"))
    if any(row.get("static") for row in rows):
        entries.append((_STATIC, "static embedment"))
    shapes = [shape for shape, _ in entries]
    legend = figure.legend(shapes, ["x"] * len(shapes), loc="outside right upper", fontsize="small")
    plain_texts(legend)
    for text, (_, name) in zip(legend.get_texts(), entries, strict=True):
        text.set_text(name)


# ------------------------------------------------------------------------------------------- with evaluated points

_NAMED = 6
_PALEST = 0.65
"""How much of the colour of a point is white at the first step; none is at the last."""


def on_curves(axes: Axes, data: PlotData, spelled: Spelled) -> None:
    """Draw the curves with the evaluated points on them, which darken in the order of the steps.

    `spelled` makes names of curves fit to be shown.
    """
    every = _points(data)
    used = np.unique(every.curve)
    for place, index in enumerate(used.tolist()):
        style = style_of(place)
        mine = np.flatnonzero(every.curve == index)
        mine = mine[np.argsort(every.step[mine], kind="stable")]
        ratio, force = every.ratio[mine], every.force[mine]
        curve = data.curves[index]
        line = ""
        if curve is not None:
            far = max(float(ratio.max(initial=0.0)), float(curve.ratios[-1]))
            knots = curve.ratios[(curve.ratios > 0.0) & (curve.ratios < far)]
            knots = np.unique(np.concatenate([knots, [0.0, far]]))
            axes.plot(
                knots, curve.evaluate(knots)[0], color=style.color, linestyle=style.linestyle, linewidth=1.2, zorder=2
            )
            line = style.linestyle
        axes.scatter(
            ratio,
            force,
            s=16,
            c=_shades(style.color, every.step[mine], data.steps),
            marker=style.marker,
            edgecolors=style.color,
            linewidths=0.3,
            zorder=3,
            rasterized=len(mine) > 1000,
        )
        name = data.curves[index].name
        text = cut(spelled(str(name)), 24)
        label = (f" {text}" if text.startswith("_") else text) if place < _NAMED else None  # _ hides from legends
        axes.plot([], [], color=style.color, linestyle=line, marker=style.marker, markersize=4, label=label)
    if len(used) > _NAMED:
        axes.plot([], [], " ", label=f"and {len(used) - _NAMED} more curves")
    axes.set_xlabel(labelled(ELEMENTS["ratio"].label, "-"))
    axes.set_ylabel(ELEMENTS["force"].axis(data.given.units))
    above(axes, note="pale: first steps, dark: last" if data.steps > 1 else "", columns=2)


def _points(data: PlotData) -> Points:
    """Points in contact of the drawn step, and some of all steps."""
    chosen = data.chosen
    found = [*data.points, *([] if chosen is None else [data.points_of(chosen)])]
    every = Points(*(np.concatenate(columns) for columns in zip(*found, strict=True)))
    known = ~np.isnan(every.ratio) & ((every.ratio > 0.0) | (every.force != 0.0))
    if not known.any():
        known = ~np.isnan(every.ratio)
    return Points(*(column[known] for column in every))


def _shades(color: str, steps: Indices, count: int) -> Floats:
    """The colour (k, 3) of each point: pale at the first step, full at the last."""
    part = steps / max(1, count - 1) if count > 1 else np.ones(len(steps))
    pale = _PALEST * (1.0 - part[:, np.newaxis])
    shades: Floats = pale + (1.0 - pale) * np.array(to_rgb(color))
    return shades


# ----------------------------------------------------------------------------------------------- force over penetration

_ARROWS = 12
"""Arrow heads on a path."""
_STOP = STATES.index("hold")
"""A pipe that hangs still is a point of its path, and marked as one."""
_GOING = (("moving down", Style(COLORS[0], "-", "")), ("moving up", Style(COLORS[1], "--", "")))


def loop(axes: Axes, data: PlotData, place: int) -> None:
    """Draw the path of one of the chosen elements."""
    draw_path(axes, data.loop(place))
    names = unit_names(data.given.units)
    number = int(data.given.element_ids[data.looped[place]])
    axes.set_xlabel(labelled(f"penetration of element {number}", names.length))
    axes.set_ylabel(labelled("seabed reaction\nper unit length", names.line_force).replace(" [", "\n["))
    above(axes)


def draw_path(axes: Axes, path: Cycle) -> None:
    """Draw a path with arrow heads: by state where there are states, else by whether the pipe moves down or up."""
    groups: list[tuple[str, Style, Mask]] = []
    if path.state is not None:
        for index, (name, style) in enumerate(STATE_STYLES.items()):
            groups.append((name, style if index == _STOP else style._replace(marker=""), path.state == index))
    else:
        down = np.diff(path.penetration, prepend=path.penetration[0]) >= 0.0
        groups = [(name, style, way) for (name, style), way in zip(_GOING, (down, ~down), strict=True)]
    arrows = _arrow_steps(path)
    for name, style, mine in groups:
        here = np.flatnonzero(mine)
        if here.size:
            _ways(axes, path, here, style, name)
            for at in arrows[mine[arrows]].tolist():
                start, end = ((path.penetration[k], path.force[k]) for k in (at - 1, at))
                shape = {"arrowstyle": "-|>", "color": style.color, "mutation_scale": 13.0, "shrinkA": 0, "shrinkB": 0}
                axes.annotate("", end, start, arrowprops=shape, zorder=4)
    limits = axes.axis()
    axes.axhline(0.0, color="0.4", linewidth=0.8, zorder=1)
    axes.axvline(0.0, color="0.4", linewidth=0.8, linestyle=":", zorder=1)
    axes.axis(limits)  # the path fills the panel, wherever 0 is


def _ways(axes: Axes, path: Cycle, here: Indices, style: Style, name: str) -> None:
    """Draw the way to each of some steps, from the step before; a stop is a point."""
    back = np.maximum(here - 1, 0)
    gap = np.full(len(here), np.nan)
    x, y = (np.column_stack([values[back], values[here], gap]) for values in (path.penetration, path.force))
    joined = np.append(here[1:] == here[:-1] + 1, False)
    kept = np.column_stack([np.append(True, ~joined[:-1]), np.ones(len(here), bool), ~joined]).ravel()
    axes.plot(
        x.ravel()[kept],
        y.ravel()[kept],
        color=style.color,
        linestyle=style.linestyle,
        linewidth=1.8,
        marker=style.marker,
        markersize=5,
        markevery=[-2] if style.marker else None,
        label=name,
        zorder=3 if style.marker else 2,
    )


def _arrow_steps(path: Cycle) -> Indices:
    """Steps at even distances on the path, as it is seen: each direction is a part of its span."""
    with np.errstate(all="ignore"):
        moves = [
            np.diff(np.nan_to_num(values)) / (float(np.nanmax(values) - np.nanmin(values)) or 1.0)
            for values in (path.penetration, path.force)
            if np.isfinite(values).any()
        ]
    if not moves:
        return np.zeros(0, np.intp)
    far = np.append(0.0, np.cumsum(np.nan_to_num(np.hypot.reduce(moves) if len(moves) > 1 else moves[0])))
    places = (np.arange(_ARROWS) + 0.5) / _ARROWS * far[-1]
    steps = np.unique(np.searchsorted(far, places))
    steps = steps[(steps > 0) & (steps < len(far))]
    moved = np.diff(far)[steps - 1] > 0.0
    known = np.isfinite(path.force[steps]) & np.isfinite(path.force[steps - 1])
    found: Indices = steps[moved & known]
    return found
