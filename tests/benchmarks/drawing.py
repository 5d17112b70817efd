"""Pictures of studies: one style for all of them, and one for each time integration scheme."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tests.benchmarks.tables import FOLDER

_SCHEMES = {
    "central difference": ("#0072b2", "o", "-"),
    "velocity Verlet": ("#56b4e9", "s", "--"),
    "RK4": ("#009e73", "^", "-"),
    "Newmark": ("#d55e00", "D", "-"),
    "HHT (-0.3)": ("#cc79a7", "v", "-."),
    "generalised-alpha (1)": ("#e69f00", "P", "--"),
    "generalised-alpha (0.5)": ("#8c6d31", "X", "-."),
    "generalised-alpha (0)": ("#b2182b", "<", "-"),
    "backward Euler": ("#000000", ">", "-"),
}
"""Two that often coincide differ in the dash."""

LineStyle = dict[str, Any]


def style(title: str) -> LineStyle:
    """The style of a scheme."""
    color, marker, dash = _SCHEMES[title]
    return {"color": color, "marker": marker, "linestyle": dash, "markersize": 5, "linewidth": 1.4}


def label(axes: Axes, title: str, x: str, y: str) -> None:
    """Title, axes with their units, and a grid."""
    axes.set_title(title, fontsize="medium")
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(visible=True, which="major", alpha=0.35)


def panels(figure: Figure, count: int, across: int) -> list[Axes]:
    """Return `count` axes, `across` of them in a row."""
    found: list[Axes] = list(figure.subplots(-(-count // across), across, squeeze=False).flat)
    for axes in found[count:]:
        axes.remove()
    return found[:count]


def legend_below(figure: Figure, axes: Axes, columns: int = 4) -> None:
    """One legend for all axes, below them, where it covers nothing."""
    handles, names = axes.get_legend_handles_labels()
    figure.legend(handles, names, loc="outside lower center", ncols=columns, fontsize="small")


def draw(
    name: str, function: Callable[[Figure], None], size: tuple[float, float] = (9.0, 6.0), folder: Path = FOLDER
) -> None:
    """Write NAME.png, 100 points to the inch."""
    figure = Figure(figsize=size, layout="constrained", dpi=100)
    function(figure)
    stream = io.BytesIO()
    figure.savefig(stream, format="png", metadata={"Software": None})
    (folder / f"{name}.png").write_bytes(stream.getvalue())
