"""Panels over the steps: touchdown points and total reaction over time, force over penetration of chosen elements."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from mudline.quantities import STATES, STEPS, labelled, unit_names
from mudline.results.plot_data import Band, PlotData
from mudline.results.plots.stretch import Stretch
from mudline.results.plots.style import COLORS, STATE_STYLES, Style, above, time_label, widen
from mudline.scene.numbering import Floats, Indices, Mask


def touches_down(data: PlotData) -> bool:
    """Whether a line has a touchdown point at some step of a series."""
    return any(np.isfinite(band.most).any() for band in data.touchdown.values())


def touchdown(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the arc length of the first and the last touchdown point of each line over time."""
    several = len(stretch.lines) > 1
    for place, number in enumerate(stretch.lines):
        style = stretch.style(place)
        name = stretch.name(number) if several else "touchdown point"
        first, last = (data.touchdown[number, end] for end in ("first", "last"))
        two = not np.array_equal(first.most, last.most, equal_nan=True)
        _band(axes, data, first, style, name if several or not two else "first touchdown point")
        if two:
            other = Style(style.color if several else COLORS[1], ":" if several else "--", style.marker)
            _band(axes, data, last, other, None if several else "last touchdown point")
    axes.set_ylabel(labelled("arc length of touchdown", unit_names(data.given.units).length))
    above(axes)
    _time_axis(axes, data)


def reaction(axes: Axes, data: PlotData) -> None:
    """Draw the total reaction over time."""
    _band(axes, data, data.reaction, Style(COLORS[0], "-", "o"), None)
    axes.set_ylabel(STEPS["reaction"].axis(data.given.units))
    _time_axis(axes, data)


def _band(axes: Axes, data: PlotData, values: Band, style: Style, label: str | None) -> None:
    """Draw a figure over time; where steps are too many, the band between its least and largest values."""
    times = data.bin_times
    if np.array_equal(values.least, values.most, equal_nan=True):
        mark = style.marker if len(times) <= 25 else ""
        axes.plot(
            times,
            values.most,
            color=style.color,
            linestyle=style.linestyle,
            linewidth=1.2,
            marker=mark,
            markersize=3.5,
            label=label,
        )
    else:
        axes.fill_between(times, values.least, values.most, color=style.color, linewidth=0.6, label=label)
    widen(axes, np.concatenate([values.least, values.most]))


def _time_axis(axes: Axes, data: PlotData) -> None:
    """Set the horizontal axis of a panel over time."""
    times = data.bin_times
    last = float(data.steps - 1) if data.times is None else float(data.times[-1])
    beside = 0.01 * (last - float(times[0])) or 0.5
    axes.set_xlim(float(times[0]) - beside, last + beside)
    axes.set_xlabel(time_label(data))


# ----------------------------------------------------------------------------------------------- force over penetration

_ARROWS = 12
"""Arrow heads on a path."""
_STOP = STATES.index("hold")
"""A pipe that hangs still is a point of its path, and marked as one."""
_GOING = (("moving down", Style(COLORS[0], "-", "")), ("moving up", Style(COLORS[1], "--", "")))


class Cycle(NamedTuple):
    """An element over the steps: penetration, force per unit length, and state of suction, None without."""

    penetration: Floats
    force: Floats
    state: NDArray[np.int8] | None


def loop(axes: Axes, data: PlotData, place: int) -> None:
    """Draw the path of one of the chosen elements."""
    found = data.loop
    states = None if found.state is None else found.state[:, place]
    if states is not None and (states < 0).all():
        states = None
    draw_path(axes, Cycle(found.penetration[:, place], found.force[:, place], states))
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
