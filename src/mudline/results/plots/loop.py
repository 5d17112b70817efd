"""Force over penetration of one element, with the direction of the path and the states of suction on the way."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from mudline.quantities import STATES, labelled, unit_names
from mudline.results.plot_data import PlotData
from mudline.results.plots.style import COLORS, STATE_STYLES, Style, above, finish
from mudline.scene.numbering import Floats, Indices, Mask

_ARROWS = 12
"""Arrow heads on a path."""
_STOP = STATES.index("hold")
"""A pipe that hangs still is a point of its path, and marked as one."""
_GOING = (("moving down", Style(COLORS[0], "-", "")), ("moving up", Style(COLORS[1], "--", "")))


class Path(NamedTuple):
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
    draw_path(axes, Path(found.penetration[:, place], found.force[:, place], states))
    names = unit_names(data.given.units)
    number = int(data.given.element_ids[data.looped[place]])
    axes.set_xlabel(labelled(f"penetration of element {number}", names.length))
    axes.set_ylabel(labelled("seabed reaction\nper unit length", names.line_force).replace(" [", "\n["))
    above(axes, 5)
    finish(axes)


def draw_path(axes: Axes, path: Path) -> None:
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


def _ways(axes: Axes, path: Path, here: Indices, style: Style, name: str) -> None:
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


def _arrow_steps(path: Path) -> Indices:
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
