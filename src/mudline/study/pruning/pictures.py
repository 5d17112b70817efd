"""The pictures of the study."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from mudline.study.picture import Picture, label, legend_below, style
from mudline.study.pruning.cost import CostRow, CurveRow
from mudline.study.pruning.growth import Fit, GrowthRow
from mudline.study.pruning.variants import CURVE

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_PANELS = 3


def node_picture(rows: Sequence[CostRow], alone: Sequence[CurveRow]) -> Picture:
    """Time and memory per node against the number of nodes."""
    caption = "Time per node and step, and memory per node, against the number of nodes: one line a scene."
    return Picture("nodes", caption, partial(_draw_nodes, rows, alone), (12.0, 8.0))


def _draw_nodes(rows: Sequence[CostRow], alone: Sequence[CurveRow], figure: Figure) -> None:
    time, memory = figure.subplots(1, 2)
    for index, scene in enumerate(dict.fromkeys(row.scene for row in rows)):
        points = [row for row in rows if row.scene == scene]
        nodes = [row.nodes for row in points]
        time.loglog(nodes, [row.nanoseconds for row in points], label=scene, **style(index))
        memory.loglog(nodes, [row.peak for row in points], **style(index))
    time.loglog(
        [row.nodes for row in alone],
        [row.curve for row in alone],
        "k:",
        linewidth=2.5,
        label="ForceCurve.evaluate alone",
    )
    label(time, "Time of one step", "nodes [-]", "time per node and step [ns]")
    label(memory, "Most memory during one step", "nodes [-]", "memory per node [bytes]")
    most = max(row.peak for row in rows)
    memory.set_ylim(100.0, 2.0 * most)
    memory.yaxis.set_minor_formatter("")
    legend_below(figure, time, 4)


def stage_picture(rows: Sequence[CostRow]) -> Picture:
    """What each scene costs, as bars."""
    return Picture(
        "stages", "Cost of each scene in times that of the curve alone.", partial(_draw_stages, rows), (11, 6.5)
    )


def _draw_stages(rows: Sequence[CostRow], figure: Figure) -> None:
    most = max(row.nodes for row in rows)
    largest = [row for row in rows if row.nodes == most]
    plain = next(row for row in largest if row.scene == CURVE)
    time, memory = figure.subplots(1, 2, sharey=True)
    names = [row.scene for row in largest]
    _bars(time, names, [row.nanoseconds / plain.nanoseconds for row in largest])
    _bars(memory, names, [row.peak / plain.peak for row in largest])
    label(time, f"Time of one step, {most} nodes", "times that of the scene with a curve [-]", "")
    label(memory, "Most memory during one step", "times that of the scene with a curve [-]", "")
    time.invert_yaxis()


def _bars(axes: Axes, names: Sequence[str], values: Sequence[float]) -> None:
    bars = axes.barh(names, values, color=style(0)["color"])
    axes.bar_label(bars, fmt="%.2g", padding=3)
    axes.set_xlim(0.0, 1.15 * max(values))
    axes.axvline(1.0, color="0.4", linestyle=":")


def growth_picture(rows: Sequence[GrowthRow], fits: Sequence[Fit]) -> Picture:
    """Time against the size of one thing each, with the fitted slopes."""
    return Picture(
        "growth", "Time against size, with fitted power laws.", partial(_draw_growth, rows, fits), (12.0, 7.5)
    )


def _draw_growth(rows: Sequence[GrowthRow], fits: Sequence[Fit], figure: Figure) -> None:
    panels = figure.subplots(-(-len(fits) // _PANELS), _PANELS, squeeze=False).reshape(-1)
    for axes, fit in zip(panels, fits, strict=False):
        ladder = [row for row in rows if row.what == fit.what]
        sizes, seconds = [row.size for row in ladder], [1e3 * row.seconds for row in ladder]
        shown = style(0) | {"linestyle": "none"}
        axes.loglog(sizes, seconds, label="measured", **shown)
        _slope(axes, sizes, seconds, fit.exponent, "--", "all sizes")
        half = len(sizes) // 2
        _slope(axes, sizes[half:], seconds[half:], fit.upper, "-", "larger half")
        axes.set_ylim(0.25 * min(seconds), max(4.0 * max(seconds), 50.0 * min(seconds)))
        axes.set_xlim(0.8 * min(sizes), 1.25 * max(sizes))
        label(axes, f"Number of {fit.what}", "number [-]", "time [ms]")
        axes.legend(fontsize="small", loc="upper left")
    for axes in panels[len(fits) :]:
        axes.remove()


def _slope(
    axes: Axes, sizes: Sequence[float], milliseconds: Sequence[float], exponent: float, dash: str, what: str
) -> None:
    """A power law through the middle of the points."""
    if not np.isfinite(exponent):
        return
    x, y = np.log(sizes), np.log(milliseconds)
    color = style(1 if dash == "--" else 2)["color"]
    axes.loglog(
        sizes, np.exp(y.mean() + exponent * (x - x.mean())), dash, color=color, label=f"{what}: exponent {exponent:.2f}"
    )
