"""Pictures of studies in the style of all plots, with one for each time integration scheme."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mudline.model.results.plots.style import COLORS, SEABED, Style, drawing, frame, save
from tests.benchmarks.tables import FOLDER

_SCHEMES = {
    "central difference": Style(COLORS[0], "-", "o"),
    "velocity Verlet": Style(COLORS[5], "--", "s"),
    "RK4": Style(COLORS[2], "-", "^"),
    "Newmark": Style(COLORS[1], "-", "D"),
    "HHT (-0.3)": Style(COLORS[3], "-.", "v"),
    "generalised-alpha (1)": Style(COLORS[4], "--", "P"),
    "generalised-alpha (0.5)": Style(SEABED, "-.", "X"),
    "generalised-alpha (0)": Style("0.5", "-", "<"),
    "backward Euler": Style(COLORS[6], "-", ">"),
}
"""Two that often coincide differ in the dash."""

LineStyle = dict[str, Any]


def style(scheme: str) -> LineStyle:
    """The style of a scheme by its title."""
    look = _SCHEMES[scheme]
    return {**look.line, "marker": look.marker, "markersize": 5, "linewidth": 1.4}


def lines(axes: Axes, points: Mapping[str, Sequence[tuple[float, float]]]) -> None:
    """A line through points for each scheme, on logarithmic axes."""
    for name, part in points.items():
        axes.loglog([x for x, _ in part], [y for _, y in part], label=name, **style(name))


def label(axes: Axes, title: str, x: str, y: str) -> None:
    """Title, axes with their units, and a grid."""
    axes.set_title(title, fontsize="medium")
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    frame(axes)


def panels(figure: Figure, count: int, across: int, *, sharey: bool = False) -> list[Axes]:
    """Return `count` axes, `across` of them in a row."""
    found: list[Axes] = list(figure.subplots(-(-count // across), across, squeeze=False, sharey=sharey).flat)
    for axes in found[count:]:
        axes.remove()
    return found[:count]


def legend_below(figure: Figure, axes: Axes, columns: int = 4) -> None:
    """One legend for all axes, below them, where it covers nothing."""
    handles, names = axes.get_legend_handles_labels()
    figure.legend(handles, names, loc="outside lower center", ncols=columns, fontsize="small")


@drawing()
def draw(
    name: str, function: Callable[[Figure], None], size: tuple[float, float] = (9.0, 6.0), folder: Path = FOLDER
) -> None:
    """Write NAME.png, 100 points to the inch."""
    figure = Figure(figsize=size, layout="constrained", dpi=100)
    function(figure)
    stream = io.BytesIO()
    save(figure, "png", stream)
    (folder / f"{name}.png").write_bytes(stream.getvalue())
