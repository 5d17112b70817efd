"""Panels over the arc length of the lines: forces, embedment and stiffness of a step, and envelopes of all steps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from mudline.quantities import ELEMENTS, SLIDING, labelled, unit_names
from mudline.results.plot_data import Chosen, Envelope, PlotData
from mudline.results.plots.stretch import Stretch
from mudline.results.plots.style import (
    SEABED,
    STATE_STYLES,
    above,
    is_number,
    legend_above,
    marked,
    style_of,
    thinned,
    when,
    widen,
)
from mudline.scene.numbering import Floats

_MOST_SLIPPING = 80
"""Slipping nodes of a line that are marked."""


def force(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the seabed reaction of the elements; that on the nodes, where only springs of nodes act."""
    result = data.drawn.result
    units = data.given.units
    if not np.nan_to_num(result.force).any() and np.nan_to_num(result.normal_force).any():
        _of_nodes(axes, result.normal_force, stretch)
        axes.set_ylabel(labelled("seabed reaction\non a node", unit_names(units).force))
    else:
        _of_elements(axes, data, result.force, stretch)
        axes.set_ylabel(ELEMENTS["force"].axis(units))
    axes.axhline(0.0, color="0.4", linewidth=0.8, zorder=1)


def embedment(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the embedment of the elements, downwards."""
    depth = data.drawn.result.depth
    _of_elements(axes, data, depth, stretch)
    _downwards(axes, data)


def stiffness(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the stiffness of the seabed under the elements."""
    _of_elements(axes, data, data.drawn.result.stiffness, stretch)
    axes.set_ylabel(ELEMENTS["stiffness"].axis(data.given.units))


def _downwards(axes: Axes, data: PlotData) -> None:
    """Embedment grows downwards from the seabed; what hangs high above does not hide how deep the rest lies."""
    axes.axhline(0.0, color=SEABED, linewidth=1.2, zorder=1)
    deepest = float(np.nan_to_num(data.depth.most).max(initial=0.0))
    top, bottom = axes.get_ylim()
    if deepest > 0.0:
        top, bottom = min(max(top, -0.6 * deepest), -0.06 * deepest), 1.08 * deepest
    if is_number(top) and is_number(bottom):
        axes.set_ylim(bottom, top)
    axes.set_ylabel(ELEMENTS["depth"].axis(data.given.units))


def suction(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw what holds the line down per unit length, with the states of suction, when the pull is largest."""
    chosen = data.pulled or data.drawn
    pull = np.maximum(0.0 - chosen.result.force, 0.0)
    _of_elements(axes, data, pull, stretch, mark=False)
    states = chosen.result.state
    if states is not None:
        for index, (name, style) in enumerate(STATE_STYLES.items()):
            mine = np.concatenate([stretch.elements(number) for number in stretch.lines])
            mine = mine[states[mine] == index]
            if not mine.size:
                continue
            shown = mine[thinned(pull[mine], 400)]
            axes.plot(
                data.given.lines.element_arc[shown],
                pull[shown],
                linestyle="none",
                marker=style.marker,
                markersize=5 if marked(len(mine)) else 3,
                color=style.color,
                label=name,
                zorder=4,
            )
        above(axes, 5)
    _step_note(axes, data, chosen)
    axes.set_ylabel(labelled("suction\nper unit length", unit_names(data.given.units).line_force))


def friction(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the axial and the lateral force on the nodes, crossed where they slip, when the largest of them acts."""
    chosen = data.slid or data.drawn
    result = chosen.result
    if result.friction is None:
        return
    slips = 0
    for side, name in enumerate(("axial", "lateral")):
        style = style_of(side)
        for place, number in enumerate(stretch.lines):
            nodes, arcs = stretch.nodes(number)
            values = result.friction[nodes, side]
            drawn = thinned(values)
            label = name if place == 0 else None
            axes.plot(arcs[drawn], values[drawn], color=style.color, linestyle=style.linestyle, label=label)
            at = np.flatnonzero(result.friction_state_of(side)[nodes] == SLIDING.index("slip"))
            slips += len(at)
            at = at[:: max(1, len(at) // _MOST_SLIPPING)]
            axes.plot(arcs[at], values[at], linestyle="none", marker="x", markersize=4, color=style.color)
    if slips:
        axes.plot([], [], linestyle="none", marker="x", markersize=4, color="0.2", label="slips")
    _step_note(axes, data, chosen)
    axes.axhline(0.0, color="0.4", linewidth=0.8, zorder=1)
    axes.set_ylabel(labelled("friction on a node", unit_names(data.given.units).force).replace(" [", "\n["))
    above(axes)


def _of_elements(axes: Axes, data: PlotData, values: Floats, stretch: Stretch, *, mark: bool = True) -> None:
    """Draw values (m,) of the elements over the arc length of their middles."""
    seen = [np.zeros(0)]
    for place, number in enumerate(stretch.lines):
        elements = stretch.elements(number)
        drawn = elements[thinned(values[elements])]
        style = stretch.style(place)
        points = style.marker if mark and marked(len(drawn)) else ""
        axes.plot(
            data.given.lines.element_arc[drawn],
            values[drawn],
            color=style.color,
            linestyle=style.linestyle,
            linewidth=1.3,
            marker=points,
            markersize=3.5,
        )
        seen.append(values[drawn])
    widen(axes, np.concatenate(seen))


def _of_nodes(axes: Axes, values: Floats, stretch: Stretch) -> None:
    """Draw values (n,) of the nodes over their arc length."""
    for place, number in enumerate(stretch.lines):
        nodes, arcs = stretch.nodes(number)
        drawn = thinned(values[nodes])
        style = stretch.style(place)
        points = style.marker if marked(len(drawn)) else ""
        axes.plot(
            arcs[drawn],
            values[nodes[drawn]],
            color=style.color,
            linestyle=style.linestyle,
            linewidth=1.3,
            marker=points,
            markersize=3.5,
        )


# -------------------------------------------------------------------------------------------------- over all steps


def envelope(rows: Sequence[Axes], data: PlotData, stretch: Stretch) -> None:
    """Draw the largest, mean and least force and embedment of the elements over all steps, each on its axes."""
    first, second = rows
    _extents(first, data, data.force, stretch)
    first.axhline(0.0, color="0.4", linewidth=0.8, zorder=1)
    first.set_ylabel(labelled("reaction per unit\nlength, all steps", unit_names(data.given.units).line_force))
    legend_above(
        first,
        [
            Line2D([], [], color="0.2", linestyle="-", linewidth=1.3, label="largest"),
            Line2D([], [], color="0.2", linestyle="--", linewidth=1.3, label="mean"),
            Line2D([], [], color="0.2", linestyle=":", linewidth=1.3, label="least"),
        ],
    )
    _extents(second, data, data.depth, stretch)
    _downwards(second, data)
    second.set_ylabel(labelled("embedment,\nall steps", unit_names(data.given.units).length))


def _extents(axes: Axes, data: PlotData, found: Envelope, stretch: Stretch) -> None:
    for place, number in enumerate(stretch.lines):
        elements = stretch.elements(number)
        drawn = elements[thinned(found.most[elements])]
        color = stretch.style(place).color
        arcs = data.given.lines.element_arc[drawn]
        axes.fill_between(arcs, found.least[drawn], found.most[drawn], color=color, alpha=0.12, linewidth=0.0)
        for values, linestyle in ((found.most, "-"), (found.mean, "--"), (found.least, ":")):
            axes.plot(arcs, values[drawn], color=color, linestyle=linestyle, linewidth=1.3)


def _step_note(axes: Axes, data: PlotData, chosen: Chosen) -> None:
    """Write the time of a step on a panel of a series that shows another one than the others do."""
    if data.steps > 1:
        text = f"at {when(data, chosen.step)}"
        axes.text(1.0, 1.02, text, transform=axes.transAxes, ha="right", va="bottom", fontsize="small")
