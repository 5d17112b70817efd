"""The line of a deck in its own coordinates: elevation over the seabed and plan, by set. Needs matplotlib."""

from __future__ import annotations

from typing import BinaryIO, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mudline.contact.result import Part
from mudline.contact.touchdown import Touchdown
from mudline.quantities import labelled, unit_names
from mudline.results.plot_data import PlotData
from mudline.results.plots.style import MOST_POINTS, SEABED, SETTINGS, Spelled, above, finish, thinned, write
from mudline.scene.model import Scene
from mudline.scene.numbering import Floats, Indices

_MOST_SETS = 7
_GREYS = (0.0, 0.85)
"""Ends of the colour map: its lightness rises evenly, so that the colours differ when they are printed in grey."""
_WIDTHS = (3.2, 2.2, 1.2)
_AXES = "XYZ"


class _Side(NamedTuple):
    """A view: the axes along the paper and up, and its title."""

    along: int
    up: int
    title: str


def draw_model(scene: Scene, data: PlotData | None, form: str, stream: BinaryIO, spelled: Spelled) -> None:
    """Write elevation and plan as "png" or "svg"; `data` has the seabed and the touchdown points, if they are known."""
    with mpl.rc_context(SETTINGS):
        write(lambda: _figure(scene, data, spelled), form, stream)


def can_draw(scene: Scene) -> bool:
    """Whether some element has two nodes with coordinates."""
    return bool(_drawn(scene).size)


def _figure(scene: Scene, data: PlotData | None, spelled: Spelled) -> Figure:
    figure = Figure(figsize=(8.0, 5.6), layout="constrained", dpi=150)
    upper, lower = figure.subplots(2, 1, height_ratios=(3, 2))
    span = np.ptp(scene.coordinates[_nodes(scene)], axis=0)
    along, across = (1, 2) if span[1] >= span[2] else (2, 1)
    groups = _by_set(scene)
    for axes, side in ((upper, _Side(along, 0, "Elevation")), (lower, _Side(along, across, "Plan"))):
        for number, (name, elements) in enumerate(groups):
            shade = _GREYS[0] + (_GREYS[1] - _GREYS[0]) * number / max(len(groups) - 1, 1)
            look = {"color": mpl.colormaps["cividis"](shade), "linewidth": _WIDTHS[number % len(_WIDTHS)]}
            axes.plot(*_segments(scene, side, elements), label=spelled(name), solid_capstyle="butt", zorder=3, **look)
        if data is not None:
            _draw_ground(axes, data, side)
        unit = unit_names(scene.units).length
        axes.set_title(side.title, loc="right")
        axes.set_xlabel(labelled(_AXES[side.along], unit))
        axes.set_ylabel(labelled(_AXES[side.up], unit))
        finish(axes)
    if not span[across]:
        lower.set_ylim(
            *(scene.coordinates[_nodes(scene)[0], across] + np.array([-0.5, 0.5]) * max(span[along] / 20, 1))
        )
    above(upper)
    return figure


def _drawn(scene: Scene) -> Indices:
    known = np.flatnonzero((scene.element_nodes >= 0).all(axis=1))
    ends = scene.coordinates[scene.element_nodes[known]]
    return known[np.isfinite(ends).all(axis=(1, 2))]


def _nodes(scene: Scene) -> Indices:
    return np.unique(scene.element_nodes[_drawn(scene)])


def _by_set(scene: Scene) -> list[tuple[str, Indices]]:
    """The elements by the set that gives them their law, the largest sets first; the rest last, as one."""
    drawn = _drawn(scene)
    names = np.array([scene.law_sets[index] or "without a law" for index in drawn.tolist()])
    found, counts = np.unique(names, return_counts=True)
    order = found[np.argsort(-counts, kind="stable")]
    groups = [(str(name), drawn[names == name]) for name in order[:_MOST_SETS]]
    others = drawn[np.isin(names, order[_MOST_SETS:])]
    return [*groups, (f"{len(order) - _MOST_SETS} more sets", others)] if others.size else groups


def _segments(scene: Scene, side: _Side, elements: Indices) -> tuple[Floats, Floats]:
    """The elements of a set as one broken line in a view; those of a large set thinned, as far as nobody can see it."""
    kept = elements[:: max(1, -(-len(elements) // MOST_POINTS))]
    ends = scene.coordinates[scene.element_nodes[kept]]
    return _gapped(ends[:, :, side.along]), _gapped(ends[:, :, side.up])


def _gapped(ends: Floats) -> Floats:
    """Ends of segments (k, 2) as one broken line."""
    return np.column_stack([ends, np.full(len(ends), np.nan)]).ravel()


def _draw_ground(axes: Axes, data: PlotData, side: _Side) -> None:
    """The seabed below the line, in elevation, and the touchdown points."""
    positions = data.drawn.result.positions
    if positions is None:
        return
    if side.up == 0:
        for number in data.lines:
            nodes = data.given.lines.nodes[number]
            level = data.drawn.seabed[nodes]
            kept = thinned(np.nan_to_num(level))
            place = np.asarray(positions)[nodes[kept], side.along]
            axes.plot(place, level[kept], color=SEABED, linewidth=1.2, linestyle="--", zorder=1)
        axes.plot([], [], color=SEABED, linestyle="--", label="seabed")
    part = Part(data.drawn.step, data.drawn.result.as_series())
    finder = Touchdown(data.given)
    points = [point for row in finder.summaries(part, finder.series(part)) for point in row.touchdown]
    if not points:
        return
    places = [[(one.x, one.y, one.z)[axis] for one in points] for axis in (side.along, side.up)]
    axes.plot(*places, "v", color="black", markerfacecolor="white", markersize=8, label="touchdown point", zorder=5)
