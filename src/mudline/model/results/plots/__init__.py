"""Figures in one style: results in panels, the line of a deck, errors over run time. Needs matplotlib."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from mudline.basics.arguments import expect_word
from mudline.basics.files import PLOT_FORMS, form_of_file, replacement
from mudline.basics.limits import LONGEST_MESSAGE
from mudline.basics.quantities import STEPS, labelled
from mudline.basics.units import UNITS
from mudline.model.contact import ContactResult, LawKind
from mudline.model.results.plot_data import Bins, PlotData
from mudline.model.results.plots import along_line
from mudline.model.results.plots.along_line import DrawnStretch, mark_touchdown, when
from mudline.model.results.plots.curves import loop, on_curves
from mudline.model.results.plots.style import (
    COLORS,
    MOST_POINTS,
    SEABED,
    Style,
    draw_line,
    drawing,
    figure_text,
    finish,
    gapped,
    legend,
    legend_name,
    new_figure,
    save,
    style_of,
    thinned,
    widen,
)
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask

MOST_PANELS = 6
"""Largest number of panels: with more, letters are too small on half a page."""
_HEIGHT = 2.3
"""Height of a row of panels, inch."""
_CAPTION = 100
"""Largest number of characters of a line of the caption."""


class Panel(NamedTuple):
    """A panel: its name, its horizontal axis, and the function that draws it."""

    name: str
    axis: Literal["arc length", "time", "own"]
    draw: Callable[[Axes, DrawnStretch], None]

    def draw_into(self, axes: Axes, stretch: DrawnStretch) -> None:
        """Draw the panel with its horizontal axis."""
        self.draw(axes, stretch)
        if self.axis == "arc length":
            stretch.show(axes)
        finish(axes)


def panels_of(data: PlotData) -> list[Panel]:
    """Return the panels for which the results have data, at most `MOST_PANELS`, in the order of drawing.

    The list in this function is in the order of importance: panels beyond the limit are left out.
    """
    # the force of a rigid seabed is not known: no panel shows it as 0
    touched = bool((data.touched & (data.given.law != LawKind.RIGID)).any())
    lined = data.elements.size > 0
    touches_down = any(np.isfinite(first.largest).any() for first, _ in data.touchdown.values())

    loops = [Panel("loop", "own", partial(loop, place=place)) for place in range(len(data.looped))]
    others = (
        (lined, Panel("line", "arc length", along_line.line)),
        (touched, Panel("force", "arc length", along_line.force)),
        (touches_down, Panel("touchdown", "time", touchdown)),
        (data.steps > 1 and data.known, Panel("reaction", "time", reaction)),
        (lined and "pull" in data.largest, Panel("suction", "arc length", along_line.suction)),
        (lined and "friction" in data.largest, Panel("friction", "arc length", along_line.friction)),
        (touched and data.on_curve.size, Panel("curves", "own", on_curves)),
        (lined, Panel("embedment", "arc length", along_line.embedment)),
        (touched and data.steps == 1, Panel("stiffness", "arc length", along_line.stiffness)),
    )
    panels = [*loops, *(panel for needed, panel in others if needed)][:MOST_PANELS]
    return sorted(panels, key=lambda panel: ("arc length", "own", "time").index(panel.axis))


@drawing()
def evaluation_figure(data: PlotData, caption: str = "") -> Figure:
    """Return the figure of results; `caption` has the warnings, below the title."""
    panels, stretch = panels_of(data), DrawnStretch(data)
    columns = 1 if len(panels) <= 2 else 2
    wide = len(panels) % columns
    """With an odd number of panels the first is as wide as the figure."""
    rows = max(1, -(-len(panels) // columns))
    title = "\n".join([_title(data, panels, stretch), *textwrap.wrap(figure_text(caption, LONGEST_MESSAGE), _CAPTION)])
    figure = new_figure(0.2 + 0.17 * (1 + title.count("\n")) + _HEIGHT * rows)
    grid = figure.add_gridspec(rows, columns)
    drawn: list[list[Axes]] = [[] for _ in range(columns)]
    for place, panel in enumerate(panels):
        column, row = divmod(place - wide, rows - wide)
        at = grid[0, :] if place < wide else grid[row + wide, column]
        axes = figure.add_subplot(at)
        panel.draw_into(axes, stretch)
        drawn[max(column, 0)].append(axes)
        before = panels[place - 1] if row > 0 and place > wide else None
        if before is not None and before.axis == panel.axis != "own":  # the panel above shares the labels
            drawn[column][-2].tick_params(labelbottom=False)
            drawn[column][-2].set_xlabel("")
    for group in drawn:
        figure.align_ylabels(group)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.set(h_pad=0.04, w_pad=0.06)  # type: ignore[call-arg]
    figure.suptitle(title, fontsize="medium").set_parse_math(False)
    return figure


def _title(data: PlotData, panels: Sequence[Panel], stretch: DrawnStretch) -> str:
    """Return the title: the deck, and the step and the part of the line that panels along the line show."""
    source = "" if data.given.names is None else data.given.names.source
    title = f"Seabed contact of {figure_text(source, _CAPTION)}" if source else "Seabed contact"
    at = when(data, data.drawn.step)
    if not any(panel.axis == "arc length" for panel in panels):
        return title
    title += f"\n{stretch.beyond}" if stretch.beyond else ""
    if not at:
        return title
    which = "along the line: at " if data.steps > 1 else "at "
    return f"{title}\n{which}{at}" + (", when the total reaction is largest" if data.steps > 1 else "")


def plot_panel(result: ContactResult, axes: Axes, name: str, *, elements: Sequence[int] = ()) -> Axes:
    """Draw one panel of the figure of a result; raises ValueError if it has none of that name."""
    data = PlotData.of_result(result, elements)
    panels = {panel.name: panel for panel in panels_of(data)}
    expect_word(name, "panel", tuple(panels), f"one of {', '.join(panels)}")
    panels[name].draw_into(axes, DrawnStretch(data))
    return axes


def plot_result(
    result: ContactResult, path: str | os.PathLike[str] | None = None, *, elements: Sequence[int] = ()
) -> Figure:
    """Return the figure of a result, and write it to a file if a path is given; see `ContactResult.plot`."""
    form = "" if path is None else form_of_file(path, PLOT_FORMS)
    figure = evaluation_figure(PlotData.of_result(result, elements))
    if path is not None:
        with replacement(Path(path)) as stream:
            save(figure, form, stream)
    return figure


# ----------------------------------------------------------------------------------------------------- panels over time


def touchdown(axes: Axes, stretch: DrawnStretch) -> None:
    """Draw the arc length of the first and the last touchdown point of each line over time."""
    data, several = stretch.data, len(stretch.lines) > 1
    for line in stretch.lines:
        first, last = data.touchdown[line.number]
        two = not np.array_equal(first.largest, last.largest, equal_nan=True)
        name = f"line {line.number + 1}" if several else "first touchdown point" if two else "touchdown point"
        _band(axes, data, first, line.style, name)
        if two:
            last_style = Style(line.style.color if several else COLORS[1], ":" if several else "--", line.style.marker)
            _band(axes, data, last, last_style, None if several else "last touchdown point")
    axes.set_ylabel(labelled("arc length of touchdown", UNITS[data.given.units].unit("L")))
    legend(axes)


def reaction(axes: Axes, stretch: DrawnStretch) -> None:
    """Draw the total reaction over time."""
    data = stretch.data
    _band(axes, data, data.reaction, style_of(0), None)
    axes.set_ylabel(STEPS["reaction"].axis(data.given.units))


def _band(axes: Axes, data: PlotData, values: Bins, style: Style, label: str | None) -> None:
    """Draw a figure over time; for many steps, the band between its least and largest values."""
    times = data.bin_times
    if np.array_equal(values.least, values.largest, equal_nan=True):
        draw_line(axes, times, values.largest, style, label, most_marked=25)
    else:
        axes.fill_between(times, values.least, values.largest, color=style.color, linewidth=0.6, label=label)
    widen(axes, np.concatenate([values.least, values.largest]))
    last = float(data.steps - 1) if data.times is None else float(data.times[-1])
    beside = 0.01 * (last - float(times[0])) or 0.5
    axes.set_xlim(float(times[0]) - beside, last + beside)
    axes.set_xlabel("step [-]" if data.times is None else labelled("time", UNITS[data.given.units].unit("T")))


# --------------------------------------------------------------------------------------------------- the line of a deck

_MOST_SETS = 7
_WIDTHS = (3.2, 2.2, 1.2)
"""Widths of the lines of the sets, in turn: they differ without colours."""


def can_draw(scene: Scene) -> bool:
    """Return True if an element has two nodes with coordinates."""
    return bool(_drawn(scene).size)


@drawing()
def model_figure(scene: Scene, data: PlotData | None) -> Figure:
    """Return elevation and plan; `data` has positions, seabed and touchdown points, if known.

    Nodes without a position are at the deck's own coordinates.
    """
    figure = new_figure(5.6)
    upper, lower = figure.subplots(2, 1, height_ratios=(3, 2))
    places = scene.coordinates
    if data is not None:
        places = np.where(np.isnan(data.drawn.places), places, data.drawn.places)
    drawn = _drawn(scene)
    span = np.ptp(places[np.unique(scene.element_nodes[drawn])], axis=0)
    along, across = (1, 2) if span[1] >= span[2] else (2, 1)
    groups = _by_set(scene, drawn)
    for axes, up, title in ((upper, 0, "Elevation"), (lower, across, "Plan")):
        for number, (name, elements) in enumerate(groups):
            kept = elements[:: max(1, -(-len(elements) // MOST_POINTS))]
            ends = places[scene.element_nodes[kept]]
            x, y = (gapped(*ends[:, :, axis].T) for axis in (along, up))
            color, width = style_of(number).color, _WIDTHS[number % len(_WIDTHS)]
            axes.plot(x, y, color=color, linewidth=width, label=legend_name(name), solid_capstyle="butt", zorder=3)
        if data is not None:
            _draw_ground(axes, data, along, up)
        unit = UNITS[scene.units].unit("L")
        axes.set_title(title, loc="right", fontsize="medium")
        axes.set(xlabel=labelled("XYZ"[along], unit), ylabel=labelled("XYZ"[up], unit))
        finish(axes)
    if not span[across]:
        level = places[scene.element_nodes[drawn[0], 0], across]
        lower.set_ylim(*(level + np.array([-0.5, 0.5]) * max(span[along] / 20, 1)))
    legend(upper)
    return figure


def _drawn(scene: Scene) -> Indices:
    """Return the elements whose two nodes have coordinates."""
    known = np.flatnonzero((scene.element_nodes >= 0).all(axis=1))
    ends = scene.coordinates[scene.element_nodes[known]]
    return known[np.isfinite(ends).all(axis=(1, 2))]


def _by_set(scene: Scene, drawn: Indices) -> list[tuple[str, Indices]]:
    """Return elements by the set that assigns their law, the largest sets first; small sets together at the end."""
    names = np.array([scene.law_sets[index] or "without a law" for index in drawn.tolist()])
    sets, counts = np.unique(names, return_counts=True)
    order = sets[np.argsort(-counts, kind="stable")]
    groups = [(str(name), drawn[names == name]) for name in order[:_MOST_SETS]]
    others = drawn[np.isin(names, order[_MOST_SETS:])]
    return [*groups, (f"{len(order) - _MOST_SETS} more sets", others)] if others.size else groups


def _draw_ground(axes: Axes, data: PlotData, along: int, up: int) -> None:
    """Draw the seabed below the line, in elevation, and the touchdown points."""
    if up == 0:
        for number in data.lines:
            nodes = data.given.lines.nodes[number]
            level = data.drawn.seabed[nodes]
            kept = thinned(np.nan_to_num(level))
            axes.plot(
                data.drawn.places[nodes[kept], along],
                level[kept],
                color=SEABED,
                linewidth=1.2,
                linestyle="--",
                zorder=1,
            )
        axes.plot([], [], color=SEABED, linestyle="--", label="seabed")
    points = data.touchdown_points(data.lines)
    x, y = ([(point.x, point.y, point.z)[axis] for point in points] for axis in (along, up))
    mark_touchdown(axes, x, y)


# ------------------------------------------------------------------------------------------------- errors over run time

_LEAST = 1e-5
"""Least error drawn; smaller errors are drawn at this value."""
_GOALS = (1.0, 2.0, 5.0)
"""Marked errors in percent."""
_PERCENT, _MILLI = 1e2, 1e3
_STAR: dict[str, Any] = {"markersize": 15, "markeredgecolor": "black", "zorder": 5}
"""Marker of the deck's own step."""


def draw_run_times(axes: Axes, run_times: Floats, errors: Floats, marked: Mask, names: Sequence[str]) -> None:
    """Draw errors (k, n) of the quantities `names` over run times (k,), in seconds for a second of motion."""
    times = _MILLI * run_times
    for at, name in enumerate(names):
        look, values = style_of(at), _PERCENT * np.maximum(errors[:, at], _LEAST)
        axes.plot(times, values, label=name, color=look.color, marker=look.marker, linewidth=1.5)
        axes.plot(times[marked], values[marked], "*", color=look.color, **_STAR)
    if marked.any():
        axes.plot([], [], "*", color="0.6", label="the deck's own step", **_STAR)
    finish(axes)
    axes.set(xscale="log", yscale="log", xlabel="run time [ms per s of motion]", ylabel="error of the last period [%]")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_locator(LogLocator(subs=(2.0, 5.0)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter("{x:g}")
    for goal in _GOALS:
        axes.axhline(goal, color="0.4", linewidth=1.0, linestyle=":")
        text = f" {goal:g} %"
        axes.annotate(text, (0.0, goal), xycoords=("axes fraction", "data"), va="bottom", color="0.3")
    legend(axes)


@drawing()
def run_times_figure(deck: str, run_times: Floats, errors: Floats, marked: Mask, names: Sequence[str]) -> Figure:
    """Return the diagram of a deck."""
    figure = new_figure(5.2)
    draw_run_times(figure.subplots(), run_times, errors, marked, names)
    figure.suptitle(f"Error against run time: {figure_text(deck, 100)}", fontsize="medium").set_parse_math(False)
    return figure
