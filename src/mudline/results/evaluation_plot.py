"""The picture of an evaluation: the line over the bed, embedment, stiffness, curves, traces over time."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import BinaryIO

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mudline.results.plot_data import Chosen, PlotData
from mudline.results.plot_panels import embedment, on_curves, profile, stiffness, trace
from mudline.results.units import unit_names

_Panel = Callable[[Axes], None]
_Spelled = Callable[[str], str]
_TRACES = {
    "reaction": ("total reaction", "force"),
    "force": ("largest force\nper length", "line_force"),
    "touching": ("elements\nin contact", ""),
    "deepest": ("deepest\nembedment", "length"),
}


def draw(data: PlotData, form: str, stream: BinaryIO, spelled: _Spelled) -> None:
    """Write a picture ("png" or "svg") with the panels that the evaluation has data for.

    `spelled` makes names of the deck fit to be shown.
    """
    with mpl.rc_context({"svg.hashsalt": "mudline", "font.size": 9.0}), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a letter that the font lacks becomes a box
        figure = _figure(data, spelled)
        figure.savefig(stream, format=form, metadata={"Date": None} if form == "svg" else None)


def _figure(data: PlotData, spelled: _Spelled) -> Figure:
    left, right = _left(data), _right(data, spelled)
    height = max(sum(size for _, size in column) for column in (left, right))
    figure = Figure(figsize=(13.0 if right else 8.0, 1.0 + height), layout="constrained", dpi=120)
    grid = figure.add_gridspec(1, 2 if right else 1)
    for column, panels in enumerate((left, right)):
        if not panels:
            continue
        rows = grid[0, column].subgridspec(len(panels), 1, height_ratios=[size for _, size in panels])
        for row, (panel, _) in enumerate(panels):
            axes = figure.add_subplot(rows[row, 0])
            panel(axes)
    figure.suptitle(_title(data, spelled)).set_parse_math(False)
    return figure


def _left(data: PlotData) -> list[tuple[_Panel, float]]:
    """Panels along the line with their heights, inch."""
    chosen = data.chosen
    if chosen is None or not data.evaluation.elements.size:
        return []
    return [
        (lambda axes: profile(axes, data, chosen), 3.4),
        (lambda axes: embedment(axes, data, chosen), 2.4),
        (lambda axes: stiffness(axes, data, chosen), 2.4),
    ]


def _right(data: PlotData, spelled: _Spelled) -> list[tuple[_Panel, float]]:
    """The curves, and what changes over time."""
    panels: list[tuple[_Panel, float]] = []
    if data.on_curve.size:
        panels.append((lambda axes: on_curves(axes, data, spelled), 3.8))
    if data.evaluation.steps > 1:
        names = list(_TRACES)
        panels += [(_traced(data, name, last=name == names[-1]), 1.4) for name in names]
    return panels


def _traced(data: PlotData, name: str, *, last: bool) -> _Panel:
    label, unit = _TRACES[name]
    named = getattr(unit_names(data.evaluation.scene.units), unit) if unit else ""
    return lambda axes: trace(axes, data, name, f"{label}\n[{named}]" if named else label, last=last)


def _title(data: PlotData, spelled: _Spelled) -> str:
    deck = data.evaluation.scene.deck
    name = spelled(str(deck.source or deck.file))
    return f"Seabed contact of {name}{_when(data, data.chosen)}"


def _when(data: PlotData, chosen: Chosen | None) -> str:
    times = data.evaluation.time
    if times is None or chosen is None:
        return ""
    unit = " s" if unit_names(data.evaluation.scene.units).length else ""
    which = ", when the total reaction is largest" if len(times) > 1 else ""
    return f" at time {times[chosen.step]:g}{unit}{which}"
