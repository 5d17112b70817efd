"""The style of all plots: colours, markers, fonts, axes, legends, safe texts, thinned lines, files."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, BinaryIO, Literal, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import AutoLocator, MaxNLocator, ScalarFormatter

from mudline.basics.short_repr import cut, printable
from mudline.model.scene.numbering import Floats, Indices

WIDTH = 8.0
"""Width of a figure, inch."""
MOST_POINTS = 4000
"""Largest number of drawn points of a line."""
MOST_MARKED = 60
"""Number of points of a line up to which each is marked."""
LONGEST_NAME = 40
"""Largest number of letters of a name."""
_LEAST = 0.01
"""Least span of a scale, as a part of the largest value on it."""
_TICKS = {"steps": [1, 2, 2.5, 5, 10]}
_SETTINGS: dict[Any, Any] = {"font.size": 9.0, "svg.hashsalt": "mudline", "pdf.fonttype": 42}
"""Settings of matplotlib; with the salt equal figures have equal ids."""

COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#F0E442")
"""Colours that colour-blind people can distinguish (Okabe and Ito)."""
SEABED = "#8c6d46"
_MARKERS = "os^DvPX*"


class Style(NamedTuple):
    """Style of one of several curves of a panel; they differ without colours too."""

    color: str
    linestyle: Literal["-", "--", "-.", ":"]
    marker: str

    @property
    def line(self) -> dict[str, Any]:
        """Colour and dash of a line, for matplotlib."""
        return {"color": self.color, "linestyle": self.linestyle}


_LINE_STYLES: tuple[Literal["-", "--", "-.", ":"], ...] = ("-", "--", "-.", ":")

STATE_STYLES = {
    "free": Style("0.55", ":", "."),
    "compression": Style(COLORS[0], "-", "s"),
    "suction": Style(COLORS[1], "--", "v"),
    "hold": Style(COLORS[4], "-", "o"),
    "broken": Style(COLORS[2], "-.", "x"),
}
"""Styles of the states of suction."""


def style_of(place: int) -> Style:
    """Return the style of the first, second, ... of several curves: 64 differ in colour and marker."""
    turn = place // len(COLORS)
    return Style(
        COLORS[place % len(COLORS)], _LINE_STYLES[place % len(_LINE_STYLES)], _MARKERS[(place + turn) % len(_MARKERS)]
    )


# ----------------------------------------------------------------------------------------------------- figures, files


@contextmanager
def drawing() -> Iterator[None]:
    """Make and save figures in the style, without warnings: a letter that the font lacks becomes a box."""
    with mpl.rc_context(_SETTINGS), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def new_figure(height: float) -> Figure:
    """Return a figure with a height in inch."""
    return Figure(figsize=(WIDTH, height), layout="constrained", dpi=150)


@drawing()
def save(figure: Figure, form: str, stream: BinaryIO) -> None:
    """Write a figure as "png", "svg" or "pdf"; equal figures give equal bytes."""
    dates: dict[str, dict[str, Any]] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    figure.savefig(stream, format=form, metadata=dates.get(form))


# -------------------------------------------------------------------------------------------------- texts and legends


def figure_text(text: str, most: int = LONGEST_NAME) -> str:
    """Return a text of a deck for display: cut, with a mark for letters that do not print."""
    return printable(cut(text.replace("\t", " "), most))


def legend_name(text: str, most: int = LONGEST_NAME) -> str:
    """Return a name of a deck for a legend; matplotlib would leave out a name that begins with an underscore."""
    shown = figure_text(text, most)
    return f" {shown}" if shown.startswith("_") else shown


def legend(axes: Axes, handles: Sequence[Artist] = (), *, title: str = "", note: str = "", columns: int = 3) -> None:
    """Add a legend above the axes, where it covers nothing, of `handles` or all labelled artists.

    A note is its last text. Its texts are not parsed: a name of a deck may look like a formula.
    """
    artists = list(handles or axes.get_legend_handles_labels()[0])
    if note:
        artists.append(Line2D([], [], linestyle="none", label=note))
    drawn = axes.legend(
        handles=artists,
        title=title or None,
        alignment="left",
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        ncols=columns if len(artists) <= columns else min(columns, 2),
        fontsize="small",
        frameon=False,
        borderaxespad=0.1,
        handlelength=2.2,
        columnspacing=1.2,
    )
    for text in drawn.get_texts():
        text.set_parse_math(False)


# --------------------------------------------------------------------------------------------------------------- axes


def finish(axes: Axes) -> None:
    """Set plain numbers and a grid, as in every panel; ticks and their texts that were set earlier stay."""
    figure = axes.figure
    height = axes.get_position().height * (figure.get_figheight() if isinstance(figure, Figure) else 4.0)  # inch
    for axis, ticks in ((axes.xaxis, 7), (axes.yaxis, max(3, min(8, round(4.0 * height))))):
        if isinstance(axis.get_major_formatter(), ScalarFormatter):
            numbers = ScalarFormatter(useOffset=False)
            numbers.set_powerlimits((-5, 10))  # otherwise a reader would have to apply a power of ten
            axis.set_major_formatter(numbers)
        if isinstance(axis.get_major_locator(), AutoLocator):
            axis.set_major_locator(MaxNLocator(nbins=ticks, **_TICKS))
    frame(axes)


def frame(axes: Axes) -> None:
    """Set a grid behind the data, and no lines at the top and on the right."""
    axes.grid(visible=True, color="0.88", linewidth=0.6)
    axes.set_axisbelow(True)
    for side in {"top", "right"} & {*axes.spines}:
        axes.spines[side].set_visible(False)


def zero_line(axes: Axes) -> None:
    """Draw a line at ordinate 0."""
    axes.axhline(0.0, color="0.4", linewidth=0.8, zorder=1)


def widen(axes: Axes, values: Floats) -> None:
    """Widen the axis of values that hardly change to a hundredth of their size: no scale shows rounding."""
    known = values[np.isfinite(values)]
    if known.size and 0.0 < float(np.ptp(known)) < (least := _LEAST * float(np.abs(known).max())):
        low, high = float(known.min()), float(known.max())
        margin = 0.5 * max(0.0, least - (high - low))
        axes.set_ylim(low - margin, high + margin)


def thinned(values: Floats, most: int = MOST_POINTS) -> Indices:
    """Return rows to draw of many: the least and the largest value of each of `most` / 2 pieces, and both ends."""
    if len(values) <= most:
        return np.arange(len(values))
    edges = np.linspace(0, len(values), most // 2 + 1).astype(np.intp)[:-1]
    known = np.nan_to_num(values)
    low, high = np.minimum.reduceat(known, edges), np.maximum.reduceat(known, edges)
    piece = np.searchsorted(edges, np.arange(len(values)), side="right") - 1
    drawn = (known == low[piece]) | (known == high[piece])
    drawn[1:] &= (known[1:] != known[:-1]) | (piece[1:] != piece[:-1])
    drawn[[0, -1]] = True
    return np.flatnonzero(drawn)


def gapped(begin: Floats, end: Floats) -> Floats:
    """Return the coordinates of segments (k,) as those of one broken line."""
    return np.column_stack([begin, end, np.full(len(begin), np.nan)]).ravel()


def draw_line(
    axes: Axes, x: Floats, y: Floats, style: Style, label: str | None = None, *, most_marked: int = MOST_MARKED
) -> None:
    """Draw a line with a marker at each point; a line with too many points is thinned and has no markers."""
    kept = thinned(y)
    marker = style.marker if len(kept) <= most_marked else ""
    axes.plot(x[kept], y[kept], **style.line, linewidth=1.3, marker=marker, markersize=3.5, label=label)
