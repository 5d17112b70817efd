"""The figure of results: which panels stand where, how high they are, what they share, the title; panels over time."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import BinaryIO, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from mudline.contact import ContactResult
from mudline.files import replacement, suffix_of
from mudline.quantities import STATES, STEPS, headed, labelled, unit_names
from mudline.results import panels as known
from mudline.results.panels import PANELS, PICTURES
from mudline.results.plot_data import TRACED, Band, PlotData
from mudline.results.plots import along_line
from mudline.results.plots.curves import on_curves
from mudline.results.plots.stretch import Stretch
from mudline.results.plots.style import (
    COLORS,
    SETTINGS,
    STATE_STYLES,
    Spelled,
    Style,
    above,
    finish,
    time_label,
    when,
    widen,
    write,
)
from mudline.scene.numbering import Floats, Indices, Mask

_WIDTH = 8.0
_WIDTH_OF_TWO = 14.0
_UNEVEN = 1.0
"""How much higher, inch, the right column may be for panels along the line in it."""
_STRETCHED = 1.5
"""How much higher a panel may become so that both columns are equally high; beyond it, the rest stays empty."""


class _Shown(NamedTuple):
    """A panel in a figure: the heights of its rows, inch, and what draws on their axes."""

    heights: Sequence[float]
    draw: Callable[[list[Axes]], None]


def draw_evaluation(
    data: PlotData,
    form: str,
    stream: BinaryIO,
    spelled: Spelled,
    caption: str = "",
    panels: Sequence[str] | None = None,
) -> None:
    """Write a picture ("png", "svg" or "pdf") with some panels, or with those that the results have data for.

    `spelled` makes names of the deck fit to be shown; `caption` is a line under the title.
    Raises PanelError for a panel that does not exist, or that there is nothing for.
    """
    with mpl.rc_context(SETTINGS):
        write(lambda: figure_of(data, spelled, caption, panels), form, stream)


def figure_of(data: PlotData, spelled: Spelled, caption: str = "", panels: Sequence[str] | None = None) -> Figure:
    """Return the figure; takes and raises what `draw_evaluation` does."""
    names = known.usual(data) if panels is None else known.panel_names(panels)
    known.require(data, names)
    stretch = Stretch(data)
    left = [name for name in names if PANELS[name].axis == "arc length"]
    right = [name for name in names if name not in left]
    shown = {name: _shown(name, data, stretch, spelled) for name in names}

    def height(column: Sequence[str]) -> float:
        return sum(sum(shown[name].heights) for name in column)

    while right and len(left) > 1 and height(right) + sum(shown[left[-1]].heights) <= height(left[:-1]) + _UNEVEN:
        right.append(left.pop())
    columns = [column for column in (left, right) if column]
    tallest = max(map(height, columns), default=2.0)
    figure = Figure(
        figsize=(_WIDTH_OF_TWO if len(columns) > 1 else _WIDTH, 1.0 + tallest),
        layout="constrained",
        dpi=120,
    )
    if columns:
        grid = figure.add_gridspec(1, len(columns))
        for place, column in enumerate(columns):
            cells = _Cells(grid, place, tallest)
            _fill(figure, cells, [(name, shown[name]) for name in column], stretch)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.set(h_pad=0.03, w_pad=0.06)  # type: ignore[call-arg]
    title = _title(data, names, spelled)
    figure.suptitle(f"{title}\n{spelled(caption)}" if caption else title).set_parse_math(False)
    return figure


class _Cells(NamedTuple):
    """A column of a grid, by its place, and its height, inch."""

    grid: GridSpec
    column: int
    height: float


def _fill(figure: Figure, cells: _Cells, panels: Sequence[tuple[str, _Shown]], stretch: Stretch) -> None:
    """Draw the panels of a column; those above others with the same horizontal axis leave its labels to them."""
    heights = [height for _, shown in panels for height in shown.heights]
    empty = cells.height - _STRETCHED * sum(heights)
    rest = [empty / _STRETCHED] if empty > 0.0 else []
    places = cells.grid[0, cells.column].subgridspec(len(heights) + len(rest), 1, height_ratios=[*heights, *rest])
    drawn: list[Axes] = []
    of_axis: dict[str, list[Axes]] = {}
    for name, shown in panels:
        axes = [figure.add_subplot(places[len(drawn) + row, 0]) for row in range(len(shown.heights))]
        drawn += axes
        shown.draw(axes)
        kind = PANELS[name].axis
        for each in axes:
            if kind == "arc length":
                stretch.show(each)
            finish(each)
        if kind != "own":
            of_axis.setdefault(kind, []).extend(axes)
    for group in of_axis.values():
        for each in group[:-1]:
            each.tick_params(labelbottom=False)
            each.set_xlabel("")
    figure.align_ylabels(drawn)


def _shown(name: str, data: PlotData, stretch: Stretch, spelled: Spelled) -> _Shown:
    """How high a panel is, and what draws it."""
    return {
        "line": _Shown([2.9], lambda axes: along_line.line(axes[0], data, stretch)),
        "force": _Shown([1.9], lambda axes: along_line.force(axes[0], data, stretch)),
        "suction": _Shown([1.9], lambda axes: along_line.suction(axes[0], data, stretch)),
        "friction": _Shown([1.9], lambda axes: along_line.friction(axes[0], data, stretch)),
        "embedment": _Shown([1.9], lambda axes: along_line.embedment(axes[0], data, stretch)),
        "stiffness": _Shown([1.9], lambda axes: along_line.stiffness(axes[0], data, stretch)),
        "envelope": _Shown([1.9, 1.7], lambda axes: along_line.envelope(axes, data, stretch)),
        "curves": _Shown([3.4], lambda axes: on_curves(axes[0], data, spelled)),
        "loop": _Shown([3.0] * len(data.looped), lambda axes: _loops(axes, data)),
        "touchdown": _Shown([1.5, 1.2], lambda axes: touchdown(axes, data, stretch)),
        "traces": _Shown([1.2] * len(TRACED), lambda axes: traces(axes, data)),
    }[name]


def _loops(rows: Sequence[Axes], data: PlotData) -> None:
    for place, axes in enumerate(rows):
        loop(axes, data, place)


def _title(data: PlotData, names: Sequence[str], spelled: Spelled) -> str:
    """What is drawn, and which step panels along the line show."""
    source = "" if data.given.names is None else data.given.names.source
    title = f"Seabed contact of {spelled(source)}" if source else "Seabed contact"
    chosen = data.chosen
    at = "" if chosen is None else when(data, chosen.step)
    if not at or not any(PANELS[name].axis == "arc length" or name == "curves" for name in names):
        return title
    which = "along the line: at " if data.steps > 1 else "at "
    return f"{title}\n{which}{at}" + (", when the total reaction is largest" if data.steps > 1 else "")


def plot_result(
    result: ContactResult,
    path: str | os.PathLike[str] | None = None,
    *,
    panels: Sequence[str] | None = None,
    elements: Sequence[int] = (),
) -> Figure:
    """Return the figure of a result, and write it to a file if a path is given; see `ContactResult.plot`."""
    form = "" if path is None else suffix_of(path)
    if path is not None and form not in PICTURES:
        forms = f".{', .'.join(PICTURES[:-1])} or .{PICTURES[-1]}"
        raise ValueError(f"{path}: unknown file format: give a name ending in {forms}")
    data = PlotData.of_result(result, elements)
    with mpl.rc_context(SETTINGS):
        figure = figure_of(data, str, "", panels)
        if path is not None:
            with replacement(Path(path)) as stream:
                write(lambda: figure, form, stream)
    return figure


# ----------------------------------------------------------------------------------------------------- panels over time


def touchdown(rows: Sequence[Axes], data: PlotData, stretch: Stretch) -> None:
    """Draw the arc length of the first and the last touchdown point of each line, and below the length in contact."""
    points, contact = rows
    several = len(stretch.lines) > 1
    for place, number in enumerate(stretch.lines):
        style = stretch.style(place)
        name = stretch.name(number) if several else "touchdown point"
        first, last = (data.touchdown[number, end] for end in ("first", "last"))
        two = not np.array_equal(first.most, last.most, equal_nan=True)
        band(points, data, first, style, name if several or not two else "first touchdown point")
        if two:
            other = Style(style.color if several else COLORS[1], ":" if several else "--", style.marker)
            band(points, data, last, other, None if several else "last touchdown point")
        band(contact, data, data.touchdown[number, "contact_length"], style, None)
    length = unit_names(data.given.units).length
    points.set_ylabel(labelled("arc length of\ntouchdown", length).replace(" [", "\n["))
    contact.set_ylabel(headed("length in\ncontact", length))
    if not any(np.isfinite(data.touchdown[number, "first"].most).any() for number in stretch.lines):
        points.text(0.5, 0.5, "no touchdown point", transform=points.transAxes, ha="center", va="center")
    else:
        above(points, 2)
    time_axis(rows, data)


def traces(rows: Sequence[Axes], data: PlotData) -> None:
    """Draw total reaction, largest force, elements in contact and deepest embedment, each on its axes."""
    for axes, name in zip(rows, TRACED, strict=True):
        band(axes, data, data.traces[name], Style(COLORS[0], "-", "o"), None)
        axes.set_ylabel(headed(STEPS[name].label, STEPS[name].unit_name(data.given.units)))
        if name == "touching":
            axes.yaxis.set_major_locator(MaxNLocator(nbins=3, integer=True, steps=[1, 2, 5, 10]))
    time_axis(rows, data)


def band(axes: Axes, data: PlotData, values: Band, style: Style, label: str | None) -> None:
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


def time_axis(rows: Sequence[Axes], data: PlotData) -> None:
    """Set the horizontal axis of panels over time."""
    times = data.bin_times
    last = float(data.steps - 1) if data.times is None else float(data.times[-1])
    beside = 0.01 * (last - float(times[0])) or 0.5
    for axes in rows:
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
    above(axes, 5)
    finish(axes)


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
