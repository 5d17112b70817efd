"""Panels over time: touchdown and length in contact of the lines, and the figures of all elements together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from mudline.quantities import STEPS, headed, labelled, unit_names
from mudline.results.plot_data import TRACED, Band, PlotData
from mudline.results.plots.stretch import Stretch
from mudline.results.plots.style import COLORS, Style, above, time_label, widen


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
