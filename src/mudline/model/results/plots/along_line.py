"""Panels over arc length: the line on the seabed; forces, embedment and stiffness of a step, extremes of all steps."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.text import Annotation

from mudline.basics.quantities import ELEMENTS, NODES, SLIDING, STATES, labelled
from mudline.basics.units import UNITS
from mudline.model.results.extremes import Extremes
from mudline.model.results.plot_data import Chosen, PlotData
from mudline.model.results.plots.style import (
    SEABED,
    STATE_STYLES,
    Style,
    draw_line,
    gapped,
    legend,
    style_of,
    thinned,
    widen,
    zero_line,
)
from mudline.model.results.totals import carried
from mudline.model.scene.numbering import Floats, Indices

MOST_LINES = 6
"""Largest number of drawn lines."""
_BESIDE, _BESIDE_CHANGES = (0.15, 2.0), (0.5, 3.0)
"""Part of the stretch in contact, or of that with changes, drawn on both sides of it; at least so many elements."""
_CHANGE = 0.01
"""Change of the embedment between neighbours where contact changes, as a part of the deepest embedment."""
_MARKED = 80
"""Largest number of marked slipping nodes of a line."""
_SOIL = "#e9dfd0"
"""Colour below the seabed."""


class DrawnLine(NamedTuple):
    """A line within the stretch, and one element on both sides of it.

    Attributes:
        number: its number, from 0.
        style: its style.
        elements, element_arcs: its evaluated elements, and the arc lengths of their middles.
        nodes, node_arcs: its nodes and their arc lengths.
    """

    number: int
    style: Style
    elements: Indices
    element_arcs: Floats
    nodes: Indices
    node_arcs: Floats


class DrawnStretch:
    """The drawn lines, and the stretch of arc length of all panels along them: where contact changes.

    Attributes:
        limits: the least and the largest drawn arc length.
        beyond: text about parts that are not drawn: parts of the line that lie on the seabed without a change.
        lines: the drawn lines: those that touch the seabed first.
        left_out: the number of lines that are not drawn.
    """

    def __init__(self, data: PlotData) -> None:
        self.data, lines = data, data.given.lines
        of_touched = set(lines.of_element[data.touched].tolist())
        drawn = sorted(sorted(data.lines, key=lambda line: (line not in of_touched, line))[:MOST_LINES])
        self.left_out = data.more_lines + len(data.lines) - len(drawn)
        evaluated = np.zeros(len(data.given.element_ids), np.bool_)
        evaluated[data.elements] = True
        shown = np.isin(lines.of_element, drawn) & evaluated
        half = 0.5 * data.given.length
        begin, end = lines.element_arc - half, lines.element_arc + half
        self.limits = (float(begin[shown].min()), float(end[shown].max())) if drawn else (0.0, 1.0)
        touching = shown & data.touched
        changes = np.concatenate([np.zeros(0, np.intp), *map(self._changes, drawn)])
        for part, share, lengths in ((np.flatnonzero(touching), *_BESIDE), (changes, *_BESIDE_CHANGES)):
            if part.size:
                low, high = float(begin[part].min()), float(end[part].max())
                beside = max(share * (high - low), lengths * float(data.given.length[part].max()))
                self.limits = max(self.limits[0], low - beside), min(self.limits[1], high + beside)
        sides = (touching & (end <= self.limits[0]), touching & (begin >= self.limits[1])) if changes.size else ()
        parts = [f"{begin[side].min():.5g} to {end[side].max():.5g}" for side in sides if side.any()]
        where = f"{' and '.join(parts)}{UNITS[data.given.units].behind('L')}"
        self.beyond = f"where contact changes: {where} in contact, not drawn" if parts else ""
        self.lines = []
        for place, line in enumerate(drawn):
            elements = lines.elements[line][evaluated[lines.elements[line]]]
            arcs, node_arcs = lines.element_arc[elements], lines.arcs[line]
            here, near = self._within(arcs), self._within(node_arcs)
            nodes = lines.nodes[line][near]
            self.lines.append(DrawnLine(line, style_of(place), elements[here], arcs[here], nodes, node_arcs[near]))

    def _changes(self, line: int) -> Indices:
        """Return the elements of a line where contact begins or ends, or the embedment changes, at any step."""
        data, elements = self.data, self.data.given.lines.elements[line]
        elements = elements[np.isin(elements, data.elements)]
        touched, depths = data.touched[elements], (data.depth.least.values, data.depth.largest.values)
        deepest = float(np.nan_to_num(depths[1]).max(initial=0.0))
        steps = [np.abs(np.diff(np.nan_to_num(each[elements]))) for each in depths]
        differs = (np.maximum(*steps) > _CHANGE * deepest) | (touched[1:] != touched[:-1])
        at = np.flatnonzero(differs & (touched[1:] | touched[:-1]))
        return elements[np.union1d(at, at + 1)]

    def name(self, line: DrawnLine) -> str:
        """Return the name of a line in a legend."""
        ids = self.data.given.element_ids[self.data.given.lines.elements[line.number]]
        return f"line {line.number + 1}: elements {ids[0]} to {ids[-1]}"

    def _within(self, arcs: Floats) -> slice:
        inside = np.flatnonzero((arcs >= self.limits[0]) & (arcs <= self.limits[1]))
        return slice(max(0, int(inside[0]) - 1), int(inside[-1]) + 2) if inside.size else slice(0, 0)

    def show(self, axes: Axes) -> None:
        """Set the horizontal axis."""
        low, high = self.limits
        beside = 0.01 * (high - low) or 0.5
        if _is_number(low, high):
            axes.set_xlim(low - beside, high + beside)
        axes.set_xlabel(labelled("arc length along the line", UNITS[self.data.given.units].unit("L")))


def force(axes: Axes, stretch: DrawnStretch) -> None:
    """Draw the seabed reaction of the elements, or on the nodes if only springs of nodes act."""
    data, result, units = stretch.data, stretch.data.drawn.result, stretch.data.given.units
    _extremes(axes, data.force, stretch)
    if not np.nan_to_num(result.force).any() and np.nan_to_num(result.normal_force).any():
        for line in stretch.lines:
            draw_line(axes, line.node_arcs, result.normal_force[line.nodes], line.style)
        axes.set_ylabel(labelled("seabed reaction\non a node", UNITS[units].unit("F")))
    else:
        _of_elements(axes, result.force, stretch)
        axes.set_ylabel(ELEMENTS["force"].axis(units))
        arcs, forces = data.given.lines.element_arc, np.nan_to_num(data.force.largest.values)
        at = int(np.argmax(forces))
        if not stretch.limits[0] <= arcs[at] <= stretch.limits[1] and forces[at] > 0.0:
            system = UNITS[units]
            where = f"at {arcs[at]:.5g}{system.behind('L')}"
            legend(axes, note=f"largest {forces[at]:.5g}{system.behind('F/L')} {where}, not drawn")
    zero_line(axes)


def embedment(axes: Axes, stretch: DrawnStretch) -> None:
    """Draw the embedment of the elements, downwards; parts that hang high do not hide the embedment of the others."""
    data = stretch.data
    _extremes(axes, data.depth, stretch)
    _of_elements(axes, data.drawn.result.depth, stretch)
    axes.axhline(0.0, color=SEABED, linewidth=1.2, zorder=1)
    deepest = float(np.nan_to_num(data.depth.largest.values).max(initial=0.0))
    top, bottom = axes.get_ylim()
    if deepest > 0.0:
        top, bottom = min(max(top, -0.6 * deepest), -0.06 * deepest), 1.08 * deepest
    if _is_number(top, bottom):
        axes.set_ylim(bottom, top)
    axes.set_ylabel(ELEMENTS["depth"].axis(data.given.units))


def stiffness(axes: Axes, stretch: DrawnStretch) -> None:
    """Draw the stiffness of the seabed under the elements."""
    _of_elements(axes, stretch.data.drawn.result.stiffness, stretch)
    axes.set_ylabel(ELEMENTS["stiffness"].axis(stretch.data.given.units))


def suction(axes: Axes, stretch: DrawnStretch) -> None:
    """Draw the pull of the seabed per unit length, with the states of suction, at the step of the largest pull."""
    data, chosen = stretch.data, stretch.data.largest["pull"]
    pull, states = np.maximum(0.0 - chosen.result.force, 0.0), chosen.result.state
    _of_elements(axes, pull, stretch, mark=False)
    if states is not None:
        drawn = np.concatenate([line.elements for line in stretch.lines])
        for name, style in STATE_STYLES.items():
            in_state = drawn[states[drawn] == STATES.index(name)]
            if in_state.size:
                shown = in_state[thinned(pull[in_state], 400)]
                points = data.given.lines.element_arc[shown], pull[shown]
                axes.plot(*points, style.marker, markersize=4, color=style.color, label=name, zorder=4)
    legend(axes, note=_step_note(data, chosen))
    axes.set_ylabel(labelled("suction\nper unit length", UNITS[data.given.units].unit("F/L")))


def friction(axes: Axes, stretch: DrawnStretch) -> None:
    """Draw the axial and the lateral force on the nodes, crossed where they slip, at the step of the largest force."""
    data, chosen = stretch.data, stretch.data.largest["friction"]
    forces, slips = chosen.result.friction, False
    if forces is None:
        return
    for side, name in enumerate(("axial", "lateral")):
        style = style_of(side)._replace(marker="")
        for line in stretch.lines:
            values = forces[line.nodes, side]
            draw_line(axes, line.node_arcs, values, style, name if line is stretch.lines[0] else None)
            at = np.flatnonzero(chosen.result.friction_state_of(side)[line.nodes] == SLIDING.index("slip"))
            at = at[:: max(1, len(at) // _MARKED)]
            slips = slips or bool(at.size)
            axes.plot(line.node_arcs[at], values[at], "x", markersize=4, color=style.color)
    if slips:
        axes.plot([], [], "x", markersize=4, color="0.2", label="slips")
    zero_line(axes)
    axes.set_ylabel(labelled("friction on a node", UNITS[data.given.units].unit("F")))
    legend(axes, note=_step_note(data, chosen))


def _is_number(*values: float) -> bool:
    """Return True if an axis can show these values: very large ones overflow in the transforms of the figure."""
    return all(math.isfinite(value) and abs(value) < 1e150 for value in values)


def _of_elements(axes: Axes, values: Floats, stretch: DrawnStretch, *, mark: bool = True) -> None:
    """Draw values (m,) of the elements over the arc length of their middles."""
    for line in stretch.lines:
        style = line.style if mark else line.style._replace(marker="")
        draw_line(axes, line.element_arcs, values[line.elements], style)
    widen(axes, np.concatenate([np.zeros(0), *(values[line.elements] for line in stretch.lines)]))


def _extremes(axes: Axes, extremes: Extremes, stretch: DrawnStretch) -> None:
    """Shade the range between the least and the largest values of the elements over the steps of a series."""
    if stretch.data.steps == 1:
        return
    for line in stretch.lines:
        kept = thinned(extremes.largest.values[line.elements])
        least, most = (each.values[line.elements[kept]] for each in (extremes.least, extremes.largest))
        label = "least to largest of all steps" if line is stretch.lines[0] else None
        arcs, color = line.element_arcs[kept], line.style.color
        axes.fill_between(arcs, least, most, color=color, alpha=0.2, linewidth=0.0, label=label)
    legend(axes)


def when(data: PlotData, step: int) -> str:
    """Return the time of a step, as text; "" for a state without a time."""
    if data.times is None:
        return "" if data.steps == 1 else f"step {step}"
    return f"time {float(data.times[step]):.6g}{UNITS[data.given.units].behind('T')}"


def _step_note(data: PlotData, chosen: Chosen) -> str:
    """Return the time of a step, for a panel of a series that shows another step than the other panels."""
    return f"at {when(data, chosen.step)}" if data.steps > 1 else ""


# ----------------------------------------------------------------------------------------------- the line on the seabed

_HIGHEST = (25.0, 5.0)
"""Height above the seabed up to which a line is drawn, in deepest embedments and in largest diameters."""
_LABELLED_POINTS = 3
"""Number of touchdown points up to which their arc length is written next to them."""


def line(axes: Axes, stretch: DrawnStretch) -> None:
    """Draw the lines on the seabed, thick where they touch it, with their touchdown points."""
    data, touching = stretch.data, False
    heights, seabed = data.drawn.places[:, 0], data.drawn.seabed
    for drawn_line in stretch.lines:
        drawn = thinned(data.drawn.result.gap[drawn_line.nodes])
        arcs, nodes = drawn_line.node_arcs[drawn], drawn_line.nodes[drawn]
        axes.plot(arcs, seabed[nodes], color=SEABED, linewidth=1.2, zorder=1)
        axes.plot(arcs, heights[nodes], linewidth=1.1, zorder=3, **drawn_line.style.line)
        touching |= _thick(axes, data, drawn_line)
    _crop(axes, stretch)
    _touchdown_points(axes, stretch)
    if len(stretch.lines) == 1:
        _soil(axes, data.drawn, stretch.lines[0])
    axes.set_ylabel(NODES["x"].axis(data.given.units))
    handles: list[Artist] = [
        Line2D([], [], **drawn_line.style.line, marker=drawn_line.style.marker, label=stretch.name(drawn_line))
        for drawn_line in (stretch.lines if len(stretch.lines) > 1 else ())
    ]
    if stretch.left_out:
        handles.append(Line2D([], [], linestyle="none", label=f"and {stretch.left_out} more lines"))
    if touching:
        handles.append(Line2D([], [], color=stretch.lines[0].style.color, linewidth=3.5, label="in contact"))
    handles.append(Line2D([], [], color=SEABED, linewidth=1.2, label="seabed"))
    legend(axes, [*handles, *axes.get_legend_handles_labels()[0]])


def _crop(axes: Axes, stretch: DrawnStretch) -> None:
    """Crop parts that hang so high that nothing of the contact with the seabed would be seen."""
    data = stretch.data
    sizes = (np.nan_to_num(data.depth.largest.values), np.nan_to_num(data.given.diameter))
    most = max(times * float(values.max(initial=0.0)) for times, values in zip(_HIGHEST, sizes, strict=True))
    nodes = np.concatenate([line.nodes for line in stretch.lines])
    near = nodes[data.drawn.result.gap[nodes] <= most]
    if not 0 < len(near) < len(nodes):
        return
    drawn = np.concatenate([data.drawn.places[near, 0], data.drawn.seabed[near]])
    low, high = float(np.nanmin(drawn)), float(np.nanmax(drawn))
    if _is_number(low, high) and high > low:
        axes.set_ylim(low - 0.05 * (high - low), high)


def _thick(axes: Axes, data: PlotData, drawn_line: DrawnLine) -> bool:
    """Draw the elements of a line that touch the seabed over it; return True if there are any."""
    lines, heights = data.given.lines, data.drawn.places[:, 0]
    here = np.flatnonzero(carried(data.drawn.result)[lines.elements[drawn_line.number]])
    arcs, along = lines.arcs[drawn_line.number], heights[lines.nodes[drawn_line.number]]
    here = here[thinned(np.nan_to_num(along[here]))] if here.size else here
    x, y = (gapped(values[here], values[here + 1]) for values in (arcs, along))
    axes.plot(x, y, color=drawn_line.style.color, linewidth=3.5, solid_capstyle="butt", zorder=2)
    return bool(here.size)


def _touchdown_points(axes: Axes, stretch: DrawnStretch) -> None:
    """Mark the touchdown points of the lines."""
    low, high = stretch.limits
    at_step = stretch.data.touchdown_points([line.number for line in stretch.lines])
    points = sorted((point for point in at_step if low <= point.arc_length <= high), key=lambda point: point.arc_length)
    mark_touchdown(axes, [point.arc_length for point in points], [point.x for point in points])
    unit = UNITS[stretch.data.given.units].behind("L")
    for number, point in enumerate(points if len(points) <= _LABELLED_POINTS else ()):
        right, above = point.arc_length < 0.5 * (low + high), number % 2 == 0
        axes.annotate(
            f"TDP {point.arc_length:.5g}{unit}",
            (point.arc_length, point.x),
            (8.0 if right else -8.0, 9.0 if above else -9.0),
            textcoords="offset points",
            ha="left" if right else "right",
            va="bottom" if above else "top",
            fontsize="small",
            bbox={"boxstyle": "square,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.8},
            zorder=6,
        )


def mark_touchdown(axes: Axes, x: list[float], y: list[float]) -> None:
    """Mark touchdown points, if there are any."""
    if x:
        size = 8.0 if len(x) <= 12 else 5.0
        axes.plot(x, y, "v", color="black", markerfacecolor="white", markersize=size, label="touchdown point", zorder=5)


def _soil(axes: Axes, chosen: Chosen, drawn_line: DrawnLine) -> None:
    """Fill the area below the seabed."""
    drawn = thinned(chosen.result.gap[drawn_line.nodes])
    level = chosen.seabed[drawn_line.nodes[drawn]]
    if not np.isfinite(level).any():
        return
    lowest, highest = axes.get_ylim()
    least = float(np.nanmin(level))
    bottom = min(lowest, least - 0.12 * (highest - least))
    if _is_number(bottom, highest):
        axes.fill_between(drawn_line.node_arcs[drawn], level, bottom, color=_SOIL, linewidth=0.0, zorder=0)
        upper = highest - 0.1 * (highest - bottom)
        labelled_above = any(isinstance(text, Annotation) and text.xy[1] > upper for text in axes.texts)
        margin = 0.16 if labelled_above else 0.04  # a label has its place below the legend
        axes.set_ylim(bottom, highest + margin * (highest - bottom))
