"""The pictures: force-embedment curves; an evaluation with the line, embedment, stiffness, curves and traces."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any, BinaryIO

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from mudline.quantities import ELEMENTS, STEPS, headed, labelled, unit_names
from mudline.results.totals import TRACED, Chosen, PlotData
from mudline.scene.numbering import Floats, Indices, Mask
from mudline.short_repr import cut

_Panel = Callable[[Axes], None]
_Spelled = Callable[[str], str]


def _write(make: Callable[[], Figure], form: str, stream: BinaryIO) -> None:
    """Write a picture; the same one gives the same bytes."""
    with mpl.rc_context({"svg.hashsalt": "mudline"}), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a letter that the font lacks becomes a box
        make().savefig(stream, format=form, metadata={"Date": None} if form == "svg" else None)


# ------------------------------------------------------------------------------------------------------- of curves

_MARGIN = 0.15
"""Part of its largest ratio by which a curve is drawn beyond its last point."""
_CYCLE = 10
"""Colours that matplotlib gives one after the other."""
_MARKERS = ("o", "s", "^", "v", "P")
"""The next one when the colours are used up."""
_MOST_MARKED = 60
"""Points of longer curves are not marked one by one."""

_DASHED = Line2D([], [], color="0.3", linestyle="--", linewidth=1.2)
_ASKED = Line2D([], [], color="0.3", linestyle="none", marker="x", markersize=8, markeredgewidth=1.5)
_STATIC = Line2D([], [], color="0.3", linestyle="none", marker="D", markersize=7, markerfacecolor="none")


def draw_curves(rows: list[dict[str, Any]], units: str, form: str, stream: BinaryIO) -> None:
    """Write a picture ("png" or "svg") of all curves, dashed beyond their points, with the values asked for."""
    _write(lambda: _curves(rows, units), form, stream)


def _curves(rows: list[dict[str, Any]], units: str) -> Figure:
    figure = Figure(figsize=(8, max(5.0, 1.5 + 0.21 * len(rows))), layout="constrained", dpi=150)
    axes = figure.add_subplot()
    handles = [_curve(axes, row, _MARKERS[index // _CYCLE % len(_MARKERS)]) for index, row in enumerate(rows)]
    axes.axhline(0.0, color="0.4", linewidth=0.8, zorder=1)
    axes.axvline(0.0, color="0.4", linewidth=0.8, zorder=1)
    unit = unit_names(units).line_force or "force per length"
    axes.set_xlabel(labelled(ELEMENTS["ratio"].label, "-"))
    axes.set_ylabel(f"seabed reaction per unit length [{unit}]")
    axes.set_title("Force-embedment curves")
    axes.grid(visible=True, alpha=0.3)
    _legend(figure, handles, rows)
    return figure


def _curve(axes: Axes, row: dict[str, Any], shape: str) -> Line2D:
    """One curve with its marks; returns what stands for it in the legend."""
    ratios, forces = np.array(row["points"]).T
    marker = shape if len(ratios) <= _MOST_MARKED else None
    (line,) = axes.plot(ratios, forces, marker=marker, markersize=3.5)
    color = line.get_color()
    static = [(each["ratio"], each["force"]) for each in row.get("static", [])]
    asked = [(each["ratio"], each["force"]) for each in row["at"]]
    marked = [ratio for ratio, _ in (*static, *asked)]
    ends = (
        (ratios[0], forces[0], row["segments"][0]["slope"], min([0.0, *marked])),
        (ratios[-1], forces[-1], row["segments"][-1]["slope"], max([ratios[-1] * (1.0 + _MARGIN), *marked])),
    )
    for (ratio, force, slope, to), outward in zip(ends, (-1.0, 1.0), strict=True):
        with np.errstate(over="ignore"):
            end = force + slope * (to - ratio)
        if outward * (to - ratio) > 0.0 and np.isfinite(end):
            axes.plot([ratio, to], [force, end], color=color, linestyle="--", linewidth=1)
    for points, mark in ((asked, _ASKED), (static, _STATIC)):
        for ratio, force in points:
            axes.plot(ratio, force, color=color, **_marker(mark))
    return line


def _marker(mark: Line2D) -> dict[str, Any]:
    return {
        "marker": mark.get_marker(),
        "markersize": mark.get_markersize(),
        "markeredgewidth": mark.get_markeredgewidth(),
        "markerfacecolor": mark.get_markerfacecolor(),
    }


def _legend(figure: Figure, handles: list[Line2D], rows: list[dict[str, Any]]) -> None:
    """Beside the axes, where it covers nothing; a name is plain text, whatever is in it."""
    entries = [(handle, cut(row["name"], 40)) for handle, row in zip(handles, rows, strict=True)]
    entries.append((_DASHED, "beyond the points"))
    if any(row["at"] for row in rows):
        entries.append((_ASKED, "values asked for"))
    if any(row.get("static") for row in rows):
        entries.append((_STATIC, "static embedment"))
    shapes = [shape for shape, _ in entries]
    legend = figure.legend(shapes, ["x"] * len(shapes), loc="outside right upper", fontsize="small")
    for text, (_, name) in zip(legend.get_texts(), entries, strict=True):
        text.set_parse_math(False)
        text.set_text(name)


# ------------------------------------------------------------------------------------------------ of an evaluation

_MOST = 4000
"""Points of a line that are drawn."""
_MOST_CURVES = 8
_LEAST = 0.01
"""Least span of a scale, as a part of the largest value on it."""
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#F0E442")
"""Distinct for colour-blind eyes (Okabe and Ito)."""
_SEABED = "#8c6d46"


def draw_evaluation(data: PlotData, form: str, stream: BinaryIO, spelled: _Spelled, caption: str = "") -> None:
    """Write a picture ("png" or "svg") with the panels that the evaluation has data for.

    `spelled` makes names of the deck fit to be shown; `caption` is a line under the title.
    """
    with mpl.rc_context({"font.size": 9.0}):
        _write(lambda: _figure(data, spelled, caption), form, stream)


def _figure(data: PlotData, spelled: _Spelled, caption: str) -> Figure:
    left, right = _left(data), _right(data, spelled)
    height = max(sum(size for _, size in column) for column in (left, right))
    figure = Figure(figsize=(13.0 if right else 8.0, 1.0 + height), layout="constrained", dpi=120)
    grid = figure.add_gridspec(1, 2 if right else 1)
    for column, panels in enumerate((left, right)):
        if not panels:
            continue
        rows = grid[0, column].subgridspec(len(panels), 1, height_ratios=[size for _, size in panels])
        for row, (panel, _) in enumerate(panels):
            panel(figure.add_subplot(rows[row, 0]))
    title = _title(data, spelled)
    figure.suptitle(f"{title}\n{spelled(caption)}" if caption else title).set_parse_math(False)
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
        panels += [(_traced(data, name, last=name == TRACED[-1]), 1.4) for name in TRACED]
    return panels


def _traced(data: PlotData, name: str, *, last: bool) -> _Panel:
    label = headed(STEPS[name].label, STEPS[name].unit_name(data.evaluation.scene.units))
    return lambda axes: trace(axes, data, name, label, last=last)


def _title(data: PlotData, spelled: _Spelled) -> str:
    deck = data.evaluation.scene.deck
    name = spelled(str(deck.source or deck.file))
    times = data.evaluation.time
    if times is None or data.chosen is None:
        return f"Seabed contact of {name}"
    unit = " s" if unit_names(data.evaluation.scene.units).length else ""
    which = ", when the total reaction is largest" if len(times) > 1 else ""
    return f"Seabed contact of {name} at time {times[data.chosen.step]:g}{unit}{which}"


def profile(axes: Axes, data: PlotData, chosen: Chosen) -> None:
    """The line over the seabed, coloured by the seabed reaction where that acts."""
    names = unit_names(data.evaluation.scene.units)
    distance, direction = along(chosen.positions)
    nodes = data.evaluation.nodes
    nodes = nodes[np.argsort(distance[nodes], kind="stable")]
    drawn = nodes[thinned(chosen.result.gap[nodes], _MOST)]
    with np.errstate(all="ignore"):
        seabed = chosen.positions[drawn, 0] - chosen.result.gap[drawn] / chosen.result.normal[drawn, 0]
    axes.plot(distance[drawn], seabed, color=_SEABED, linewidth=1.0, label="seabed", zorder=1)
    elements = data.evaluation.elements
    force = chosen.result.force[elements]
    acts = np.nan_to_num(force) != 0.0
    free, loaded = elements[~acts], elements[acts]
    places: Floats = np.stack([distance, chosen.positions[:, 0]], axis=-1)
    ends = data.evaluation.scene.element_nodes
    free = free[_some(free)]
    pale = LineCollection(
        list(places[ends[free]]),
        colors="0.55",
        linewidths=1.5,
        label="pipe, no force" if free.size else None,
        rasterized=len(free) > _MOST,
    )
    axes.add_collection(pale)
    if loaded.size:
        loaded = loaded[thinned(chosen.result.force[loaded], _MOST)]
        lines = LineCollection(list(places[ends[loaded]]), cmap="viridis", linewidths=4.0, zorder=3)
        lines.set_array(chosen.result.force[loaded])
        lines.set_clim(*widened(chosen.result.force[loaded]))
        axes.add_collection(lines)
        bar = axes.figure.colorbar(lines, ax=axes, pad=0.01)
        bar.set_label(ELEMENTS["force"].axis(data.evaluation.scene.units))
    axes.autoscale_view()
    axes.locator_params(axis="x", nbins=6)
    axes.set_xlabel(labelled(_distance(direction), names.length))
    axes.set_ylabel(labelled("height X", names.length))
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, fontsize="small", frameon=False)
    axes.grid(visible=True, alpha=0.3)


def embedment(axes: Axes, data: PlotData, chosen: Chosen) -> None:
    """Depth of the elements about the contact, downwards."""
    _along_contact(axes, data, chosen, chosen.result.depth, COLORS[0])
    axes.axhline(0.0, color=_SEABED, linewidth=1.0)
    deepest = float(np.nan_to_num(chosen.result.depth).max(initial=0.0))
    if deepest > 0.0:  # what hangs high above would hide how deep the rest lies
        axes.set_ylim(bottom=max(axes.get_ylim()[0], -0.6 * deepest))
    axes.invert_yaxis()
    axes.set_ylabel(ELEMENTS["depth"].axis(data.evaluation.scene.units))


def stiffness(axes: Axes, data: PlotData, chosen: Chosen) -> None:
    """Stiffness of the seabed about the contact."""
    _along_contact(axes, data, chosen, chosen.result.stiffness, COLORS[1])
    axes.set_ylabel(ELEMENTS["stiffness"].axis(data.evaluation.scene.units))


def _along_contact(axes: Axes, data: PlotData, chosen: Chosen, values: Floats, color: str) -> None:
    """Values of elements over their distance, of those in contact and a few beside them."""
    distance, direction = along(chosen.positions)
    elements = data.evaluation.elements
    middle = distance[data.evaluation.scene.element_nodes[elements]].mean(axis=1)
    near = _near_contact(middle, chosen.result.contact[elements])
    order = near[np.argsort(middle[near], kind="stable")]
    drawn = order[thinned(values[elements[order]], _MOST)]
    few = len(drawn) <= 60
    axes.plot(
        middle[drawn], values[elements[drawn]], color=color, linewidth=1.2, marker="o" if few else None, markersize=3.5
    )
    axes.locator_params(axis="x", nbins=6)
    axes.set_xlabel(labelled(_distance(direction), unit_names(data.evaluation.scene.units).length))
    axes.grid(visible=True, alpha=0.3)


def _near_contact(middle: Floats, touching: Mask) -> Indices:
    """Elements within the stretch in contact and a tenth of it on both sides; all, when none is."""
    if not touching.any():
        return np.arange(len(middle))
    low, high = float(middle[touching].min()), float(middle[touching].max())
    margin = 0.1 * (high - low) or 1e-9 * abs(high)
    return np.flatnonzero((middle >= low - margin) & (middle <= high + margin))


def on_curves(axes: Axes, data: PlotData, spelled: _Spelled) -> None:
    """Force-embedment curves with the evaluated points on them; `spelled` makes their names fit to be shown."""
    curves = data.evaluation.model.input.curves
    every = _points(data)
    used = np.unique(every[0])
    for place, index in enumerate(used.tolist()):
        color = COLORS[place % len(COLORS)]
        mine = every[0] == index
        ratio, force = every[1][mine], every[2][mine]
        curve = curves[index]
        reach = np.array([0.0, max(float(ratio.max()), float(curve.ratios[-1]))])
        knots = np.unique(np.concatenate([curve.ratios[(curve.ratios > reach[0]) & (curve.ratios < reach[1])], reach]))
        name = cut(spelled(str(curve.name)), 30)
        label = (f" {name}" if name.startswith("_") else name) if place < _MOST_CURVES else None  # _ hides from legends
        axes.plot(knots, curve.evaluate(knots)[0], color=color, linewidth=1.2, zorder=2)
        axes.plot(
            ratio, force, color=color, linestyle="none", marker="o", markersize=4, alpha=0.55, zorder=3, rasterized=True
        )
        axes.plot([], [], color=color, marker="o", markersize=4, label=label)
    if len(used) > _MOST_CURVES:
        axes.plot([], [], " ", label=f"and {len(used) - _MOST_CURVES} more curves")
    axes.set_xlabel(labelled(ELEMENTS["ratio"].label, "-"))
    axes.set_ylabel(ELEMENTS["force"].axis(data.evaluation.scene.units))
    axes.grid(visible=True, alpha=0.3)
    legend = axes.legend(loc="best", fontsize="small", title="curves, evaluated points", title_fontsize="small")
    for text in legend.get_texts():
        text.set_parse_math(False)


def _points(data: PlotData) -> tuple[Indices, Floats, Floats]:
    """Points in contact of the drawn step, and some of all steps."""
    found = list(data.points)
    if data.chosen is not None:
        chosen = data.on_curve[_some(data.on_curve)]
        found.append(data.points_at(data.chosen.result, (), chosen))
    curve, ratio, force = (np.concatenate(columns) for columns in zip(*found, strict=True))
    known = ~np.isnan(ratio) & ((ratio > 0.0) | (force != 0.0))
    if not known.any():
        known = ~np.isnan(ratio)
    return curve[known], ratio[known], force[known]


def trace(axes: Axes, data: PlotData, name: str, label: str, *, last: bool) -> None:
    """A figure over time; where steps are too many, the band between its least and largest values."""
    least, most = (np.where(np.isfinite(values), values, np.nan) for values in data.traces[name])
    times = data.bin_times
    if np.array_equal(least, most, equal_nan=True):
        axes.plot(times, most, color=COLORS[0], linewidth=1.2)
    else:
        axes.fill_between(times, least, most, color=COLORS[0], linewidth=0.6)
    known = np.concatenate([least, most])
    known = known[~np.isnan(known)]
    if known.size and 0.0 < np.ptp(known) < _LEAST * np.abs(known).max():
        axes.set_ylim(*widened(known))
    axes.set_ylabel(label)
    axes.grid(visible=True, alpha=0.3)
    if last:
        axes.set_xlabel("time [s]" if unit_names(data.evaluation.scene.units).length else "time")
    else:
        axes.tick_params(labelbottom=False)


def widened(values: Floats) -> tuple[float, float]:
    """The least and the largest value, drawn apart to a hundredth of their size: no scale shows what is rounding."""
    low, high = float(values.min()), float(values.max())
    margin = 0.5 * max(0.0, _LEAST * max(abs(low), abs(high)) - (high - low))
    return low - margin, high + margin


def _some(rows: Indices) -> Indices:
    """Rows of many at even distances."""
    return np.arange(0, len(rows), max(1, -(-len(rows) // _MOST)))


def _distance(direction: Floats) -> str:
    """What the horizontal axis is."""
    for axis, name in enumerate("YZ"):
        if abs(abs(direction[axis]) - 1.0) < 1e-9:
            return f"distance along {name}"
    return "horizontal distance along the line"


def along(positions: Floats) -> tuple[Floats, NDArray[np.float64]]:
    """Distances (n,) of nodes along the horizontal direction in which they spread most, and that direction (2,).

    It points from the first node to the last; nodes without a position are NaN.
    """
    known = ~np.isnan(positions).any(axis=1)
    plan = positions[:, 1:]
    scaled = plan[known] / (float(np.abs(plan[known]).max()) or 1.0)  # the squares of large numbers would overflow
    _, axes = np.linalg.eigh(np.cov(scaled.T, bias=True))
    direction = axes[:, -1]
    ends = plan[known][[0, -1]]
    if float((ends[1] - ends[0]) @ direction) < 0.0:
        direction = -direction
    return (plan - ends[0]) @ direction, direction


def thinned(values: Floats, most: int) -> Indices:
    """Rows to draw of many: the least and the largest value of each of `most` / 2 pieces, and both ends."""
    if len(values) <= most:
        return np.arange(len(values))
    edges = np.linspace(0, len(values), most // 2 + 1).astype(np.intp)[:-1]
    known = np.nan_to_num(values)
    low, high = np.minimum.reduceat(known, edges), np.maximum.reduceat(known, edges)
    piece = np.searchsorted(edges, np.arange(len(values)), side="right") - 1
    kept = (known == low[piece]) | (known == high[piece])
    first = np.ones(len(values), dtype=bool)
    first[1:] = (known[1:] != known[:-1]) | (piece[1:] != piece[:-1])
    drawn: NDArray[np.bool_] = kept & first
    drawn[[0, -1]] = True
    return np.flatnonzero(drawn)
