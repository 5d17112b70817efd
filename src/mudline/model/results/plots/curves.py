"""Plots of force over embedment and of other curves; evaluated points on curves, paths of chosen elements."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from mudline.basics.quantities import ELEMENTS, STATES, labelled
from mudline.basics.units import UNITS
from mudline.model.contact.arrays import FloatArray
from mudline.model.results.plot_data import Cycle, PlotData
from mudline.model.results.plots.along_line import DrawnStretch
from mudline.model.results.plots.style import (
    COLORS,
    MOST_MARKED,
    STATE_STYLES,
    Style,
    drawing,
    finish,
    legend,
    legend_name,
    new_figure,
    style_of,
    zero_line,
)
from mudline.model.scene.curves import OF_CURRENT, OF_SEABED
from mudline.model.scene.numbering import Indices, Mask

_MARGIN = 0.15
"""Part of its largest ratio by which a curve is drawn beyond its last point."""
_MARKS = {"values asked for": ("at", "x", 8.0), "static embedment": ("static", "D", 7.0)}
"""Marked points of a curve: their key in a row, marker and size."""
_OPEN: dict[str, Any] = {"markeredgewidth": 1.5, "markerfacecolor": "none"}


@drawing()
def curves_figure(rows: Iterable[dict[str, Any]], units: str) -> Figure:
    """Return a figure of curves by kind and keyword, dashed beyond their points, with the values asked for.

    A current profile is drawn with the elevation upward.

    Args:
        rows: rows of `curve_rows`: name, kind, points and values asked for; of curves other than those of the seabed
            also keyword, axes, units, ends and reach.
        units: system of units.
    """
    kinds: dict[tuple[str, ...], list[dict[str, Any]]] = {}
    for row in rows:
        of_seabed = row["kind"] == OF_SEABED
        kinds.setdefault((row["kind"],) if of_seabed else (row["kind"], row["keyword"], *row["axes"]), []).append(row)
    heights = [2.9 + 0.085 * (len(own) + 4) for own in kinds.values()]
    figure = new_figure(max(sum(heights), 4.0))
    grid = figure.add_gridspec(max(1, len(kinds)), 1, height_ratios=heights or None)
    for place, ((kind, *_), own) in enumerate(kinds.items()):
        axes = figure.add_subplot(grid[place])
        for number, row in enumerate(own):
            _curve(axes, row, style_of(number))
        if own[0].get("ends") != "none":
            axes.plot([], [], color="0.3", linestyle="--", linewidth=1.0, label="beyond the points")
        for label, (key, shape, size) in _MARKS.items():
            if any(row.get(key) for row in own):
                axes.plot([], [], shape, color="0.3", markersize=size, label=label, **_OPEN)
        zero_line(axes)
        axes.axvline(0.0, color="0.4", linewidth=0.8, zorder=1)
        title = f"{kind[:1].upper()}{kind[1:]}s"
        if kind == OF_SEABED:
            force = labelled(ELEMENTS["force"].label, UNITS[units].text("F/L"))
            labels = [labelled(ELEMENTS["ratio"].label, "-"), force]
        else:
            labels = [labelled(name, unit) for name, unit in zip(own[0]["axes"], own[0]["units"], strict=True)]
            title += f" (*{own[0]['keyword']})"
        if kind == OF_CURRENT:
            labels.reverse()
        axes.set(xlabel=labels[0], ylabel=labels[1])
        finish(axes)
        if kind == OF_CURRENT and own[0]["axes"][0].startswith("depth"):
            axes.invert_yaxis()
        legend(axes, title=title, columns=2)
    figure.align_ylabels()
    return figure


def _curve(axes: Axes, row: dict[str, Any], style: Style) -> None:
    """Draw a curve within its known range, with its marks; a current profile upward."""
    ratios, forces = np.array(row["points"]).T
    reach = row.get("reach", (None, None))
    low, high = (outermost if end is None else end for end, outermost in zip(reach, ratios[[0, -1]], strict=True))
    known = np.unique(np.clip(ratios, low, high))
    ratios, forces = known, np.interp(known, ratios, forces)
    upward = -1 if row["kind"] == OF_CURRENT else 1
    marker = style.marker if len(ratios) <= MOST_MARKED else ""
    name = legend_name(row["name"])
    axes.plot(*(ratios, forces)[::upward], color=style.color, linewidth=1.3, marker=marker, markersize=3.5, label=name)
    marked = []
    for key, shape, size in _MARKS.values():
        for mark in row.get(key, ()):
            if mark["force"] is not None:
                axes.plot(*(mark["ratio"], mark["force"])[::upward], shape, color=style.color, markersize=size, **_OPEN)
                marked.append(mark["ratio"])
    far = ratios[-1] * (1.0 + _MARGIN)
    for end, inner, to in ((0, 1, min([0.0, *marked])), (-1, -2, max([far, *marked]))):
        if reach[end] is not None:
            continue
        with np.errstate(all="ignore"):
            part = (to - ratios[end]) / (ratios[end] - ratios[inner])
            rise = 0.0 if row.get("ends") == "value" else part * (forces[end] - forces[inner])
        if part > 0.0 and np.isfinite(forces[end] + rise):
            beyond = [ratios[end], to], [forces[end], forces[end] + rise]
            axes.plot(*beyond, color=style.color, linestyle="--", linewidth=1.0)


def draw_curve(axes: Axes, name: str, points: FloatArray) -> None:
    """Draw a force-embedment curve of points (n, 2) into axes that may hold others."""
    drawn = axes.get_legend_handles_labels()[1]
    _curve(axes, {"name": name, "kind": OF_SEABED, "points": points}, style_of(len(drawn)))
    axes.set(xlabel=labelled(ELEMENTS["ratio"].label, "-"), ylabel=ELEMENTS["force"].label.replace("\n", " "))
    finish(axes)
    legend(axes)


# ------------------------------------------------------------------------------------------- with evaluated points

_NAMED = 6
_SHORT_NAME = 24
_PALEST = 0.65
"""Share of white in the colour of a point at the first step; 0 at the last step."""


def on_curves(axes: Axes, stretch: DrawnStretch) -> None:
    """Draw the curves with the evaluated points on them, which darken in the order of the steps."""
    data, every = stretch.data, stretch.data.points()
    used = np.unique(every.curve)
    for place, index in enumerate(used.tolist()):
        style, curve = style_of(place), data.given.curves[index]
        rows = np.flatnonzero(every.curve == index)
        rows = rows[np.argsort(every.step[rows], kind="stable")]
        ratio, force = every.ratio[rows], every.force[rows]
        far = float(ratio.max(initial=curve.ratios[-1]))
        knots = np.unique([0.0, *curve.ratios[(curve.ratios > 0.0) & (curve.ratios < far)], far])
        axes.plot(knots, curve.evaluate(knots)[0], **style.line, linewidth=1.2, zorder=2)
        for above, pull in _springs(data, index, float(ratio.min(initial=0.0))):
            axes.plot([above, 0.0], [pull, 0.0], **style.line, linewidth=1.2, zorder=2)
        part = every.step[rows] / (data.steps - 1) if data.steps > 1 else np.ones(len(rows))
        pale = _PALEST * (1.0 - part[:, np.newaxis])
        axes.scatter(
            ratio,
            force,
            s=16,
            c=pale + (1.0 - pale) * np.array(to_rgb(style.color)),
            marker=style.marker,
            edgecolors=style.color,
            linewidths=0.3,
            zorder=3,
            rasterized=len(rows) > 1000,
        )
        label = legend_name(str(curve.name), _SHORT_NAME) if place < _NAMED else None
        axes.plot([], [], **style.line, marker=style.marker, markersize=4, label=label)
    if len(used) > _NAMED:
        axes.plot([], [], " ", label=f"and {len(used) - _NAMED} more curves")
    axes.set(xlabel=labelled(ELEMENTS["ratio"].label, "-"), ylabel=ELEMENTS["force"].axis(data.given.units))
    legend(axes, note="pale: first steps, dark: last" if data.steps > 1 else "", columns=2)


def _springs(data: PlotData, curve: int, least: float) -> list[list[float]]:
    """Return the ends of the lines below ratio 0: the suction springs of the elements that follow a curve.

    Each end is a ratio, not less than the `least` ratio of the evaluated points, and the force there. Of many springs
    only some are drawn.
    """
    spring = data.given.assigned.get("suction spring")
    if spring is None or least >= 0.0:
        return []
    size, followers = data.given.diameter[spring.rows], data.given.curve_index[spring.rows] == curve
    above = np.maximum(-spring["extent"] / size, least)
    ends = np.column_stack([above, spring["stiffness"] * size * above])[followers]
    springs: list[list[float]] = np.unique(ends, axis=0)[:_NAMED].tolist()
    return springs


# ----------------------------------------------------------------------------------------------- force over penetration

_ARROWS = 12
"""Number of arrow heads on a path."""
_GOING = (("moving down", Style(COLORS[0], "-", "")), ("moving up", Style(COLORS[1], "--", "")))


def loop(axes: Axes, stretch: DrawnStretch, place: int) -> None:
    """Draw the path of one of the chosen elements."""
    data = stretch.data
    draw_path(axes, data.loop(place))
    number = int(data.given.element_ids[data.looped[place]])
    axes.set_xlabel(labelled(f"penetration of element {number}", UNITS[data.given.units].unit("L")))
    axes.set_ylabel(ELEMENTS["force"].axis(data.given.units).replace(" [", "\n["))
    legend(axes)


def draw_path(axes: Axes, path: Cycle) -> None:
    """Draw a path with arrow heads: by state if there are states, else by downward and upward motion.

    A pipe that hangs still (`hold`) is marked as a point of its path.
    """
    groups: list[tuple[str, Style, Mask]] = []
    if path.state is not None:
        for name, style in STATE_STYLES.items():
            look = style if name == "hold" else style._replace(marker="")
            groups.append((name, look, path.state == STATES.index(name)))
    else:
        down = np.diff(path.penetration, prepend=path.penetration[0]) >= 0.0
        groups = [(name, style, moves) for (name, style), moves in zip(_GOING, (down, ~down), strict=True)]
    arrows = _arrow_steps(path)
    for name, style, shown in groups:
        here = np.flatnonzero(shown)
        if here.size:
            _ways(axes, path, here, style, name)
            for at in arrows[shown[arrows]].tolist():
                start, end = ((path.penetration[k], path.force[k]) for k in (at - 1, at))
                shape = {"arrowstyle": "-|>", "color": style.color, "mutation_scale": 13.0, "shrinkA": 0, "shrinkB": 0}
                axes.annotate("", end, start, arrowprops=shape, zorder=4)
    limits = axes.axis()
    zero_line(axes)
    axes.axvline(0.0, color="0.4", linewidth=0.8, linestyle=":", zorder=1)
    axes.axis(limits)  # the path fills the panel, wherever 0 is


def _ways(axes: Axes, path: Cycle, here: Indices, style: Style, name: str) -> None:
    """Draw the path to each of some steps, from the step before; a stop is a point."""
    runs = np.split(here, np.flatnonzero(np.diff(here) > 1) + 1)
    x, y = (
        np.concatenate([np.append(values[[max(run[0] - 1, 0), *run]], np.nan) for run in runs])
        for values in (path.penetration, path.force)
    )
    every, order = ([-2], 3) if style.marker else (None, 2)
    marks: dict[str, Any] = {"marker": style.marker, "markersize": 5, "markevery": every}
    axes.plot(x, y, **style.line, **marks, linewidth=1.8, label=name, zorder=order)


def _arrow_steps(path: Cycle) -> Indices:
    """Return steps evenly spaced along the drawn path: each direction counts as a part of its span."""
    with np.errstate(all="ignore"):
        both = (np.nan_to_num(values) for values in (path.penetration, path.force))
        moves = np.hypot(*(np.diff(values) / (float(np.ptp(values)) or 1.0) for values in both))
    far = np.append(0.0, np.cumsum(np.nan_to_num(moves)))
    places = (np.arange(_ARROWS) + 0.5) / _ARROWS * far[-1]
    steps = np.unique(np.searchsorted(far, places))
    steps = steps[(steps > 0) & (steps < len(far))]
    moved = np.diff(far)[steps - 1] > 0.0
    known = np.isfinite(path.force[steps]) & np.isfinite(path.force[steps - 1])
    shown: Indices = steps[moved & known]
    return shown
