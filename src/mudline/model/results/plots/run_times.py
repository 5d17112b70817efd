"""Errors over run time on logarithmic axes, with marked steps. Needs matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from mudline.model.results.plots.style import drawing, printable, style_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from mudline.model.scene.numbering import Floats, Mask

_LEAST = 1e-5
"""Least error drawn; smaller errors are drawn at this value."""
_GOALS = (1.0, 2.0, 5.0)
"""Marked errors in percent."""
_PERCENT, _MILLI = 1e2, 1e3
_STAR: dict[str, Any] = {"markersize": 15, "markeredgecolor": "black", "zorder": 5}
"""Marker of the deck's own step."""


def draw_run_times(axes: Axes, run_times: Floats, errors: Floats, marked: Mask, names: Sequence[str]) -> None:
    """Draw errors (k, n) of the quantities `names` over run times (k,), in seconds for a second of motion."""
    times = _MILLI * run_times
    for at, name in enumerate(names):
        look, values = style_of(at), _PERCENT * np.maximum(errors[:, at], _LEAST)
        axes.plot(times, values, label=name, color=look.color, marker=look.marker, linewidth=1.5)
        axes.plot(times[marked], values[marked], "*", color=look.color, **_STAR)
    if marked.any():
        axes.plot([], [], "*", color="0.6", label="the deck's own step", **_STAR)
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_locator(LogLocator(subs=(2.0, 5.0)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter("{x:g}")
    for goal in _GOALS:
        axes.axhline(goal, color="0.4", linewidth=1.0, linestyle=":")
        text = f" {goal:g} %"
        axes.annotate(text, (0.0, goal), xycoords=("axes fraction", "data"), va="bottom", color="0.3")
    axes.grid(visible=True, which="major", color="0.9")
    axes.set_xlabel("run time [ms per s of motion]")
    axes.set_ylabel("error of the last period [%]")
    axes.legend(edgecolor="none", framealpha=0.9)


@drawing()
def run_times_figure(deck: str, run_times: Floats, errors: Floats, marked: Mask, names: Sequence[str]) -> Figure:
    """Return the diagram of a deck."""
    figure = Figure(figsize=(6.5, 5.2), layout="constrained", dpi=120)
    draw_run_times(figure.subplots(), run_times, errors, marked, names)
    figure.suptitle(f"Error against run time: {printable(deck, 100)}", fontsize="medium").set_parse_math(False)
    return figure
