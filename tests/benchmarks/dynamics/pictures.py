"""The pictures docs/studies/benchmark-*.png, from the tables."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mudline.model.results.plots.style import COLORS, SEABED
from tests.benchmarks.drawing import draw, label, legend_below, panels, style
from tests.benchmarks.studies.schemes import SCHEMES
from tests.benchmarks.tables import column, load

SHOWN = ("velocity-verlet", "rk4", "newmark", "generalised-alpha-0.5", "generalised-alpha-0", "backward-euler")
"""Schemes in the picture; the others are in the tables of the page: they lie on one of these lines, or grow."""


_BOTTOM = {"touchdown rms [m]": 1e-4, "peak force": 1e-5, "seabed work": 1e-6, "energy balance": 1e-6}
"""Of the axes: Newmark closes the balance to round-off, and is not drawn there."""


def draw_path(figure: Figure) -> None:
    """The reference over time: touchdown, force of the hoist, and works."""
    rows = load("benchmark-path")
    time = column(rows, "time [s]")
    above, middle, below = panels(figure, 3, 1)
    above.plot(time, column(rows, "touchdown [m]"), color=COLORS[0])
    label(above, "Touchdown point", "", "arc length [m]")
    for name, colour in (("hoist up", COLORS[1]), ("hoist along", COLORS[2])):
        middle.plot(time, column(rows, f"{name} [N]"), color=colour, label=name)
    label(middle, "Force of the hoist", "", "[N]")
    for name, colour in (("hoist work", COLORS[1]), ("seabed work", COLORS[0]), ("damping work", "0.5")):
        below.plot(time, column(rows, f"{name} [J]"), color=colour, label=name)
    label(below, "Work done on the line", "time [s]", "[J]")
    for axes in (middle, below):
        axes.set_ylim(top=1.3 * axes.get_ylim()[1])  # above the curves there is space for the legend
        axes.legend(fontsize="small", loc="upper right", ncols=3)


def draw_schemes(figure: Figure) -> None:
    """Errors against work."""
    rows = [row for row in load("benchmark-schemes") if not row["failure"]]
    wanted = (
        ("touchdown rms [m]", "Touchdown: root mean square error", "[m]"),
        ("peak force", "Peak force of the hoist: error", "share of the peak"),
        ("seabed work", "Work of the seabed: largest error", "share of the hoist's work"),
        ("energy balance", "Energy that is not accounted for", "share of the hoist's work"),
    )
    axes: Axes
    for axes, (heading, title, unit) in zip(panels(figure, 4, 2), wanted, strict=True):
        for name in SHOWN:
            own = [row for row in rows if row["scheme"] == name]
            work = [float(row["evaluations"]) + float(row["tangents"]) for row in own]
            errors = [max(abs(error), 1e-12) for error in column(own, heading)]
            axes.loglog(work, errors, label=SCHEMES[name].title, **style(SCHEMES[name].title))
        axes.set_ylim(bottom=_BOTTOM[heading])
        if heading == "energy balance":
            axes.text(0.03, 0.04, "Newmark: below 1e-10, at every step", transform=axes.transAxes, fontsize="small")
        label(axes, title, "evaluations of the contact (forces and tangents)", unit)
    legend_below(figure, axes, columns=3)


def draw_bounces(figure: Figure) -> None:
    """The last node of the bouncing beam by both programs."""
    rows = load("benchmark-bouncing-path")
    time = column(rows, "time [s]")
    (axes,) = panels(figure, 1, 1)
    axes.plot(time, column(rows, "last node [m]"), color=COLORS[6], linewidth=2.5, label="mudline, reference")
    axes.plot(time, column(rows, "Exudyn, last node [m]"), "--", color=COLORS[5], label="Exudyn")
    axes.axhline(0.0, color=SEABED, linewidth=0.8)
    axes.legend(fontsize="small")
    label(axes, "Height of the last node above the seabed", "time [s]", "[m]")


def run() -> None:
    """Write all pictures."""
    draw("benchmark-path", draw_path, (9.0, 8.0))
    draw("benchmark-schemes", draw_schemes, (9.0, 8.0))
    draw("benchmark-bouncing", draw_bounces, (9.0, 4.5))
