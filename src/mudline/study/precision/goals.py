"""Measured orders, the step and the work that a scheme needs for an error, advice for a deck, and pictures of them.

They have to be measured: contact that begins with a jump of the force reduces every scheme to first order.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from mudline.scene.model import Scene
from mudline.scene.oscillation import Oscillation, line_of, oscillations
from mudline.study import file_of
from mudline.study.pictures import Picture, Points, draw_lines, label, legend_below, panels, shortened
from mudline.study.precision.integration import ADVISED_GOALS, GOALS, TRIED, Case, Ladders, StepRow, largest_step
from mudline.study.report import Cell, Layout, StudyTable, columns_of
from mudline.study.schemes import PREFERRED, SCHEMES, STYLES

if TYPE_CHECKING:  # only drawing needs matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


STEP, WORK = "omega dt for {}", "force evaluations per period for {} [-]"
TIME, QUARTILE = "run time for {} [s/s]", "lower quartile of run time for {} [s/s]"
"""Headings of the table of goals, the goal in braces."""
ACCURACY, STABILITY = "accuracy", "stability"
"""What sets a step that is advised."""
ORDER_STEPS = 0.1
"""Orders are measured at this omega dt and below."""
_FLOOR = 1e-11
"""Smaller errors are round-off of thousands of steps and have no order."""
_LEAST = 1e-9
"""Smaller errors are drawn here."""
_ERROR = "largest relative error [-]"


def order(points: Iterable[tuple[float, float | None]]) -> float | None:
    """The power of omega dt with which errors fall: least squares over the logarithms; None below two points."""
    found = [(step, error) for step, error in points if step <= ORDER_STEPS and error is not None and error > _FLOOR]
    if len({step for step, _ in found}) < 2:
        return None
    steps, errors = np.log(np.array(found)).T
    return float(np.polyfit(steps, errors, 1)[0])


def order_of(ladder: Iterable[StepRow]) -> float | None:
    """The order of the largest of the three errors."""
    return order((row.omega_dt, row.worst) for row in ladder)


def _at_goal(field: str, goal: float, ladder: Sequence[StepRow]) -> Cell:
    found = largest_step(ladder, goal)
    cell: Cell = None if found is None else getattr(found, field)
    return cell


def _goal_columns(heading: str, field: str, goals: Sequence[float]) -> dict[str, partial[Cell]]:
    return {heading.format(f"{goal:g}"): partial(_at_goal, field, goal) for goal in goals}


REACHED = Layout[Sequence[StepRow]](
    "goals",
    "Largest step with all three errors at or below a goal, its work, and the order of the largest error",
    {
        "case": lambda ladder: ladder[0].case,
        "scheme": lambda ladder: SCHEMES[ladder[0].scheme].title,
        **_goal_columns(STEP, "omega_dt", GOALS),
        "order": order_of,
        **_goal_columns("step for {} [s]", "dt", ADVISED_GOALS),
        **_goal_columns(WORK, "work", ADVISED_GOALS),
        **_goal_columns(TIME, "seconds", ADVISED_GOALS),
        **_goal_columns(QUARTILE, "quick", ADVISED_GOALS),
        **_goal_columns("upper quartile of run time for {} [s/s]", "slow", ADVISED_GOALS),
    },
)


class OrderRow(NamedTuple):
    """The measured order of one error: between which steps, from how many of them."""

    case: Annotated[str, "case"]
    scheme: Annotated[str, "scheme"]
    quantity: Annotated[str, "error of"]
    order: Annotated[float | None, "order"]
    steps: Annotated[int, "steps"]
    smallest: Annotated[float | None, "smallest omega dt"]


ORDERS = Layout("orders", "Measured orders of the errors", columns_of(OrderRow), brief=False)


class Advice(NamedTuple):
    """The step with which a scheme is stable on every contact of the deck and keeps every error at or below a goal.

    dt: seconds; None where no step of the ladder meets the goal.
    omega_dt: of the motion that sets the step; None where stability sets it.
    case: the motion or, where stability sets the step, the contact that asks for the smallest one.
    line: of the deck, where its law stands.
    evaluations: of the forces, per simulated second.
    error: the largest on all contacts at this step, or at the next one that was run.
    limited: whether "accuracy" or "stability" sets the step.
    file: of the line, in a deck that is continued.
    """

    goal: Annotated[float, "goal [relative]"]
    scheme: Annotated[str, "scheme"]
    dt: Annotated[float | None, "step [s]"]
    omega_dt: Annotated[float | None, "omega dt"]
    case: Annotated[str, "set by"]
    line: Annotated[int | None, "deck line"]
    evaluations: Annotated[float | None, "force evaluations [1/s]"]
    error: Annotated[float | None, "largest error found [relative]"]
    limited: Annotated[str, "limited by"] = ACCURACY
    file: Annotated[str, "deck file"] = ""

    @property
    def effort(self) -> float:
        """The work, by which the schemes of a goal are sorted, with two digits: the rest is chance."""
        return math.inf if self.evaluations is None else float(f"{self.evaluations:.2g}")


ADVICE = Layout("advice", "Steps for this deck, the least work first", columns_of(Advice))


def study_goals(ladders: Ladders, cases: Sequence[Case], scene: Scene) -> list[StudyTable]:
    """Orders and needed steps of all schemes, and what follows for the deck."""
    contacts, _ = oscillations(scene, scene.contact_input("cut"))
    limits = [Limit(one, line_of(scene, one.where), file_of(scene, one.where)) for one in contacts]
    return [
        ADVICE.table(advised(ladders, cases, limits)),
        REACHED.table(ladders.values()),
        ORDERS.table(_orders(ladders, cases)),
    ]


def _orders(ladders: Ladders, cases: Sequence[Case]) -> Iterator[OrderRow]:
    quantities = {case.name: case.quantities for case in cases}
    for (case, scheme), rows in ladders.items():
        fine = [row for row in rows if row.omega_dt <= ORDER_STEPS]
        for index, quantity in enumerate(quantities[case]):
            points = [(row.omega_dt, row.errors[index]) for row in fine]
            used = [step for step, error in points if error is not None and error > _FLOOR]
            found = SCHEMES[scheme].title, quantity, order(points), len(used), min(used, default=None)
            yield OrderRow(case, *found)


class Limit(NamedTuple):
    """A contact of the deck that limits explicit steps, with its deck line and the file of a deck that is continued."""

    contact: Oscillation
    line: int
    file: str


def advised(ladders: Ladders, cases: Sequence[Case], limits: Sequence[Limit] = ()) -> list[Advice]:
    """For each goal the schemes by their work on the laws of the deck, then those that do not reach it.

    No step is above the critical step of the scheme on any contact, damping included: the motions of the study reach
    neither the slow pull-out of suction nor all contacts.
    """
    own = [case for case in cases if case.line is not None]
    # Of equal work the preferred one. Without velocities in the forces central difference is velocity Verlet.
    order_ = ("velocity-verlet", *PREFERRED)
    schemes = sorted(
        dict.fromkeys(scheme for _, scheme in ladders),
        key=lambda scheme: order_.index(scheme) if scheme in order_ else len(order_),
    )
    found = []
    for goal in ADVISED_GOALS if own else ():
        rows = [
            _advice(goal, scheme, [(case, ladders[case.name, scheme]) for case in own], limits) for scheme in schemes
        ]
        found += sorted(rows, key=lambda row: row.effort)
    return found


def _advice(goal: float, scheme: str, own: Sequence[tuple[Case, Sequence[StepRow]]], limits: Sequence[Limit]) -> Advice:
    title = SCHEMES[scheme].title
    found: list[tuple[float, Case, StepRow]] = []
    for case, rows in own:
        row = largest_step(rows, goal)
        if row is None:
            return Advice(goal, title, None, None, case.name, case.line, None, None, file=case.file)
        found.append((row.dt, case, row))
    dt, case, row = min(found, key=lambda one: one[0])
    limit = min(limits, key=lambda one: one.contact.critical_step(scheme), default=None)
    stable = math.inf if limit is None else limit.contact.critical_step(scheme)
    step = min(dt, stable)
    errors = []
    for _, rows in own:
        run = sorted((one for one in rows if one.worst is not None), key=lambda one: one.dt)
        below = [one for one in run if one.dt <= step * (1.0 + 1e-9)]
        errors += [one.worst or 0.0 for one in (below[-1:] or run[:1])]
    if limit is not None and stable < dt:
        work = row.evaluations * row.dt / stable
        by = limit.contact.name, limit.line, work, max(errors), STABILITY, limit.file
        return Advice(goal, title, stable, None, *by)
    return Advice(goal, title, dt, row.omega_dt, case.name, case.line, row.evaluations, max(errors), file=case.file)


# ------------------------------------------------------------------------------------------------------------- pictures


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
    """Run times that were measured once are left out: a single run may have waited for other programs."""
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
