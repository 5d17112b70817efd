"""What all pictures have in common: colours and line styles, plain numbers on the axes, thinning, and writing files."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from typing import Any, BinaryIO, Literal, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.ticker import AutoLocator, Formatter, MaxNLocator
from numpy.typing import NDArray

from mudline.quantities import STATES, unit_names
from mudline.results.plot_data import PlotData
from mudline.scene.numbering import Floats, Indices

MOST_POINTS = 4000
"""Points of a line that are drawn."""
MOST_MARKED = 60
"""Points of longer lines are not marked one by one."""
_LEAST = 0.01
"""Least span of a scale, as a part of the largest value on it."""

COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#F0E442")
"""Distinct for colour-blind eyes (Okabe and Ito)."""
SEABED = "#8c6d46"
LIGHT = "#e9dfd0"
"""The soil below the seabed."""
Spelled = Callable[[str], str]
"""Makes names of a deck fit to be shown."""


SETTINGS: dict[Any, Any] = {"font.size": 9.0}
"""Of matplotlib, for pictures of results."""


class Style(NamedTuple):
    """How one of several curves of a panel is drawn: without colours they still differ."""

    color: str
    linestyle: Literal["-", "--", "-.", ":"]
    marker: str


_LINE_STYLES: tuple[Literal["-", "--", "-.", ":"], ...] = ("-", "--", "-.", ":")
_STYLES = tuple(
    Style(color, linestyle, marker)
    for color, linestyle, marker in zip(COLORS, 2 * _LINE_STYLES, "os^DvPX*", strict=True)
)


STATE_STYLES = dict(
    zip(
        (state for state in STATES if state is not None),
        (
            Style("0.55", ":", "."),
            Style(COLORS[0], "-", "s"),
            Style(COLORS[1], "--", "v"),
            Style(COLORS[4], "-", "o"),
            Style(COLORS[2], "-.", "x"),
        ),
        strict=True,
    )
)
"""Of the states of suction."""


def style_of(place: int) -> Style:
    """The style of the first, second, ... of several curves."""
    return _STYLES[place % len(_STYLES)]


class PlainFormatter(Formatter):
    """Tick labels in full, as 0.05 and 1,500,000: no offset, and no power of ten that a reader would have to apply."""

    def __init__(self) -> None:
        self._digits: int | None = 0

    def set_locs(self, locs: Sequence[float] | Any) -> None:  # noqa: ANN401 - as matplotlib has it
        """Take the digits from the distance of the ticks."""
        places = np.unique(np.asarray(locs, dtype=np.float64))
        step = float(np.diff(places).min()) if len(places) > 1 else float(np.abs(places).max(initial=0.0))
        largest = float(np.abs(places).max(initial=0.0))
        if not step > 0.0 or largest >= 1e10 or largest < 1e-5:
            self._digits = 0 if largest == 0.0 else None
        else:
            self._digits = next((n for n in range(10) if abs(step - round(step, n)) < 1e-3 * step), 9)

    def __call__(self, x: float, pos: int | None = None) -> str:  # noqa: ARG002 - matplotlib's signature
        """Return the label of a tick."""
        text = f"{x:g}" if self._digits is None else f"{round(x, self._digits) + 0.0:,.{self._digits}f}"
        return self.fix_minus(text)


def finish(axes: Axes) -> None:
    """Plain numbers and a grid: what every panel has; ticks that were placed already stay."""
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(PlainFormatter())
    axes.xaxis.set_major_locator(MaxNLocator(nbins=7, steps=[1, 2, 2.5, 5, 10]))
    figure = axes.get_figure(root=True)
    height = axes.get_position().height * (4.0 if figure is None else figure.get_figheight())  # inch
    if isinstance(axes.yaxis.get_major_locator(), AutoLocator):
        ticks = max(3, min(8, round(4.0 * height)))
        axes.yaxis.set_major_locator(MaxNLocator(nbins=ticks, steps=[1, 2, 2.5, 5, 10]))
    axes.grid(visible=True, color="0.88", linewidth=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def plain_texts(legend: Legend) -> None:
    """Take the texts of a legend as they are: a name of a deck may look like a formula."""
    for text in legend.get_texts():
        text.set_parse_math(False)


def above(axes: Axes, handles: Sequence[Artist] | None = None, *, note: str = "", columns: int = 3) -> None:
    """A legend above the axes, where it covers nothing, of these or all labelled ones; a note is its last text."""
    found = list(axes.get_legend_handles_labels()[0] if handles is None else handles)
    if note:
        found.append(Line2D([], [], linestyle="none", label=note))
    legend = axes.legend(
        handles=found,
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        ncols=columns if len(found) <= columns else 2,
        fontsize="small",
        frameon=False,
        borderaxespad=0.1,
        handlelength=2.2,
        columnspacing=1.2,
    )
    plain_texts(legend)


def time_label(data: PlotData) -> str:
    """The label of an axis of time."""
    if data.times is None:
        return "step [-]"
    return "time [s]" if unit_names(data.given.units).length else "time"


def when(data: PlotData, step: int) -> str:
    """The time of a step, in words; "" for a state without one."""
    if data.times is None:
        return "" if data.steps == 1 else f"step {step}"
    unit = " s" if unit_names(data.given.units).length else ""
    return f"time {float(data.times[step]):.6g}{unit}"


def write(make: Callable[[], Figure], form: str, stream: BinaryIO) -> None:
    """Write a picture as "png", "svg" or "pdf"; the same one gives the same bytes."""
    dates: dict[str, dict[str, Any]] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    settings: dict[Any, Any] = {"svg.hashsalt": "mudline", "pdf.fonttype": 42}
    with mpl.rc_context(settings), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a letter that the font lacks becomes a box
        make().savefig(stream, format=form, metadata=dates.get(form))


def widened(values: Floats) -> tuple[float, float]:
    """The least and the largest value, drawn apart to a hundredth of their size: no scale shows what is rounding."""
    low, high = float(values.min()), float(values.max())
    margin = 0.5 * max(0.0, _LEAST * max(abs(low), abs(high)) - (high - low))
    return low - margin, high + margin


def widen(axes: Axes, values: Floats) -> None:
    """Give an axis of values that hardly change the scale of `widened`."""
    known = values[np.isfinite(values)]
    if known.size and 0.0 < float(np.ptp(known)) < _LEAST * float(np.abs(known).max()):
        axes.set_ylim(*widened(known))


def thinned(values: Floats, most: int = MOST_POINTS) -> Indices:
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


def marker_of(style: Style, count: int) -> str:
    """The marker of each of so many points; none where there are too many."""
    return style.marker if count <= MOST_MARKED else ""


def is_number(value: float) -> bool:
    """Whether an axis can show a value: very large ones overflow in the transforms of the picture."""
    return math.isfinite(value) and abs(value) < 1e150
