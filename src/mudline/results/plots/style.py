"""What all pictures have in common: colours and line styles, plain numbers, thinning, the stretch along the lines."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, BinaryIO, Literal, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.ticker import AutoLocator, MaxNLocator, ScalarFormatter
from numpy.typing import NDArray

from mudline.quantities import STATES, labelled, unit_names
from mudline.results.plot_data import PlotData
from mudline.scene.numbering import Floats, Indices, Mask

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


def finish(axes: Axes) -> None:
    """Plain numbers and a grid: what every panel has; ticks that were placed already stay."""
    for axis in (axes.xaxis, axes.yaxis):
        numbers = ScalarFormatter(useOffset=False)
        numbers.set_powerlimits((-5, 10))  # no power of ten that a reader would have to apply
        axis.set_major_formatter(numbers)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=7, steps=[1, 2, 2.5, 5, 10]))
    figure = axes.figure
    height = axes.get_position().height * (figure.get_figheight() if isinstance(figure, Figure) else 4.0)  # inch
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


# --------------------------------------------------------------------------------------------------- along the lines

MOST_LINES = 6
"""Lines that are drawn."""
_BESIDE = 0.15
"""Part of the stretch in contact that is drawn on both sides of it."""


@dataclass(frozen=True)
class Stretch:
    """The lines that are drawn, and the stretch of arc length that all panels along them show."""

    data: PlotData

    @cached_property
    def lines(self) -> list[int]:
        """The numbers, from 0, of the lines that are drawn: those that touch the seabed first."""
        data = self.data
        of_touched = set(data.given.lines.of_element[data.touched].tolist())
        ranked = sorted(data.lines, key=lambda line: (line not in of_touched, line))
        return sorted(ranked[:MOST_LINES])

    @property
    def left_out(self) -> int:
        """The number of lines that are not drawn."""
        return self.data.more_lines + len(self.data.lines) - len(self.lines)

    @cached_property
    def limits(self) -> tuple[float, float]:
        """The least and the largest arc length that is drawn."""
        given, lines = self.data.given, self.data.given.lines
        drawn = np.isin(lines.of_element, self.lines) & self._evaluated
        half = 0.5 * given.length
        begin, end = lines.element_arc - half, lines.element_arc + half
        first, last = float(begin[drawn].min()), float(end[drawn].max())
        touching = drawn & self.data.touched
        if not touching.any():
            return first, last
        low, high = float(begin[touching].min()), float(end[touching].max())
        beside = max(_BESIDE * (high - low), 2.0 * float(given.length[touching].max()))
        return max(first, low - beside), min(last, high + beside)

    def elements(self, line: int) -> tuple[Indices, Floats]:
        """The evaluated elements of a line within the stretch and one beside it, and the arc lengths there."""
        lines = self.data.given.lines
        along = lines.elements[line]
        along = along[self._evaluated[along]]
        arcs = lines.element_arc[along]
        within = self._within(arcs)
        return along[within], arcs[within]

    def nodes(self, line: int) -> tuple[Indices, Floats]:
        """The nodes of a line within the stretch and one beside it, along the line, and their arc lengths."""
        lines = self.data.given.lines
        arcs = lines.node_arcs(line, self.data.given.length)
        within = self._within(arcs)
        return lines.nodes[line][within], arcs[within]

    def name(self, line: int) -> str:
        """What a line is called in a legend."""
        ids = self.data.given.element_ids[self.data.given.lines.elements[line]]
        return f"line {line + 1}: elements {ids[0]} to {ids[-1]}"

    @cached_property
    def _evaluated(self) -> Mask:
        found = np.zeros(len(self.data.given.element_ids), np.bool_)
        found[self.data.elements] = True
        return found

    def _within(self, arcs: Floats) -> slice:
        low, high = self.limits
        inside = np.flatnonzero((arcs >= low) & (arcs <= high))
        if not inside.size:
            return slice(0, 0)
        return slice(max(0, int(inside[0]) - 1), int(inside[-1]) + 2)

    def show(self, axes: Axes) -> None:
        """Set the horizontal axis."""
        low, high = self.limits
        beside = 0.01 * (high - low) or 0.5
        if is_number(low) and is_number(high):
            axes.set_xlim(low - beside, high + beside)
        axes.set_xlabel(labelled("arc length along the line", unit_names(self.data.given.units).length))

    def style(self, place: int) -> Style:
        """How the line at a place among the drawn ones is drawn: a single one solid, several differ in all."""
        return style_of(place) if len(self.lines) > 1 else Style(COLORS[0], "-", "o")
