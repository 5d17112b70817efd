"""Plot of the line of a deck where it is evaluated: elevation over the seabed and plan, by set. Needs matplotlib."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mudline.basics.quantities import labelled, unit_names
from mudline.model.results.plot_data import PlotData
from mudline.model.results.plots.along_line import mark_touchdown
from mudline.model.results.plots.style import (
    MOST_POINTS,
    SEABED,
    drawing,
    finish,
    gapped,
    legend,
    legend_name,
    new_figure,
    style_of,
    thinned,
)
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Indices

_MOST_SETS = 7
_WIDTHS = (3.2, 2.2, 1.2)
"""Widths of the lines of the sets, in turn: they differ without colours."""
_AXES = "XYZ"


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
    if data is not None and data.drawn.result.positions is not None:
        places = np.where(np.isnan(data.drawn.result.positions), places, data.drawn.result.positions)
    span = np.ptp(places[_nodes(scene)], axis=0)
    along, across = (1, 2) if span[1] >= span[2] else (2, 1)
    groups = _by_set(scene)
    for axes, up, title in ((upper, 0, "Elevation"), (lower, across, "Plan")):
        for number, (name, elements) in enumerate(groups):
            kept = elements[:: max(1, -(-len(elements) // MOST_POINTS))]
            ends = places[scene.element_nodes[kept]]
            x, y = (gapped(*ends[:, :, axis].T) for axis in (along, up))
            color, width = style_of(number).color, _WIDTHS[number % len(_WIDTHS)]
            axes.plot(x, y, color=color, linewidth=width, label=legend_name(name), solid_capstyle="butt", zorder=3)
        if data is not None:
            _draw_ground(axes, data, along, up)
        unit = unit_names(scene.units).length
        axes.set_title(title, loc="right", fontsize="medium")
        axes.set_xlabel(labelled(_AXES[along], unit))
        axes.set_ylabel(labelled(_AXES[up], unit))
        finish(axes)
    if not span[across]:
        lower.set_ylim(*(places[_nodes(scene)[0], across] + np.array([-0.5, 0.5]) * max(span[along] / 20, 1)))
    legend(upper)
    return figure


def _drawn(scene: Scene) -> Indices:
    known = np.flatnonzero((scene.element_nodes >= 0).all(axis=1))
    ends = scene.coordinates[scene.element_nodes[known]]
    return known[np.isfinite(ends).all(axis=(1, 2))]


def _nodes(scene: Scene) -> Indices:
    return np.unique(scene.element_nodes[_drawn(scene)])


def _by_set(scene: Scene) -> list[tuple[str, Indices]]:
    """Return the elements by the set that assigns their law, the largest sets first; small sets together at the end."""
    drawn = _drawn(scene)
    names = np.array([scene.law_sets[index] or "without a law" for index in drawn.tolist()])
    sets, counts = np.unique(names, return_counts=True)
    order = sets[np.argsort(-counts, kind="stable")]
    groups = [(str(name), drawn[names == name]) for name in order[:_MOST_SETS]]
    others = drawn[np.isin(names, order[_MOST_SETS:])]
    return [*groups, (f"{len(order) - _MOST_SETS} more sets", others)] if others.size else groups


def _draw_ground(axes: Axes, data: PlotData, along: int, up: int) -> None:
    """Draw the seabed below the line, in elevation, and the touchdown points."""
    positions = data.drawn.result.positions
    if positions is None:
        return
    if up == 0:
        for number in data.lines:
            nodes = data.given.lines.nodes[number]
            level = data.drawn.seabed[nodes]
            kept = thinned(np.nan_to_num(level))
            place = np.asarray(positions)[nodes[kept], along]
            axes.plot(place, level[kept], color=SEABED, linewidth=1.2, linestyle="--", zorder=1)
        axes.plot([], [], color=SEABED, linestyle="--", label="seabed")
    points = data.touchdown_points(data.lines)
    x, y = ([(point.x, point.y, point.z)[axis] for point in points] for axis in (along, up))
    mark_touchdown(axes, x, y)
