"""Pictures of studies: one style for all of them, drawn by matplotlib on demand.

Colours that colour-blind readers can distinguish, and a marker for each line. Lines of time integration schemes
have the styles of `mudline.study.schemes.STYLES`, the same in every picture.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeAlias

from mudline.short_repr import cut

if TYPE_CHECKING:  # only drawing needs matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLORS = ("#332288", "#cc6677", "#117733", "#999933", "#882255", "#88ccee", "#44aa99", "#aa4499", "#ddcc77", "#777777")
"""Other colours than those of the schemes, so that no line of a picture without schemes looks like one of them."""
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "*")
_LINES = ("-", "--", "-.", ":")
_LONGEST = 34

Points: TypeAlias = Sequence[tuple[float, float]]
LineStyle: TypeAlias = dict[str, Any]
"""Keywords of matplotlib for a line."""


def _nothing(figure: Figure) -> None:
    del figure


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture that is drawn on demand.

    Attributes:
        name: of its file.
        caption: what it shows.
        draw: draws it on an empty figure.
        size: width and height in inches; 100 points to the inch.
        data: the PNG, once it is drawn.
    """

    name: str
    caption: str
    draw: Callable[[Figure], None] = _nothing
    size: tuple[float, float] = (9.0, 6.0)
    data: bytes = b""

    def kept(self) -> Picture:
        """The same with its PNG; raises ImportError without matplotlib."""
        return replace(self, data=self.png())

    def png(self) -> bytes:
        """The picture as PNG; raises ImportError without matplotlib."""
        if self.data:
            return self.data
        from matplotlib.figure import Figure  # noqa: PLC0415 - a study without pictures does without it

        figure = Figure(figsize=self.size, layout="constrained", dpi=100)
        self.draw(figure)
        stream = io.BytesIO()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a letter that the font lacks becomes a box
            figure.savefig(stream, format="png", metadata={"Software": None})
        return stream.getvalue()


def style(index: int) -> LineStyle:
    """The style of the line of this number, from 0."""
    return line_style(
        _COLORS[index % len(_COLORS)],
        _MARKERS[(index + index // len(_COLORS)) % len(_MARKERS)],
        _LINES[index // len(_COLORS) % len(_LINES)],
    )


def line_style(color: str, marker: str, dash: str = "-") -> LineStyle:
    """A line of this colour, marker and dash, as wide as all of them."""
    return {"color": color, "marker": marker, "linestyle": dash, "markersize": 5, "linewidth": 1.4}


def draw_lines(
    axes: Axes,
    lines: Mapping[str, Points],
    title: str,
    x: str,
    y: str,
    styles: Mapping[str, LineStyle] | None = None,
) -> None:
    """A line through points for each name of the legend, on logarithmic axes; the rest as in `label`.

    Their styles are those of their names, else those from the first on.
    """
    for index, (name, points) in enumerate(lines.items()):
        look = (styles or {}).get(name) or style(index)
        axes.loglog([point[0] for point in points], [point[1] for point in points], label=name, **look)
    label(axes, title, x, y)


def panels(figure: Figure, count: int, across: int, *, sharey: bool = False) -> list[Axes]:
    """Return `count` axes, `across` of them in a row."""
    found: list[Axes] = list(figure.subplots(-(-count // across), across, squeeze=False, sharey=sharey).flat)
    for axes in found[count:]:
        axes.remove()
    return found[:count]


def drawn(name: str) -> str:
    """A name of the deck as plain text of a picture, where $ would begin a formula, and _ hide it from a legend."""
    text = "".join(char if char.isprintable() else "\ufffd" for char in name).replace("$", r"\$")
    return f" {text}" if text.startswith("_") else text


def shortened(name: str) -> str:
    """A name of the deck as it is drawn, cut to fit above a panel."""
    return drawn(cut(name, _LONGEST))


def label(axes: Axes, title: str, x: str, y: str) -> None:
    """Title, axes with their units, and a grid."""
    axes.set_title(title, fontsize="medium")
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(visible=True, which="major", alpha=0.35)


def legend_below(figure: Figure, axes: Axes, columns: int = 4) -> None:
    """One legend for all axes, below them, where it covers nothing."""
    handles, names = axes.get_legend_handles_labels()
    figure.legend(handles, names, loc="outside lower center", ncols=columns, fontsize="small")


# ------------------------------------------------------------------------------------- zero on an axis of logarithms


def zero_place(values: Iterable[float]) -> float:
    """Where 0 stands on a logarithmic axis beside these values: a decade below the least that is above 0."""
    return 0.1 * min((value for value in values if value > 0.0), default=1.0)


def zero_tick(axes: Axes, place: float, text: str = "0") -> None:
    """A tick of its own for 0 at this place of the x axis, and a dotted line that divides it from the rest.

    Call it when everything is drawn. Axes that share x share the tick.
    """
    from matplotlib.ticker import FixedLocator, FuncFormatter, LogFormatterSciNotation, NullFormatter  # noqa: PLC0415

    low, high = place / 2.0, axes.get_xlim()[1]
    decades = [10.0**power for power in range(-300, 300) if 3.0 * place < 10.0**power <= high]
    powers = LogFormatterSciNotation()
    powers.create_dummy_axis()
    powers.set_locs(decades)
    axes.xaxis.set_major_locator(FixedLocator([place, *decades]))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: text if x == place else powers(x)))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlim(low, high)
    axes.axvline(place * 10.0**0.5, color="0.5", linestyle=":", linewidth=1.0)
