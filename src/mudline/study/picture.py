"""Pictures of a study, in one style: colours that colour-blind readers tell apart, a marker for each line besides."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9", "#8c6d31", "#7a7a7a", "#b2182b")
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "*")
_LINES = ("-", "--", "-.", ":")
_LONGEST = 34

Points = Sequence[tuple[float, float]]


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture that is drawn when it is wanted.

    Attributes:
        name: a word for its file.
        caption: what it shows.
        draw: draws it on an empty figure.
        size: width and height in inches; 100 points to the inch.
    """

    name: str
    caption: str
    draw: Callable[[Figure], None]
    size: tuple[float, float] = (9.0, 6.0)

    def png(self) -> bytes:
        """The picture as PNG; raises ImportError without matplotlib."""
        from matplotlib.figure import Figure  # noqa: PLC0415 - a study without pictures does without it

        figure = Figure(figsize=self.size, layout="constrained", dpi=100)
        self.draw(figure)
        stream = io.BytesIO()
        figure.savefig(stream, format="png", metadata={"Software": None})
        return stream.getvalue()


def style(index: int) -> dict[str, Any]:
    """Colour, marker and dash of the line of this number, from 0; so many lines as these differ."""
    return {
        "color": _COLORS[index % len(_COLORS)],
        "marker": _MARKERS[(index + index // len(_COLORS)) % len(_MARKERS)],
        "linestyle": _LINES[index // len(_COLORS) % len(_LINES)],
        "markersize": 5,
        "linewidth": 1.4,
    }


def draw_lines(axes: Axes, lines: Mapping[str, Points], scale: Literal["loglog", "semilogx"] = "loglog") -> None:
    """A line through points for each name of the legend, in the styles from the first on."""
    draw = getattr(axes, scale)
    for index, (name, points) in enumerate(lines.items()):
        draw([x for x, _ in points], [y for _, y in points], label=name, **style(index))


def panels(figure: Figure, count: int, across: int, *, sharey: bool = False) -> list[Axes]:
    """So many axes, `across` of them in a row."""
    found: list[Axes] = list(figure.subplots(-(-count // across), across, squeeze=False, sharey=sharey).flat)
    for axes in found[count:]:
        axes.remove()
    return found[:count]


def shortened(name: str) -> str:
    """A name that fits above a panel."""
    return name if len(name) <= _LONGEST else name[: _LONGEST - 3] + "..."


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
