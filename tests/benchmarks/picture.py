"""The picture of docs/benchmarks.md: time against size."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tests.benchmarks.bench import Series

_OURS = ("0.0", 1.6)
_OTHERS = ("0.5", 1.0)
_MARKS = "os^vDPX"
_LINES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 1)), (0, (8, 2)))


def draw(panels: Mapping[str, Series], path: Path) -> None:
    """Draw a panel for each kind of size, in shades of grey: mudline black, others grey, each with its own mark."""
    with mpl.rc_context({"svg.hashsalt": "mudline", "svg.fonttype": "none", "font.size": 8}):
        rows = (len(panels) + 1) // 2
        figure = Figure(figsize=(8.0, 3.4 * rows), layout="constrained")
        axes = figure.subplots(rows, 2, squeeze=False).ravel()
        for axis, (size, series) in zip(axes, panels.items(), strict=False):
            _panel(axis, size, series)
        for axis in axes[len(panels) :]:
            axis.set_axis_off()
        figure.savefig(path, metadata={"Date": None})


def _panel(axis: Axes, size: str, series: Series) -> None:
    ours = any(name.startswith("mudline") for name in series)
    for at, (name, points) in enumerate(series.items()):
        shade, width = _OTHERS if ours and not name.startswith("mudline") else _OURS
        marks = {"marker": _MARKS[at % len(_MARKS)], "markersize": 4, "linestyle": _LINES[at % len(_LINES)]}
        axis.loglog(*zip(*points, strict=True), color=shade, linewidth=width, label=name, **marks)
    axis.set_xlabel(size)
    axis.set_ylabel("s")
    axis.grid(color="0.9", linewidth=0.5)
    axis.legend(frameon=False)
