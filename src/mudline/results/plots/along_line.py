"""Panels over arc length: the line on the seabed; forces, embedment and stiffness of a step, extents of all steps."""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from mudline.contact.result import Part
from mudline.contact.touchdown import Touchdown
from mudline.quantities import ELEMENTS, NODES, SLIDING, labelled, unit_names
from mudline.results.plot_data import Chosen, Envelope, PlotData
from mudline.results.plots.stretch import Stretch
from mudline.results.plots.style import (
    LIGHT,
    MOST,
    SEABED,
    STATE_STYLES,
    Style,
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
    if data.steps > 1:
        _extents(axes, data, data.force, stretch)
    if not np.nan_to_num(result.force).any() and np.nan_to_num(result.normal_force).any():
        _of_nodes(axes, result.normal_force, stretch)
        axes.set_ylabel(labelled("seabed reaction\non a node", unit_names(units).force))
    else:
        _of_elements(axes, data, result.force, stretch)
        axes.set_ylabel(ELEMENTS["force"].axis(units))
    axes.axhline(0.0, color="0.4", linewidth=0.8, zorder=1)


def embedment(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the embedment of the elements, downwards; what hangs high above does not hide how deep the rest lies."""
    if data.steps > 1:
        _extents(axes, data, data.depth, stretch)
    _of_elements(axes, data, data.drawn.result.depth, stretch)
    axes.axhline(0.0, color=SEABED, linewidth=1.2, zorder=1)
    deepest = float(np.nan_to_num(data.depth.most).max(initial=0.0))
    top, bottom = axes.get_ylim()
    if deepest > 0.0:
        top, bottom = min(max(top, -0.6 * deepest), -0.06 * deepest), 1.08 * deepest
    if is_number(top) and is_number(bottom):
        axes.set_ylim(bottom, top)
    axes.set_ylabel(ELEMENTS["depth"].axis(data.given.units))


def stiffness(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the stiffness of the seabed under the elements."""
    _of_elements(axes, data, data.drawn.result.stiffness, stretch)
    axes.set_ylabel(ELEMENTS["stiffness"].axis(data.given.units))


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


def _extents(axes: Axes, data: PlotData, found: Envelope, stretch: Stretch) -> None:
    """Shade what lies between the least and the largest values of the elements over all steps."""
    for place, number in enumerate(stretch.lines):
        elements = stretch.elements(number)
        drawn = elements[thinned(found.most[elements])]
        arcs = data.given.lines.element_arc[drawn]
        color = stretch.style(place).color
        label = None if place else "least to largest of all steps"
        axes.fill_between(arcs, found.least[drawn], found.most[drawn], color=color, alpha=0.2, linewidth=0, label=label)
    above(axes)


def _step_note(axes: Axes, data: PlotData, chosen: Chosen) -> None:
    """Write the time of a step on a panel of a series that shows another one than the others do."""
    if data.steps > 1:
        text = f"at {when(data, chosen.step)}"
        axes.text(1.0, 1.02, text, transform=axes.transAxes, ha="right", va="bottom", fontsize="small")


# ----------------------------------------------------------------------------------------------- the line on the seabed

_HIGHEST = (25.0, 5.0)
"""How high above the seabed a line is drawn, as a multiple of the deepest embedment and of the largest diameter."""
_LABELLED_POINTS = 3
"""Touchdown points whose arc length is written beside them, if there are no more."""


def line(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the lines on the seabed, thick where they touch it, with their touchdown points."""
    chosen = data.drawn
    heights, seabed = chosen.heights, chosen.seabed
    for place, number in enumerate(stretch.lines):
        nodes, arcs = stretch.nodes(number)
        drawn = thinned(chosen.result.gap[nodes])
        axes.plot(arcs[drawn], seabed[nodes[drawn]], color=SEABED, linewidth=1.2, linestyle="-", zorder=1)
        style = stretch.style(place)
        axes.plot(
            arcs[drawn], heights[nodes[drawn]], color=style.color, linestyle=style.linestyle, linewidth=1.1, zorder=3
        )
        _thick(axes, data, heights, number, stretch, style)
    _crop(axes, data, chosen, stretch)
    _touchdown_points(axes, data, chosen, stretch)
    if len(stretch.lines) == 1:
        _soil(axes, chosen, stretch)
    axes.set_ylabel(NODES["x"].axis(data.given.units))
    handles: list[Artist] = [*_line_handles(stretch)]
    handles += [
        Line2D([], [], color=stretch.style(0).color, linewidth=3.5, label="in contact"),
        Line2D([], [], color=SEABED, linewidth=1.2, label="seabed"),
    ]
    handles += axes.get_legend_handles_labels()[0]
    legend_above(axes, handles)


def _crop(axes: Axes, data: PlotData, chosen: Chosen, stretch: Stretch) -> None:
    """Leave out what hangs so high that nothing would be seen of how the line lies on the seabed."""
    nodes = np.concatenate([stretch.nodes(number)[0] for number in stretch.lines])
    near = nodes[chosen.result.gap[nodes] <= highest(data)]
    if not near.size:
        return
    drawn = np.concatenate([chosen.heights[near], chosen.seabed[near]])
    low, high = float(np.nanmin(drawn)), float(np.nanmax(drawn))
    if len(near) < len(nodes) and is_number(low) and is_number(high) and high > low:
        axes.set_ylim(low - 0.05 * (high - low), high)


def highest(data: PlotData) -> float:
    """How high above the seabed a line is drawn, if something touches the seabed."""
    sizes = (np.nan_to_num(data.depth.most), np.nan_to_num(data.given.diameter))
    return max(times * float(values.max(initial=0.0)) for times, values in zip(_HIGHEST, sizes, strict=True))


def _thick(axes: Axes, data: PlotData, heights: Floats, number: int, stretch: Stretch, style: Style) -> None:
    """Draw the elements of a line that touch the seabed over it."""
    lines = data.given.lines
    shown = np.zeros(len(data.given.element_ids), np.bool_)
    shown[stretch.elements(number)] = True
    shown &= data.drawn.result.contact
    here = np.flatnonzero(shown[lines.elements[number]])
    if not here.size:
        return
    arcs, along = lines.node_arcs(number, data.given.length), heights[lines.nodes[number]]
    here = here[thinned(np.nan_to_num(along[here]), MOST)]
    none = np.full(len(here), np.nan)
    x, y = (np.column_stack([values[here], values[here + 1], none]).ravel() for values in (arcs, along))
    axes.plot(x, y, color=style.color, linewidth=3.5, solid_capstyle="butt", zorder=2)


def _touchdown_points(axes: Axes, data: PlotData, chosen: Chosen, stretch: Stretch) -> None:
    """Mark where the lines come down on the seabed or leave it."""
    series = chosen.result.as_series()
    finder, part = Touchdown(data.given), Part(chosen.step, series)
    wanted = [one for one in finder.series(part) if one.number in stretch.lines]
    points = [point for summary in finder.summaries(part, wanted) for point in summary.touchdown]
    low, high = stretch.limits
    points = [point for point in points if low <= point.arc_length <= high]
    if not points:
        return
    x, y = [point.arc_length for point in points], [point.x for point in points]
    size = 8.0 if len(points) <= 12 else 5.0
    axes.plot(
        x,
        y,
        linestyle="none",
        marker="v",
        markersize=size,
        color="black",
        markerfacecolor="white",
        zorder=5,
        label="touchdown point",
    )
    if len(points) > _LABELLED_POINTS:
        return
    unit = unit_names(data.given.units).length
    for point in points:
        right = point.arc_length < 0.5 * (low + high)
        axes.annotate(
            f"TDP {point.arc_length:.5g} {unit}".rstrip(),
            (point.arc_length, point.x),
            (8.0 if right else -8.0, 9.0),
            textcoords="offset points",
            ha="left" if right else "right",
            fontsize="small",
            bbox={"boxstyle": "square,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.8},
            zorder=6,
        )


def _soil(axes: Axes, chosen: Chosen, stretch: Stretch) -> None:
    """Fill what lies below the seabed."""
    nodes, arcs = stretch.nodes(stretch.lines[0])
    drawn = thinned(chosen.result.gap[nodes])
    level = chosen.seabed[nodes[drawn]]
    if not np.isfinite(level).any():
        return
    lowest, highest = axes.get_ylim()
    least = float(np.nanmin(level))
    bottom = min(lowest, least - 0.12 * (highest - least))
    if not (is_number(bottom) and is_number(highest)):
        return
    axes.fill_between(arcs[drawn], level, bottom, color=LIGHT, linewidth=0.0, zorder=0)
    axes.set_ylim(bottom, highest + 0.04 * (highest - bottom))


def _line_handles(stretch: Stretch) -> list[Line2D]:
    """What a legend has of the lines: nothing for a single one."""
    handles = []
    for place, number in enumerate(stretch.lines if len(stretch.lines) > 1 else ()):
        style = stretch.style(place)
        handles.append(
            Line2D(
                [],
                [],
                color=style.color,
                linestyle=style.linestyle,
                marker=style.marker,
                markersize=4,
                label=stretch.name(number),
            )
        )
    if stretch.left_out:
        handles.append(Line2D([], [], linestyle="none", label=f"and {stretch.left_out} more lines"))
    return handles


PANELS = {
    "line": line,
    "force": force,
    "suction": suction,
    "friction": friction,
    "embedment": embedment,
    "stiffness": stiffness,
}
"""By name, in the order in which they are drawn."""
