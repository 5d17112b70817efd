"""The figure of results: which panels stand where, how high they are, what they share, and the title."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import BinaryIO, NamedTuple

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec

from mudline.contact import ContactResult
from mudline.files import replacement
from mudline.results import panels as known
from mudline.results.panels import PANELS, PICTURES
from mudline.results.plot_data import TRACED, PlotData
from mudline.results.plots import along_line, over_time, profile
from mudline.results.plots.curves import on_curves
from mudline.results.plots.stretch import Stretch
from mudline.results.plots.style import SETTINGS, Spelled, finish, when, write

_WIDTH = 8.0
_WIDTH_OF_TWO = 14.0
_UNEVEN = 1.0
"""How much higher, inch, the right column may be for panels along the line that stand in it."""
_STRETCHED = 1.5
"""How much higher a panel may become so that both columns are equally high; beyond it, the rest stays empty."""


class _Shown(NamedTuple):
    """A panel in a figure: the heights of its rows, inch, and what draws on their axes."""

    heights: Sequence[float]
    draw: Callable[[list[Axes]], None]


def draw_evaluation(
    data: PlotData,
    form: str,
    stream: BinaryIO,
    spelled: Spelled,
    caption: str = "",
    panels: Sequence[str] | None = None,
) -> None:
    """Write a picture ("png", "svg" or "pdf") with some panels, or with those that the results have data for.

    `spelled` makes names of the deck fit to be shown; `caption` is a line under the title.
    Raises PanelError for a panel that does not exist, or that there is nothing for.
    """
    with mpl.rc_context(SETTINGS):
        write(lambda: figure_of(data, spelled, caption, panels), form, stream)


def figure_of(data: PlotData, spelled: Spelled, caption: str = "", panels: Sequence[str] | None = None) -> Figure:
    """Return the figure; takes and raises what `draw_evaluation` does."""
    names = known.usual(data) if panels is None else known.panel_names(panels)
    known.require(data, names)
    stretch = Stretch(data)
    left = [name for name in names if PANELS[name].axis == "arc length"]
    right = [name for name in names if name not in left]
    shown = {name: _shown(name, data, stretch, spelled) for name in names}

    def height(column: Sequence[str]) -> float:
        return sum(sum(shown[name].heights) for name in column)

    while right and len(left) > 1 and height(right) + sum(shown[left[-1]].heights) <= height(left[:-1]) + _UNEVEN:
        right.append(left.pop())
    columns = [column for column in (left, right) if column]
    tallest = max(map(height, columns), default=2.0)
    figure = Figure(
        figsize=(_WIDTH_OF_TWO if len(columns) > 1 else _WIDTH, 1.0 + tallest),
        layout="constrained",
        dpi=120,
    )
    if columns:
        grid = figure.add_gridspec(1, len(columns))
        for place, column in enumerate(columns):
            cells = _Cells(grid, place, tallest)
            _fill(figure, cells, [(name, shown[name]) for name in column], stretch)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.set(h_pad=0.03, w_pad=0.06)  # type: ignore[call-arg]
    title = _title(data, names, spelled)
    figure.suptitle(f"{title}\n{spelled(caption)}" if caption else title).set_parse_math(False)
    return figure


class _Cells(NamedTuple):
    """A column of a grid, by its place, and its height, inch."""

    grid: GridSpec
    column: int
    height: float


def _fill(figure: Figure, cells: _Cells, panels: Sequence[tuple[str, _Shown]], stretch: Stretch) -> None:
    """Draw the panels of a column; those above others with the same horizontal axis leave its labels to them."""
    heights = [height for _, shown in panels for height in shown.heights]
    empty = cells.height - _STRETCHED * sum(heights)
    rest = [empty / _STRETCHED] if empty > 0.0 else []
    places = cells.grid[0, cells.column].subgridspec(len(heights) + len(rest), 1, height_ratios=[*heights, *rest])
    drawn: list[Axes] = []
    of_axis: dict[str, list[Axes]] = {}
    for name, shown in panels:
        axes = [figure.add_subplot(places[len(drawn) + row, 0]) for row in range(len(shown.heights))]
        drawn += axes
        shown.draw(axes)
        kind = PANELS[name].axis
        for each in axes:
            if kind == "arc length":
                stretch.show(each)
            finish(each)
        if kind != "own":
            of_axis.setdefault(kind, []).extend(axes)
    for group in of_axis.values():
        for each in group[:-1]:
            each.tick_params(labelbottom=False)
            each.set_xlabel("")
    figure.align_ylabels(drawn)


def _shown(name: str, data: PlotData, stretch: Stretch, spelled: Spelled) -> _Shown:
    """How high a panel is, and what draws it."""
    return {
        "line": _Shown([2.9], lambda axes: profile.line(axes[0], data, stretch)),
        "force": _Shown([1.9], lambda axes: along_line.force(axes[0], data, stretch)),
        "suction": _Shown([1.9], lambda axes: along_line.suction(axes[0], data, stretch)),
        "friction": _Shown([1.9], lambda axes: along_line.friction(axes[0], data, stretch)),
        "embedment": _Shown([1.9], lambda axes: along_line.embedment(axes[0], data, stretch)),
        "stiffness": _Shown([1.9], lambda axes: along_line.stiffness(axes[0], data, stretch)),
        "envelope": _Shown([1.9, 1.7], lambda axes: along_line.envelope(axes, data, stretch)),
        "curves": _Shown([3.4], lambda axes: on_curves(axes[0], data, spelled)),
        "loop": _Shown([3.0] * len(data.looped), lambda axes: _loops(axes, data)),
        "touchdown": _Shown([1.5, 1.2], lambda axes: over_time.touchdown(axes, data, stretch)),
        "traces": _Shown([1.2] * len(TRACED), lambda axes: over_time.traces(axes, data)),
    }[name]


def _loops(rows: Sequence[Axes], data: PlotData) -> None:
    for place, axes in enumerate(rows):
        over_time.loop(axes, data, place)


def _title(data: PlotData, names: Sequence[str], spelled: Spelled) -> str:
    """What is drawn, and which step panels along the line show."""
    source = "" if data.given.names is None else data.given.names.source
    title = f"Seabed contact of {spelled(source)}" if source else "Seabed contact"
    chosen = data.chosen
    at = "" if chosen is None else when(data, chosen.step)
    if not at or not any(PANELS[name].axis == "arc length" or name == "curves" for name in names):
        return title
    which = "along the line: at " if data.steps > 1 else "at "
    return f"{title}\n{which}{at}" + (", when the total reaction is largest" if data.steps > 1 else "")


def plot_result(
    result: ContactResult,
    path: str | os.PathLike[str] | None = None,
    *,
    panels: Sequence[str] | None = None,
    elements: Sequence[int] = (),
) -> Figure:
    """Return the figure of a result, and write it to a file if a path is given; see `ContactResult.plot`."""
    form = "" if path is None else Path(path).suffix.lower().removeprefix(".")
    if path is not None and form not in PICTURES:
        raise ValueError(f"{path}: a plot is a .{', .'.join(PICTURES[:-1])} or .{PICTURES[-1]}")
    data = PlotData.of_result(result, elements)
    with mpl.rc_context(SETTINGS):
        figure = figure_of(data, str, "", panels)
        if path is not None:
            with replacement(Path(path)) as stream:
                write(lambda: figure, form, stream)
    return figure
