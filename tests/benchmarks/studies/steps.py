"""Every scheme on motions whose outcome is known, over a ladder of steps: error against work, and measured orders.

The work of a run is its number of force evaluations, those of Newton's iterations included, which does not depend on
the machine. Run times are measured too; all schemes take turns, so that what slows the machine slows all of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from statistics import median
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from tests.benchmarks.drawing import draw, label, legend_below, lines, panels
from tests.benchmarks.studies.motion import Scheme, march
from tests.benchmarks.studies.motions import Case, cases
from tests.benchmarks.studies.schemes import STABLE
from tests.benchmarks.tables import Cell, Row, digits, load, pivot, save

NAME = "precision-goals"
GOALS = {"1 %": 1e-2, "0.1 %": 1e-3}
"""Errors for which a step is looked up."""
LADDER = tuple(10.0 ** (power / 12.0) for power in range(12, -31, -1))
"""Of omega dt, from 10 down to 0.003, a factor of 1.21 apart."""
_FINEST = {"pull": 0.01, "drag": 0.01}
"""Laws with a history take ten times the time of a spring."""
_ENOUGH = 1e-4
"""A ladder ends where the error is below it."""
_ORDER_STEPS, _FLOOR = 0.1, 1e-11
"""Orders are measured at this omega dt and below; smaller errors are round-off."""
_REPEATS = 5
_HEADS = (("omega dt", "[-]"), ("evaluations a period", "[-]"), ("run time", "[s/s]"))
_MORE_STEPS = 8


class Tried(NamedTuple):
    """A scheme on a case at a step.

    error: largest of the three errors and of all runs; None where one of them failed or did not get that far.
    work: force evaluations of a run in a period 2 pi / omega.
    seconds: processor time of all runs side by side, per simulated second.
    """

    case: str
    scheme: Scheme
    omega_dt: float
    error: float | None
    work: float
    seconds: float

    def meets(self, goal: float) -> bool:
        """Whether all errors are at or below a goal."""
        return self.error is not None and self.error <= goal


def tried(case: Case, scheme: Scheme, omega_dt: float) -> Tried:
    """Run it."""
    nominal = omega_dt / case.omega
    start = case.start(nominal)
    steps = math.ceil(case.duration / float(start.dt.min())) + _MORE_STEPS
    run = march(scheme, case.system, start.motion, start.dt, steps, case.bound)
    with np.errstate(all="ignore"):
        errors = case.errors(run, start.dt)
    failed = run.failed.any() or np.isnan(errors).any()
    error = None if failed else float(errors.max())
    work = float(run.evaluations.mean()) / steps * 2.0 * math.pi / omega_dt
    return Tried(case.name, scheme, omega_dt, error, work, run.seconds / (steps * nominal))


def ladder(case: Case, scheme: Scheme) -> list[Tried]:
    """From the largest step down, until the error is small enough or the steps are."""
    found: list[Tried] = []
    for omega_dt in LADDER:
        if omega_dt >= _FINEST.get(case.name, 0.0):
            found.append(tried(case, scheme, omega_dt))
            if found[-1].meets(_ENOUGH) and omega_dt <= _ORDER_STEPS / 4.0:
                break
    return found


def largest_step(rows: Iterable[Tried], goal: float) -> Tried | None:
    """The largest step of a ladder up to which every error is at or below a goal."""
    best = None
    for row in sorted(rows, key=lambda row: row.omega_dt):
        if not row.meets(goal):
            break
        best = row
    return best


def order(rows: Iterable[Tried]) -> float | None:
    """The power of omega dt with which the error falls: least squares over the logarithms; None below two points."""
    points = [(row.omega_dt, row.error) for row in rows if row.omega_dt <= _ORDER_STEPS and (row.error or 0.0) > _FLOOR]
    if len(points) < 2:
        return None
    steps, errors = np.log(np.array(points, np.float64)).T
    return float(np.polyfit(steps, errors, 1)[0])


def run(progress: Callable[[str], None]) -> None:
    """Write table and picture."""
    rows: list[list[Cell]] = []
    ladders: dict[str, dict[str, list[Tried]]] = {}
    for case in cases():
        progress(f"time integration: {case.name}")
        own = ladders[case.name] = {scheme.title: ladder(case, scheme) for scheme in STABLE.values()}
        best = {(title, goal): largest_step(found, GOALS[goal]) for title, found in own.items() for goal in GOALS}
        times = _times(case, [row for row in best.values() if row is not None])
        for title, found in own.items():
            cells: list[Cell] = []
            for goal in GOALS:
                row = best[title, goal]
                cells += (None,) * 3 if row is None else (row.omega_dt, row.work, times[title, row.omega_dt])
            rows.append([case.name, title, order(found), *cells])
    heads = [f"{what} for {goal} {unit}" for goal in GOALS for what, unit in _HEADS]
    save(NAME, ["case", "scheme", "order", *heads], rows)
    draw("precision-work", partial(_draw, ladders), (12.5, 8.0))


def _times(case: Case, best: Sequence[Tried]) -> dict[tuple[str, float], float]:
    """Medians of the run times of some steps, measured in turns."""
    taken: dict[tuple[str, float], list[float]] = {}
    for _ in range(_REPEATS):
        for row in best:
            again = tried(case, row.scheme, row.omega_dt)
            taken.setdefault((row.scheme.title, row.omega_dt), []).append(again.seconds)
    return {key: median(values) for key, values in taken.items()}


def _draw(ladders: dict[str, dict[str, list[Tried]]], figure: Figure) -> None:
    axes_of = panels(figure, len(ladders), 3)
    for axes, (case, own) in zip(axes_of, ladders.items(), strict=True):
        lines(axes, {title: list(_points(rows)) for title, rows in own.items()})
        axes.set_xlim(1e-5, 3.0)
        for goal in GOALS.values():
            axes.axvline(goal, color="0.35", linewidth=1.0)
        label(axes, case, "largest relative error [-]", "force evaluations per period [-]")
    legend_below(figure, axes_of[0], 5)


def _points(rows: Iterable[Tried]) -> Iterator[tuple[float, float]]:
    return ((row.error, row.work) for row in rows if row.error is not None)


def _cells(row: Row) -> str:
    goal = next(iter(GOALS))
    step, work = row[f"omega dt for {goal} [-]"], row[f"evaluations a period for {goal} [-]"]
    return f"{digits(step, 2)} ({digits(work, 2)})" if step else "none"


TABLES = {"goals": lambda: pivot(load(NAME), "scheme", "case", _cells)}
