"""The figure of results: which panels it has, where they stand, what they share, the title; panels over time."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import BinaryIO, Literal, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mudline.contact import ContactResult
from mudline.files import replacement, suffix_of
from mudline.quantities import STEPS, labelled, unit_names
from mudline.results.plot_data import PICTURES, Extents, PlotData
from mudline.results.plots import along_line
from mudline.results.plots.curves import loop, on_curves
from mudline.results.plots.style import (
    COLORS,
    SETTINGS,
    Spelled,
    Stretch,
    Style,
    above,
    finish,
    time_label,
    when,
    widen,
    write,
)

MOST_PANELS = 6
"""More have letters that nobody reads on half a page."""
_WIDTH = 8.0
_HEIGHT = 2.3
"""Of a row of panels, inch."""
_CAPTION = 100
"""Characters of a line of the caption."""


class Panel(NamedTuple):
    """A panel: its name, its horizontal axis, and what draws it."""

    name: str
    axis: Literal["arc length", "time", "own"]
    draw: Callable[[Axes], None]


def panels_of(data: PlotData, spelled: Spelled) -> list[Panel]:
    """Return the panels that the results have something to show in, at most `MOST_PANELS`, as they are drawn.

    Of more than that, those are left out that an engineer would miss least: the last ones below.
    """
    stretch, touched, lined = Stretch(data), bool(data.touched.any()), data.elements.size > 0
    loops = [Panel("loop", "own", partial(loop, data=data, place=place)) for place in range(len(data.looped))]
    along = {
        name: Panel(name, "arc length", partial(draw, data=data, stretch=stretch))
        for name, draw in along_line.PANELS.items()
    }
    others = (
        (lined, along["line"]),
        (touched, along["force"]),
        (
            touches_down(data),
            Panel("touchdown", "time", partial(touchdown, data=data, stretch=stretch)),
        ),
        (data.steps > 1 and data.known, Panel("reaction", "time", partial(reaction, data=data))),
        (lined and data.pulled is not None, along["suction"]),
        (lined and data.slid is not None, along["friction"]),
        (touched and data.on_curve.size, Panel("curves", "own", partial(on_curves, data=data, spelled=spelled))),
        (lined, along["embedment"]),
        (touched and data.steps == 1, along["stiffness"]),
    )
    found = [*loops, *(panel for needed, panel in others if needed)][:MOST_PANELS]
    return sorted(found, key=lambda panel: ("arc length", "own", "time").index(panel.axis))


def draw_evaluation(data: PlotData, form: str, stream: BinaryIO, spelled: Spelled, caption: str = "") -> None:
    """Write a picture ("png", "svg" or "pdf").

    `spelled` makes names of the deck fit to be shown; `caption` is what is doubtful, below the title.
    """
    with mpl.rc_context(SETTINGS):
        write(lambda: figure_of(data, spelled, caption), form, stream)


def figure_of(data: PlotData, spelled: Spelled, caption: str = "") -> Figure:
    """Return the figure; takes what `draw_evaluation` does."""
    panels, stretch = panels_of(data, spelled), Stretch(data)
    columns = 1 if len(panels) <= 2 else 2
    wide = len(panels) % columns
    """An odd number of panels: the first one is as wide as the figure."""
    rows = max(1, -(-len(panels) // columns))
    title = _title(data, panels, spelled)
    title += "".join(f"\n{line}" for line in textwrap.wrap(spelled(caption), _CAPTION))
    height = 0.2 + 0.17 * (1 + title.count("\n")) + _HEIGHT * rows
    figure = Figure(figsize=(_WIDTH, height), layout="constrained", dpi=150)
    grid = figure.add_gridspec(rows, columns)
    drawn: list[list[Axes]] = [[] for _ in range(columns)]
    for place, panel in enumerate(panels):
        column, row = divmod(place - wide, rows - wide)
        at = grid[0, :] if place < wide else grid[row + wide, column]
        axes = figure.add_subplot(at)
        panel.draw(axes)
        if panel.axis == "arc length":
            stretch.show(axes)
        finish(axes)
        drawn[max(column, 0)].append(axes)
        before = panels[place - 1] if row > 0 and place > wide else None
        if before is not None and before.axis == panel.axis != "own":  # the one above leaves the labels to it
            drawn[column][-2].tick_params(labelbottom=False)
            drawn[column][-2].set_xlabel("")
    for group in drawn:
        figure.align_ylabels(group)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.set(h_pad=0.04, w_pad=0.06)  # type: ignore[call-arg]
    figure.suptitle(title, fontsize="medium").set_parse_math(False)
    return figure


def _title(data: PlotData, panels: Sequence[Panel], spelled: Spelled) -> str:
    """What is drawn, and which step panels along the line show."""
    source = "" if data.given.names is None else data.given.names.source
    title = f"Seabed contact of {spelled(source)}" if source else "Seabed contact"
    chosen = data.chosen
    at = "" if chosen is None else when(data, chosen.step)
    if not at or not any(panel.axis == "arc length" for panel in panels):
        return title
    which = "along the line: at " if data.steps > 1 else "at "
    return f"{title}\n{which}{at}" + (", when the total reaction is largest" if data.steps > 1 else "")


def plot_result(
    result: ContactResult, path: str | os.PathLike[str] | None = None, *, elements: Sequence[int] = ()
) -> Figure:
    """Return the figure of a result, and write it to a file if a path is given; see `ContactResult.plot`."""
    form = "" if path is None else suffix_of(path)
    if path is not None and form not in PICTURES:
        forms = f".{', .'.join(PICTURES[:-1])} or .{PICTURES[-1]}"
        raise ValueError(f"{path}: unknown file format: give a name ending in {forms}")
    data = PlotData.of_result(result, elements)
    with mpl.rc_context(SETTINGS):
        figure = figure_of(data, str)
        if path is not None:
            with replacement(Path(path)) as stream:
                write(lambda: figure, form, stream)
    return figure


# ----------------------------------------------------------------------------------------------------- panels over time


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


def _band(axes: Axes, data: PlotData, values: Extents, style: Style, label: str | None) -> None:
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
