"""Motions of a mass on the seabed whose outcome is known, and every scheme on them over a ladder of steps."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.study.motion import Motion, Scheme, System, Trajectory, march
from mudline.study.pictures import Picture, Points, draw_lines, legend_below, panels, shortened
from mudline.study.report import Layout, Omission, Section, StudyOptions, columns_of, grouped
from mudline.study.schemes import SCHEMES, STYLES

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

RUNS = 8
"""Runs side by side, which land at other phases of a step; the worst of them counts."""
LADDER = (1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 3.0, 10.0)
"""Of omega dt."""
FINE_LADDER = tuple(10.0 ** (power / 6.0) for power in range(-18, 7))
GOALS = (1e-2, 1e-3, 1e-4)
"""Errors for which a step is looked up."""
TRIED = {name: scheme for name, scheme in SCHEMES.items() if scheme.limit > 0.0}
"""The schemes of this study: those that are stable on an oscillator at some step."""
_MORE_STEPS = 8
_MOST_STEPS = 60_000
_FAILED = (None, None, None)

# -------------------------------------------------------------------------------------------------------------- motions


class Start(NamedTuple):
    """Where the runs begin, and the step of each (k,)."""

    motion: Motion
    dt: FloatArray


@dataclass(frozen=True, slots=True)
class Case:
    """A motion.

    Attributes:
        name: a word for tables.
        title: for people.
        omega: square root of the steepest stiffness over the mass, 1/s.
        duration: seconds that the motion takes.
        reference: where the exact values come from.
        quantities: names of the three errors that are measured, each relative to the exact value.
        system: `RUNS` copies of the mass.
        bound: positions beyond this have run away.
        start: the start of the runs for a nominal step.
        errors: (3, k) amounts of the errors; NaN where the motion did not get so far.
        missing: what NaN means.
    """

    name: Annotated[str, "case"]
    title: Annotated[str, "what"]
    omega: Annotated[float, "omega [1/s]"]
    duration: Annotated[float, "duration [s]"]
    reference: Annotated[str, "reference"]
    quantities: tuple[str, str, str]
    system: System
    bound: float
    start: Callable[[float], Start]
    errors: Callable[[Trajectory], FloatArray]
    missing: str


def uneven(dt: float) -> FloatArray:
    """Steps (k,) up to 18 % shorter than dt: events of a motion that always begins alike fall at other phases."""
    return dt * (1.0 - np.arange(RUNS) / 40.0)


CASES = Layout("cases", "Motions that are integrated", columns_of(Case))

# ---------------------------------------------------------------------------------------------------------------- steps


class StepRow(NamedTuple):
    """A scheme on a case at a step: the largest errors of all runs, None where one of them failed.

    amount, speed, energy: errors of the three quantities of the case.
    seconds, evaluations: of run time, and of the forces, per simulated second; all runs side by side count as one.
    iterations: the mean.
    reason: why the first of the runs that failed did.
    """

    case: Annotated[str, "case"]
    scheme: Annotated[str, "scheme"]
    omega_dt: Annotated[float, "omega dt"]
    dt: Annotated[float, "step [s]"]
    steps: Annotated[int, "steps"]
    amount: Annotated[float | None, "error of penetration, suction or way [relative]"]
    speed: Annotated[float | None, "error of speed [relative]"]
    energy: Annotated[float | None, "error of energy or work [relative]"]
    seconds: Annotated[float, "run time [s/s]"]
    evaluations: Annotated[float, "force evaluations [1/s]"]
    iterations: Annotated[float, "Newton iterations per step"]
    failed: Annotated[int, "failed runs"]
    reason: Annotated[str, "reason"]

    @property
    def errors(self) -> tuple[float | None, float | None, float | None]:
        """All three."""
        return self.amount, self.speed, self.energy


Ladders = Mapping[tuple[str, str], Sequence[StepRow]]
"""The rows of each case and scheme."""
STEPS = Layout("steps", "Time integration", columns_of(StepRow), brief=False)


def _largest_step(ladder: Sequence[StepRow], goal: float) -> float | None:
    """The largest omega dt of a ladder up to which every error stays below a goal."""
    best = None
    for row in sorted(ladder, key=lambda row: row.omega_dt):
        if any(error is None or not error <= goal for error in row.errors):
            break
        best = row.omega_dt
    return best


REACHED = Layout[Sequence[StepRow]](
    "goals",
    "Largest step with all three errors below a goal",
    {
        "case": lambda ladder: ladder[0].case,
        "scheme": lambda ladder: SCHEMES[ladder[0].scheme].title,
        **{f"omega dt for {goal:g}": partial(_largest_step, goal=goal) for goal in GOALS},
    },
)


def study_motions(cases: Sequence[Case], options: StudyOptions) -> Section:
    """Every scheme on every case over the ladder of steps."""
    rows: list[StepRow] = []
    for case in options.each(cases, lambda case: f"time integration: {case.title}"):
        ladder = FINE_LADDER if options.full else LADDER
        rows += [row(case, scheme, omega_dt) for scheme in TRIED.values() for omega_dt in ladder]
    ladders = grouped(rows, lambda row: (row.case, row.scheme))
    tables = CASES.table(cases), REACHED.table(ladders.values()), STEPS.table(rows)
    return Section(tables, list(_pictures(ladders, cases)), omissions=list(_failures(ladders)))


def row(case: Case, scheme: Scheme, omega_dt: float) -> StepRow:
    """One scheme on one case at one step."""
    nominal = omega_dt / case.omega
    start = case.start(nominal)
    steps = math.ceil(case.duration / float(start.dt.min())) + _MORE_STEPS
    if steps > _MOST_STEPS:
        reason = f"it would take {steps} steps: the stiffnesses of the seabed differ too much"
        return StepRow(case.name, scheme.name, omega_dt, nominal, steps, *_FAILED, 0.0, 0.0, 0.0, RUNS, reason)
    run = march(scheme, case.system, start.motion, start.dt, steps, case.bound)
    with np.errstate(all="ignore"):
        errors = case.errors(run)
    missing: BoolArray = np.any(np.isnan(errors), axis=0)
    missing[list(run.failures)] = True
    reason, failed = "", int(missing.sum())
    if failed:
        why = run.failures.get(int(np.argmax(missing)), case.missing)
        reason = f"{failed} of {RUNS} runs: {why}"
    amount, speed, energy = _FAILED if failed else np.max(errors, axis=1).tolist()
    simulated = steps * nominal
    return StepRow(
        case.name,
        scheme.name,
        omega_dt,
        nominal,
        steps,
        amount,
        speed,
        energy,
        run.seconds / simulated,
        run.evaluations / simulated,
        float(run.iterations.mean()),
        failed,
        reason,
    )


def _failures(ladders: Ladders) -> Iterator[Omission]:
    """One for each scheme on each case, with the steps at which it failed."""
    for (case, scheme), rows in ladders.items():
        failed = [row for row in rows if row.reason]
        if failed:
            steps = ", ".join(f"{row.omega_dt:.3g}" for row in failed)
            yield Omission(f"{scheme}, {case}, omega dt {steps}", failed[0].reason)


# ------------------------------------------------------------------------------------------------------------- pictures


def _pictures(ladders: Ladders, cases: Sequence[Case]) -> Iterator[Picture]:
    """Errors against the step: drops, then pull and drag; and the error of the speed against run time."""
    drops = [case for case in cases if case.name.startswith("drop")]
    others = [case for case in cases if not case.name.startswith("drop")]
    for name, group in (("drop", drops), ("pull-drag", others)):
        if group:
            caption = f"Errors against the step, {name}: worst of eight runs; where a line ends, runs failed."
            yield Picture(name, caption, partial(_draw_steps, ladders, group), (max(7.5, 4.2 * len(group)), 10.0))
    caption = "Error of the speed against run time per simulated second, eight runs side by side."
    yield Picture("run-time", caption, partial(_draw_times, ladders, cases), (12.5, 8.0))


def _lines(ladders: Ladders, case: Case, point: Callable[[StepRow], tuple[float, float] | None]) -> dict[str, Points]:
    """A line for each scheme on a case, through the points that there are."""
    found = {scheme.title: map(point, ladders.get((case.name, name), ())) for name, scheme in TRIED.items()}
    return {title: [point for point in points if point is not None] for title, points in found.items()}


def _draw_steps(ladders: Ladders, cases: Sequence[Case], figure: Figure) -> None:
    axes_of = figure.subplots(3, len(cases), squeeze=False, sharex=True)
    for column, case in enumerate(cases):
        for line, quantity in enumerate(case.quantities):
            axes = axes_of[line][column]
            title = shortened(case.title) if line == 0 else ""
            y = f"relative error of {quantity} [-]"
            draw_lines(axes, _lines(ladders, case, partial(_at_step, line)), title, "", y, STYLES)
            _guides(axes)
            axes.set_ylim(1e-9, 30.0)
        axes_of[2][column].set_xlabel("step, omega dt [-]")
    legend_below(figure, axes_of[0][0], 3 if len(cases) < 3 else 6)


def _at_step(quantity: int, row: StepRow) -> tuple[float, float] | None:
    error = row.errors[quantity]
    return None if error is None else (row.omega_dt, error)


def _guides(axes: Axes) -> None:
    """How an error of first and of second order falls."""
    for order, dots, end in ((1, ":", 3e-2), (2, "--", 1e-2)):
        axes.loglog([1e-3, 1.0], [end * 1e-3**order, end], color="0.6", linestyle=dots, label=f"slope of order {order}")


def _draw_times(ladders: Ladders, cases: Sequence[Case], figure: Figure) -> None:
    found = panels(figure, len(cases), 3)
    for axes, case in zip(found, cases, strict=True):
        x, y = f"relative error of {case.quantities[1]} [-]", "run time [s per simulated s]"
        draw_lines(axes, _lines(ladders, case, _at_run_time), shortened(case.title), x, y, STYLES)
    legend_below(figure, found[0], 5)


def _at_run_time(row: StepRow) -> tuple[float, float] | None:
    return None if row.speed is None else (max(row.speed, 1e-9), row.seconds)
