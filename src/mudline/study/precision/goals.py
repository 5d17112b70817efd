"""What follows for a deck: measured orders, and the step and the work that a scheme needs for an error.

Nothing of it is known before: contact that begins with a jump of the force makes every scheme one of first order.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import Annotated, NamedTuple

import numpy as np

from mudline.study.precision.integration import GOALS, LADDER, Case, Ladders, StepRow, measured, meets
from mudline.study.report import Cell, Layout, StudyTable, columns_of
from mudline.study.schemes import SCHEMES, bracketed

ADVISED_GOALS = GOALS[:2]
"""Errors that a step is advised for."""
ORDER_STEPS = 0.1
"""Orders are measured at this omega dt and below."""
_FLOOR = 1e-11
"""Smaller errors are round-off of thousands of steps and have no order."""


def largest_step(ladder: Iterable[StepRow], goal: float) -> StepRow | None:
    """The largest step of a ladder up to which every error is at or below a goal."""
    best = None
    for row in sorted(ladder, key=lambda row: row.omega_dt):
        if not meets(row, goal):
            break
        best = row
    return best


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
        **_goal_columns("omega dt for {}", "omega_dt", GOALS),
        "order": order_of,
        **_goal_columns("step for {} [s]", "dt", ADVISED_GOALS),
        **_goal_columns("force evaluations per period for {} [-]", "work", ADVISED_GOALS),
        **_goal_columns("run time for {} [s/s]", "seconds", ADVISED_GOALS),
        **_goal_columns("lower quartile of run time for {} [s/s]", "quick", ADVISED_GOALS),
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
    """The step with which a scheme keeps every error on every contact of the deck at or below a goal.

    dt: seconds; None where the ladder has no such step.
    case: the motion that asks for the smallest step, and the line of the deck where its law stands.
    evaluations: of the forces, per simulated second.
    error: the largest on all contacts at this step, or at the next smaller one that was run.
    """

    goal: Annotated[float, "goal [relative]"]
    scheme: Annotated[str, "scheme"]
    dt: Annotated[float | None, "step [s]"]
    omega_dt: Annotated[float | None, "omega dt"]
    case: Annotated[str, "set by"]
    line: Annotated[int | None, "deck line"]
    evaluations: Annotated[float | None, "force evaluations [1/s]"]
    error: Annotated[float | None, "largest error found [relative]"]

    @property
    def effort(self) -> tuple[float, float]:
        """What the schemes of a goal are sorted by: work, and where that is the same the error."""
        work, error = (math.inf if value is None else value for value in (self.evaluations, self.error))
        return (float(f"{work:.3g}"), float(f"{error:.3g}"))


ADVICE = Layout("advice", "Steps for this deck, the least work first", columns_of(Advice))


def study_goals(ladders: Ladders, cases: Sequence[Case]) -> list[StudyTable]:
    """Orders and needed steps of all schemes, and what follows for the deck."""
    return [
        ADVICE.table(advised(ladders, cases)),
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


def advised(ladders: Ladders, cases: Sequence[Case]) -> list[Advice]:
    """For each goal the schemes by their work on the laws of the deck, then those that do not reach it."""
    own = [case for case in cases if case.line is not None]
    # Without velocities in the forces the central difference is velocity Verlet, which is advised then.
    schemes = sorted(dict.fromkeys(scheme for _, scheme in ladders), key=lambda scheme: scheme == "central-difference")
    found = []
    for goal in ADVISED_GOALS if own else ():
        rows = [_advice(goal, scheme, [(case, ladders[case.name, scheme]) for case in own]) for scheme in schemes]
        found += sorted(rows, key=lambda row: row.effort)
    return found


def _advice(goal: float, scheme: str, own: Sequence[tuple[Case, Sequence[StepRow]]]) -> Advice:
    title = SCHEMES[scheme].title
    found: list[tuple[float, Case, StepRow]] = []
    for case, rows in own:
        row = largest_step(rows, goal)
        if row is None:
            return Advice(goal, title, None, None, case.name, case.line, None, None)
        found.append((row.dt, case, row))
    dt, case, row = min(found, key=lambda one: one[0])
    errors = [row.worst or 0.0]
    for _, rows in own:
        below = [one for one in rows if one.dt <= dt * (1.0 + 1e-9) and one.worst is not None]
        errors += [one.worst or 0.0 for one in sorted(below, key=lambda one: one.dt)[-1:]]
    return Advice(goal, title, dt, row.omega_dt, case.name, case.line, row.evaluations, max(errors))


class Needed(NamedTuple):
    """What a scheme needs on a motion for an error.

    omega_dt, evaluations: the largest step, and its force evaluations per period 2 pi / omega; None where even the
    smallest step of the ladder is not enough.
    order: with which the largest error falls, where it was measured.
    """

    scheme: str
    goal: float
    omega_dt: float | None
    evaluations: float | None
    order: float | None


def needed(case: Case, schemes: Iterable[str], goals: Sequence[float] = ADVISED_GOALS) -> list[Needed]:
    """Measure the steps that schemes need on one motion, as quickly as possible: some tenths of a second for each.

    The steps of the ladder are tried from the largest on, until two of them in a row meet the smallest goal.
    """
    found = []
    for name in schemes:
        rows: list[StepRow] = []
        for tried in sorted(LADDER, reverse=True):
            rows += measured(case, [bracketed(SCHEMES[name])], tried, 0)
            if len(rows) > 1 and all(meets(row, min(goals)) for row in rows[-2:]):
                break
        for goal in goals:
            step = largest_step(rows, goal)
            omega_dt, work = (None, None) if step is None else (step.omega_dt, step.work)
            found.append(Needed(name, goal, omega_dt, work, order_of(rows)))
    return found
