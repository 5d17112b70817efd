"""The pictures of the study."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from mudline.study.picture import Picture, label, legend_below, style
from mudline.study.precision.case import Case
from mudline.study.precision.curves import BackboneRow, CurveRow
from mudline.study.precision.integration import StepRow, tried

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_FLOOR = 1e-17
"""Errors below it, nought among them, are drawn here."""
_LONGEST = 34


def curve_picture(rows: Sequence[CurveRow]) -> Picture:
    """Error against time per point."""
    names = list(dict.fromkeys(row.curve for row in rows))
    caption = "Largest error of a curve evaluation, over the largest force, against the time per point."
    size = (max(8.0, 4.6 * len(names)), 5.6)
    return Picture("curves", caption, partial(_draw_curves, rows, names), size)


def _draw_curves(rows: Sequence[CurveRow], names: list[str], figure: Figure) -> None:
    panels = figure.subplots(1, len(names), squeeze=False, sharey=True)[0]
    families = list(dict.fromkeys(row.family for row in rows))
    for axes, name in zip(panels, names, strict=True):
        for index, family in enumerate(families):
            points = [row for row in rows if (row.curve, row.family) == (name, family)]
            errors = [max(row.error, _FLOOR) for row in points]
            axes.loglog(errors, [row.nanoseconds for row in points], label=family, **style(index))
        label(axes, _short(name), "largest error / largest force [-]", "time per point [ns]")
        axes.set_xlim(_FLOOR / 3.0, 3.0)
        axes.set_ylim(0.5, max(100.0, 2.0 * max(row.nanoseconds for row in rows)))
    legend_below(figure, panels[0])


def backbone_picture(rows: Sequence[BackboneRow]) -> Picture:
    """Error against the number of points."""
    caption = "Largest error of a sampled closed form, over its largest force, against the number of points."
    return Picture("backbones", caption, partial(_draw_backbones, rows), (10.0, 5.2))


def _draw_backbones(rows: Sequence[BackboneRow], figure: Figure) -> None:
    names = list(dict.fromkeys(row.backbone for row in rows))
    panels = figure.subplots(1, len(names), squeeze=False, sharey=True)[0]
    for axes, name in zip(panels, names, strict=True):
        for index, spacing in enumerate(dict.fromkeys(row.spacing for row in rows)):
            points = [row for row in rows if (row.backbone, row.spacing) == (name, spacing)]
            counts = [row.points for row in points]
            words = f"{spacing} points"
            axes.loglog(counts, [row.linear for row in points], label=f"{words}, straight lines", **style(2 * index))
            axes.loglog(counts, [row.pchip for row in points], label=f"{words}, PCHIP", **style(2 * index + 1))
        label(axes, name, "points on the curve [-]", "largest error / largest force [-]")
    legend_below(figure, panels[0])


def step_pictures(rows: Sequence[StepRow], cases: Sequence[Case]) -> list[Picture]:
    """Errors against the step: drops, then pull and drag; and the error of the speed against run time."""
    drops = [case for case in cases if case.name.startswith("drop")]
    others = [case for case in cases if not case.name.startswith("drop")]
    found = []
    for name, group in (("drop", drops), ("pull-drag", others)):
        if group:
            caption = f"Errors against the step, {name}: worst of eight runs; where a line ends, runs failed."
            size = (max(7.5, 4.2 * len(group)), 10.0)
            found.append(Picture(name, caption, partial(_draw_steps, rows, group), size))
    caption = "Error of the speed against run time per simulated second, eight runs side by side."
    found.append(Picture("run-time", caption, partial(_draw_times, rows, list(cases)), (12.5, 8.0)))
    return found


def _draw_steps(rows: Sequence[StepRow], cases: Sequence[Case], figure: Figure) -> None:
    panels = figure.subplots(3, len(cases), squeeze=False, sharex=True)
    for column, case in enumerate(cases):
        for line, quantity in enumerate(case.quantities):
            axes = panels[line][column]
            for index, scheme in enumerate(tried()):
                points = [row for row in rows if (row.case, row.scheme) == (case.name, scheme.name)]
                pairs = [(row.omega_dt, error) for row in points if (error := row.errors[line]) is not None]
                axes.loglog(*_columns(pairs), label=scheme.title, **style(index))
            _guides(axes)
            label(axes, _short(case.title) if line == 0 else "", "", f"error of {quantity} [-]")
            axes.set_ylim(1e-9, 30.0)
        panels[2][column].set_xlabel("step, omega dt [-]")
    legend_below(figure, panels[0][0], 3 if len(cases) < 3 else 6)


def _guides(axes: Axes) -> None:
    """How an error of first and of second order falls."""
    for order, dots, end in ((1, ":", 3e-2), (2, "--", 1e-2)):
        axes.loglog([1e-3, 1.0], [end * 1e-3**order, end], color="0.6", linestyle=dots, label=f"slope of order {order}")


def _draw_times(rows: Sequence[StepRow], cases: Sequence[Case], figure: Figure) -> None:
    across = 3
    down = -(-len(cases) // across)
    panels = figure.subplots(down, across, squeeze=False).reshape(-1)
    for axes, case in zip(panels, cases, strict=False):
        for index, scheme in enumerate(tried()):
            points = [row for row in rows if (row.case, row.scheme) == (case.name, scheme.name)]
            pairs = [(max(error, 1e-9), row.seconds) for row in points if (error := row.errors[1]) is not None]
            axes.loglog(*_columns(pairs), label=scheme.title, **style(index))
        label(axes, _short(case.title), f"error of {case.quantities[1]} [-]", "run time [s per simulated s]")
    for axes in panels[len(cases) :]:
        axes.remove()
    legend_below(figure, panels[0], 5)


def _columns(pairs: Sequence[tuple[float, float]]) -> tuple[list[float], list[float]]:
    return [pair[0] for pair in pairs], [pair[1] for pair in pairs]


def _short(name: str) -> str:
    return name if len(name) <= _LONGEST else name[: _LONGEST - 3] + "..."
