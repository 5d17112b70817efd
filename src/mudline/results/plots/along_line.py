"""Panels over arc length: the line on the seabed; forces, embedment and stiffness of a step, extents of all steps."""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from mudline.contact.result import Part
from mudline.contact.touchdown import Touchdown
from mudline.quantities import ELEMENTS, NODES, SLIDING, labelled, unit_names
from mudline.results.plot_data import Chosen, Extents, PlotData
from mudline.results.plots.style import (
    LIGHT,
    MOST_POINTS,
    SEABED,
    STATE_STYLES,
    Stretch,
    Style,
    above,
    is_number,
    marker_of,
    style_of,
    thinned,
    when,
    widen,
)
from mudline.scene.numbering import Floats, Indices

_MARKED = 80
"""Slipping nodes of a line that are marked."""


def force(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the seabed reaction of the elements; that on the nodes, where only springs of nodes act."""
    result, units = data.drawn.result, data.given.units
    _extents(axes, data, data.force, stretch)
    if not np.nan_to_num(result.force).any() and np.nan_to_num(result.normal_force).any():
        for place, number in enumerate(stretch.lines):
            _plot(axes, stretch.nodes(number), result.normal_force, stretch.style(place))
        axes.set_ylabel(labelled("seabed reaction\non a node", unit_names(units).force))
    else:
        _of_elements(axes, result.force, stretch)
        axes.set_ylabel(ELEMENTS["force"].axis(units))
    _zero(axes)


def embedment(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the embedment of the elements, downwards; what hangs high above does not hide how deep the rest lies."""
    _extents(axes, data, data.depth, stretch)
    _of_elements(axes, data.drawn.result.depth, stretch)
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
    _of_elements(axes, data.drawn.result.stiffness, stretch)
    axes.set_ylabel(ELEMENTS["stiffness"].axis(data.given.units))


def suction(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw what holds the line down per unit length, with the states of suction, when the pull is largest."""
    chosen = data.pulled or data.drawn
    pull = np.maximum(0.0 - chosen.result.force, 0.0)
    _of_elements(axes, pull, stretch, mark=False)
    states = chosen.result.state
    if states is not None:
        drawn = np.concatenate([stretch.elements(number)[0] for number in stretch.lines])
        for index, (name, style) in enumerate(STATE_STYLES.items()):
            mine = drawn[states[drawn] == index]
            if mine.size:
                shown = mine[thinned(pull[mine], 400)]
                points = data.given.lines.element_arc[shown], pull[shown]
                axes.plot(*points, style.marker, markersize=4, color=style.color, label=name, zorder=4)
    above(axes, note=_step_note(data, chosen))
    axes.set_ylabel(labelled("suction\nper unit length", unit_names(data.given.units).line_force))


def friction(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the axial and the lateral force on the nodes, crossed where they slip, when the largest of them acts."""
    chosen = data.slid or data.drawn
    result = chosen.result
    if result.friction is None:
        return
    slips = False
    for side, name in enumerate(("axial", "lateral")):
        style, values = style_of(side)._replace(marker=""), result.friction[:, side]
        for place, number in enumerate(stretch.lines):
            nodes, arcs = stretch.nodes(number)
            _plot(axes, (nodes, arcs), values, style, None if place else name)
            at = np.flatnonzero(result.friction_state_of(side)[nodes] == SLIDING.index("slip"))
            at = at[:: max(1, len(at) // _MARKED)]
            slips = slips or bool(at.size)
            axes.plot(arcs[at], values[nodes[at]], "x", markersize=4, color=style.color)
    if slips:
        axes.plot([], [], "x", markersize=4, color="0.2", label="slips")
    _zero(axes)
    axes.set_ylabel(labelled("friction on a node", unit_names(data.given.units).force))
    above(axes, note=_step_note(data, chosen))


def _of_elements(axes: Axes, values: Floats, stretch: Stretch, *, mark: bool = True) -> None:
    """Draw values (m,) of the elements over the arc length of their middles."""
    seen = [np.zeros(0)]
    for place, number in enumerate(stretch.lines):
        rows, arcs = stretch.elements(number)
        style = stretch.style(place)
        _plot(axes, (rows, arcs), values, style if mark else style._replace(marker=""))
        seen.append(values[rows])
    widen(axes, np.concatenate(seen))


def _plot(axes: Axes, along: tuple[Indices, Floats], values: Floats, style: Style, label: str | None = None) -> None:
    """Draw values of some rows of elements or nodes, given with their arc lengths."""
    rows, arcs = along
    kept = thinned(values[rows])
    points = marker_of(style, len(kept))
    axes.plot(
        arcs[kept],
        values[rows[kept]],
        color=style.color,
        linestyle=style.linestyle,
        linewidth=1.3,
        marker=points,
        markersize=3,
        label=label,
    )


def _extents(axes: Axes, data: PlotData, found: Extents, stretch: Stretch) -> None:
    """Shade what lies between the least and the largest values of the elements over the steps of a series."""
    if data.steps == 1:
        return
    for place, number in enumerate(stretch.lines):
        rows, arcs = stretch.elements(number)
        kept = thinned(found.most[rows])
        edges, color = (found.least[rows[kept]], found.most[rows[kept]]), stretch.style(place).color
        label = None if place else "least to largest of all steps"
        axes.fill_between(arcs[kept], *edges, color=color, alpha=0.2, linewidth=0.0, label=label)
    above(axes)


def _zero(axes: Axes) -> None:
    axes.axhline(0.0, color="0.4", linewidth=0.8, zorder=1)


def _step_note(data: PlotData, chosen: Chosen) -> str:
    """The time of a step, for a panel of a series that shows another one than the others do."""
    return f"at {when(data, chosen.step)}" if data.steps > 1 else ""


# ----------------------------------------------------------------------------------------------- the line on the seabed

_HIGHEST = (25.0, 5.0)
"""How high above the seabed a line is drawn, as a multiple of the deepest embedment and of the largest diameter."""
_LABELLED_POINTS = 3
"""Touchdown points whose arc length is written beside them, if there are no more."""


def line(axes: Axes, data: PlotData, stretch: Stretch) -> None:
    """Draw the lines on the seabed, thick where they touch it, with their touchdown points."""
    chosen = data.drawn
    heights, seabed, touching = chosen.heights, chosen.seabed, False
    for place, number in enumerate(stretch.lines):
        nodes, arcs = stretch.nodes(number)
        drawn, style = thinned(chosen.result.gap[nodes]), stretch.style(place)
        axes.plot(arcs[drawn], seabed[nodes[drawn]], color=SEABED, linewidth=1.2, zorder=1)
        look = {"color": style.color, "linestyle": style.linestyle}
        axes.plot(arcs[drawn], heights[nodes[drawn]], linewidth=1.1, zorder=3, **look)  # type: ignore[arg-type]
        touching |= _thick(axes, data, heights, number, style)
    _crop(axes, data, chosen, stretch)
    _touchdown_points(axes, data, chosen, stretch)
    if len(stretch.lines) == 1:
        _soil(axes, chosen, stretch)
    axes.set_ylabel(NODES["x"].axis(data.given.units))
    thick = Line2D([], [], color=stretch.style(0).color, linewidth=3.5, label="in contact")
    handles: list[Artist] = [
        *_line_handles(stretch),
        *([thick] if touching else []),
        Line2D([], [], color=SEABED, linewidth=1.2, label="seabed"),
        *axes.get_legend_handles_labels()[0],
    ]
    above(axes, handles)


def _crop(axes: Axes, data: PlotData, chosen: Chosen, stretch: Stretch) -> None:
    """Leave out what hangs so high that nothing would be seen of how the line lies on the seabed."""
    sizes = (np.nan_to_num(data.depth.most), np.nan_to_num(data.given.diameter))
    most = max(times * float(values.max(initial=0.0)) for times, values in zip(_HIGHEST, sizes, strict=True))
    nodes = np.concatenate([stretch.nodes(number)[0] for number in stretch.lines])
    near = nodes[chosen.result.gap[nodes] <= most]
    if not near.size:
        return
    drawn = np.concatenate([chosen.heights[near], chosen.seabed[near]])
    low, high = float(np.nanmin(drawn)), float(np.nanmax(drawn))
    if len(near) < len(nodes) and is_number(low) and is_number(high) and high > low:
        axes.set_ylim(low - 0.05 * (high - low), high)


def _thick(axes: Axes, data: PlotData, heights: Floats, number: int, style: Style) -> bool:
    """Draw the elements of a line that touch the seabed over it; return whether there are any."""
    lines = data.given.lines
    here = np.flatnonzero(data.drawn.result.contact[lines.elements[number]])
    if not here.size:
        return False
    arcs, along = lines.node_arcs(number, data.given.length), heights[lines.nodes[number]]
    here = here[thinned(np.nan_to_num(along[here]), MOST_POINTS)]
    none = np.full(len(here), np.nan)
    x, y = (np.column_stack([values[here], values[here + 1], none]).ravel() for values in (arcs, along))
    axes.plot(x, y, color=style.color, linewidth=3.5, solid_capstyle="butt", zorder=2)
    return True


def _touchdown_points(axes: Axes, data: PlotData, chosen: Chosen, stretch: Stretch) -> None:
    """Mark where the lines come down on the seabed or leave it."""
    finder, part = Touchdown(data.given), Part(chosen.step, chosen.result.as_series())
    wanted = [one for one in finder.series(part) if one.number in stretch.lines]
    low, high = stretch.limits
    points = [
        point
        for summary in finder.summaries(part, wanted)
        for point in summary.touchdown
        if low <= point.arc_length <= high
    ]
    if not points:
        return
    places = [point.arc_length for point in points], [point.x for point in points]
    size, look = (8.0 if len(points) <= 12 else 5.0), {"color": "black", "markerfacecolor": "white", "zorder": 5}
    axes.plot(*places, "v", markersize=size, label="touchdown point", **look)  # type: ignore[arg-type]
    unit = unit_names(data.given.units).length
    labelled = points if len(points) <= _LABELLED_POINTS else []
    for number, point in enumerate(sorted(labelled, key=lambda one: one.arc_length)):
        right, above = point.arc_length < 0.5 * (low + high), number % 2 == 0
        axes.annotate(
            f"TDP {point.arc_length:.5g} {unit}".rstrip(),
            (point.arc_length, point.x),
            (8.0 if right else -8.0, 9.0 if above else -9.0),
            textcoords="offset points",
            ha="left" if right else "right",
            va="bottom" if above else "top",
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
    room = 0.1 if len(axes.texts) > 1 else 0.04  # of the labels of touchdown points at the top
    axes.set_ylim(bottom, highest + room * (highest - bottom))


def _line_handles(stretch: Stretch) -> list[Line2D]:
    """What a legend has of the lines: nothing for a single one."""
    styles = [(number, stretch.style(place)) for place, number in enumerate(stretch.lines)]
    handles = [
        Line2D([], [], color=style.color, linestyle=style.linestyle, marker=style.marker, label=stretch.name(number))
        for number, style in (styles if len(styles) > 1 else ())
    ]
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
"""By name."""
