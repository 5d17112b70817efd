"""Pictures of the motions: which step a scheme needs, and what it costs in force evaluations and in run time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

from mudline.study.pictures import Picture, Points, draw_lines, label, legend_below, panels, shortened
from mudline.study.precision.goals import ADVISED_GOALS, largest_step
from mudline.study.precision.integration import TRIED, Case, Ladders, StepRow
from mudline.study.schemes import STYLES

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LEAST = 1e-9
"""Smaller errors are drawn here."""
_ERROR = "largest relative error [-]"


def motion_pictures(ladders: Ladders, cases: Sequence[Case]) -> Iterator[Picture]:
    """Needed steps of drops, then of pull and drag; the error against force evaluations and against run time."""
    drops = [case for case in cases if case.name.startswith("drop")]
    others = [case for case in cases if not case.name.startswith("drop")]
    goals = " and ".join(f"{100.0 * goal:g} %" for goal in ADVISED_GOALS)
    for name, group in (("drop", drops), ("pull-drag", others)):
        if group:
            caption = (
                f"Which step a scheme needs ({name}). Above: the largest of three errors, worst of all phases; where a "
                f"line ends, runs failed. Below: the largest step for {goals}."
            )
            yield Picture(name, caption, partial(_draw_steps, ladders, group), (max(8.0, 4.6 * len(group)), 9.0))
    caption = "Work for an error: force evaluations per period of the contact, Newton's iterations included."
    yield Picture("work", caption, partial(_draw_work, ladders, cases), (12.5, 8.0))
    caption = "Run time for an error: medians and quartiles of five runs, all phases side by side, schemes in turns."
    yield Picture("run-time", caption, partial(_draw_times, ladders, cases), (12.5, 8.0))


def _lines(ladders: Ladders, case: Case, point: Callable[[StepRow], tuple[float, float] | None]) -> dict[str, Points]:
    """A line for each scheme on a case, through the points that there are."""
    found = {scheme.title: map(point, ladders.get((case.name, name), ())) for name, scheme in TRIED.items()}
    return {title: [point for point in points if point is not None] for title, points in found.items()}


def _draw_steps(ladders: Ladders, cases: Sequence[Case], figure: Figure) -> None:
    axes_of = figure.subplots(2, len(cases), squeeze=False, sharex=True, sharey="row", height_ratios=(3, 2))
    for column, case in enumerate(cases):
        above, below = axes_of[0][column], axes_of[1][column]
        y = _ERROR if column == 0 else ""
        draw_lines(above, _lines(ladders, case, _at_step), shortened(case.title), "", y, STYLES)
        for goal in ADVISED_GOALS:
            above.axhline(goal, color="0.35", linewidth=1.0)
            above.annotate(
                f"{100.0 * goal:g} %", (1.0, goal), xycoords=("axes fraction", "data"), ha="right", va="bottom"
            )
        above.set_ylim(1e-6, 3.0)
        _draw_needed(below, ladders, case)
    legend_below(figure, axes_of[0][0], 3 if len(cases) < 3 else 5)


def _at_step(row: StepRow) -> tuple[float, float] | None:
    return None if row.worst is None else (row.omega_dt, max(row.worst, _LEAST))


def _draw_needed(axes: Axes, ladders: Ladders, case: Case) -> None:
    """A row for each scheme: its largest steps for the goals, and its force evaluations per period for them."""
    names = list(TRIED)
    for place, name in enumerate(reversed(names)):
        steps = [largest_step(ladders.get((case.name, name), ()), goal) for goal in ADVISED_GOALS]
        points = [row.omega_dt for row in steps if row is not None]
        look = STYLES[TRIED[name].title] | {"linestyle": "none", "markersize": 8}
        axes.semilogx(points, [place] * len(points), **(look | {"marker": "", "linestyle": "-"}))
        for row, face in zip(steps, ("full", "none"), strict=True):
            if row is not None:
                axes.semilogx([row.omega_dt], [place], **look, fillstyle=face)
        work = " / ".join("-" if row is None else f"{row.work:.0f}" for row in steps)
        axes.annotate(
            work, (0.99, place), xycoords=("axes fraction", "data"), ha="right", va="center", fontsize="small"
        )
    axes.set_yticks(range(len(names)), [TRIED[name].title for name in reversed(names)], fontsize="small")
    axes.set_ylim(-0.6, len(names) - 0.4)
    first, second = (f"{100.0 * goal:g} %" for goal in ADVISED_GOALS)
    label(axes, "", "step, omega dt [-]", "")
    axes.set_title(f"filled: for {first}, open: {second}", loc="left", fontsize="small")
    axes.set_title("evaluations per period", loc="right", fontsize="small")


def _draw_work(ladders: Ladders, cases: Sequence[Case], figure: Figure) -> None:
    found = panels(figure, len(cases), 3)
    for axes, case in zip(found, cases, strict=True):
        y = "force evaluations per period [-]"
        draw_lines(axes, _lines(ladders, case, _at_work), shortened(case.title), _ERROR, y, STYLES)
        _mark_goals(axes)
    legend_below(figure, found[0], 5)


def _at_work(row: StepRow) -> tuple[float, float] | None:
    return None if row.worst is None else (max(row.worst, _LEAST), row.work)


def _mark_goals(axes: Axes) -> None:
    axes.set_xlim(1e-5, 3.0)
    for goal in ADVISED_GOALS:
        axes.axvline(goal, color="0.35", linewidth=1.0)


def _draw_times(ladders: Ladders, cases: Sequence[Case], figure: Figure) -> None:
    """Where the run time was measured once there is no point: a single run may have waited for other programs."""
    found = panels(figure, len(cases), 3)
    for axes, case in zip(found, cases, strict=True):
        y = "run time [s per simulated s]"
        draw_lines(axes, _lines(ladders, case, _at_run_time), shortened(case.title), _ERROR, y, STYLES)
        for name, scheme in TRIED.items():
            rows = [row for row in ladders.get((case.name, name), ()) if _at_run_time(row)]
            errors = [row.worst or 0.0 for row in rows]
            axes.vlines(
                errors,
                [row.quick or 0.0 for row in rows],
                [row.slow or 0.0 for row in rows],
                color=STYLES[scheme.title]["color"],
                linewidth=3.0,
                alpha=0.5,
            )
        _mark_goals(axes)
    legend_below(figure, found[0], 5)


def _at_run_time(row: StepRow) -> tuple[float, float] | None:
    return None if row.worst is None or row.quick is None else (max(row.worst, _LEAST), row.seconds)
