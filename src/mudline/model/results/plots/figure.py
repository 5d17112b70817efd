"""The figure of results: its panels, their layout, shared axes and title; panels over time."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mudline.basics.arguments import expect_word
from mudline.basics.files import PLOT_FORMS, form_of_file, replacement
from mudline.basics.limits import LONGEST_MESSAGE
from mudline.basics.quantities import STEPS, labelled, time_unit, unit_names
from mudline.model.contact import ContactResult, LawKind
from mudline.model.results.plot_data import Extents, PlotData
from mudline.model.results.plots import along_line
from mudline.model.results.plots.along_line import DrawnStretch, when
from mudline.model.results.plots.curves import loop, on_curves
from mudline.model.results.plots.style import (
    COLORS,
    Style,
    draw_line,
    drawing,
    finish,
    legend,
    new_figure,
    printable,
    save,
    widen,
)

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
    touches_down = any(np.isfinite(first.most).any() for first, _ in data.touchdown.values())

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
    title = "\n".join([_title(data, panels, stretch), *textwrap.wrap(printable(caption, LONGEST_MESSAGE), _CAPTION)])
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
    title = f"Seabed contact of {printable(source, _CAPTION)}" if source else "Seabed contact"
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
    expect_word(name, "panel", panels)
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
        two = not np.array_equal(first.most, last.most, equal_nan=True)
        name = f"line {line.number + 1}" if several else "first touchdown point" if two else "touchdown point"
        _band(axes, data, first, line.style, name)
        if two:
            last_style = Style(line.style.color if several else COLORS[1], ":" if several else "--", line.style.marker)
            _band(axes, data, last, last_style, None if several else "last touchdown point")
    axes.set_ylabel(labelled("arc length of touchdown", unit_names(data.given.units).length))
    legend(axes)


def reaction(axes: Axes, stretch: DrawnStretch) -> None:
    """Draw the total reaction over time."""
    data = stretch.data
    _band(axes, data, data.reaction, Style(COLORS[0], "-", "o"), None)
    axes.set_ylabel(STEPS["reaction"].axis(data.given.units))


def _band(axes: Axes, data: PlotData, values: Extents, style: Style, label: str | None) -> None:
    """Draw a figure over time; for many steps, the band between its least and largest values."""
    times = data.bin_times
    if np.array_equal(values.least, values.most, equal_nan=True):
        draw_line(axes, times, values.most, style, label, most_marked=25)
    else:
        axes.fill_between(times, values.least, values.most, color=style.color, linewidth=0.6, label=label)
    widen(axes, np.concatenate([values.least, values.most]))
    last = float(data.steps - 1) if data.times is None else float(data.times[-1])
    beside = 0.01 * (last - float(times[0])) or 0.5
    axes.set_xlim(float(times[0]) - beside, last + beside)
    axes.set_xlabel("step [-]" if data.times is None else labelled("time", time_unit(data.given.units)))
