"""Motions of a mass on the seabed whose outcome is known, and every scheme on them over a ladder of steps.

The work of a run is its number of force evaluations, those of Newton's iterations included, which does not depend on
the machine. Run times are measured too; all schemes take turns, so that what slows the machine slows all of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.study.motion import Motion, Scheme, System, Trajectory, march
from mudline.study.report import Layout, Omission, Section, StudyOptions, columns_of, grouped
from mudline.study.schemes import SCHEMES, bracketed

RUNS = 64
"""Runs side by side, which land at different phases of a step; the worst of them counts."""
LADDER = (1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 3.0, 10.0)
"""Of omega dt; without --full it ends at the smallest of a case, or where the smallest goal is met."""
_WIDEST = max(b / a for a, b in pairwise(LADDER))
"""The largest factor between two steps of the ladder."""
FINE_LADDER = tuple(10.0 ** (power / 6.0) for power in range(-18, 7))
GOALS = (1e-2, 1e-3, 1e-4)
"""Errors for which a step is looked up."""
ADVISED_GOALS = GOALS[:2]
"""Errors that a step is advised for: the largest one is looked for between two steps of the ladder."""
PARTS = 8
"""Into which the factor between these two is divided; errors do not always grow with the step, so none is skipped."""
COMPARED = ("velocity-verlet", "newmark", "rk4")
"""Schemes whose largest steps the page compares: as many closer steps below each have to meet the goal too."""
_CLOSER = 4
"""How many times as close."""
TRIED = {name: bracketed(scheme) for name, scheme in SCHEMES.items() if scheme.limit > 0.0}
"""The schemes of this study: those that are stable on an oscillator at some step; implicit ones solved in a bracket."""
REPEATS = 5
"""Timings of a run."""
_TIMED = 1.0
"""Largest omega dt of runs that are timed more than once: larger ones are of no use."""
_TIMED_STEPS = {False: 250, True: 2500}
"""Longer runs are not repeated, without and with --full."""
_FINE = 1e-2
"""Every ladder goes down to this omega dt: an order needs several steps."""
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
        name: identifier in tables.
        title: for readers.
        omega: square root of the steepest stiffness over the mass, 1/s.
        duration: seconds that the motion takes.
        reference: where the exact values come from.
        quantities: names of the three errors that are measured, each relative to the exact value.
        system: `RUNS` copies of the mass.
        bound: positions beyond this have diverged.
        start: the start of the runs for a nominal step.
        errors: (3, k) absolute values of the errors; NaN where the motion did not get that far.
        missing: why an error is NaN.
        finest: the smallest omega dt without --full.
        line: of the deck, where the law stands; None where the law is not the deck's.
    file: of that line, where it is in a deck that this one continues; "" for this deck.
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
    finest: float = 3e-3
    line: Annotated[int | None, "deck line"] = None
    file: Annotated[str, "deck file"] = ""


def uneven(dt: float) -> FloatArray:
    """Steps (k,) up to 18 % shorter than dt, so that events of runs that start alike fall at different phases."""
    return dt * (1.0 - np.linspace(0.0, 0.175, RUNS))


CASES = Layout[Case](
    "cases",
    "Integrated motions",
    {**columns_of(Case), "runs side by side": lambda case: len(case.system.mass)},
)

# ---------------------------------------------------------------------------------------------------------------- steps


class StepRow(NamedTuple):
    """A scheme on a case at a step: the largest errors of all runs, None where one of them failed.

    amount, speed, energy: errors of the three quantities of the case.
    seconds: median of the run time per simulated second, all runs side by side.
    evaluations: mean number of force evaluations of a run per simulated second; its start takes one more.
    iterations: the mean.
    reason: why the first of the runs that failed did.
    work: force evaluations per period 2 pi / omega.
    quick, slow: quartiles of the run time; None where it was measured once.
    repeats: how often the run time was measured.
    bracketed: steps of all runs in which Newton's method left the bracket.
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
    work: Annotated[float, "force evaluations per period [-]"] = 0.0
    quick: Annotated[float | None, "lower quartile of run time [s/s]"] = None
    slow: Annotated[float | None, "upper quartile of run time [s/s]"] = None
    repeats: Annotated[int, "repeats"] = 1
    bracketed: Annotated[int, "steps that needed the bracket"] = 0

    @property
    def errors(self) -> tuple[float | None, float | None, float | None]:
        """All three."""
        return self.amount, self.speed, self.energy

    @property
    def worst(self) -> float | None:
        """The largest error, which a goal is compared with."""
        found = [error for error in self.errors if error is not None and math.isfinite(error)]
        return max(found) if len(found) == len(self.errors) else None


Ladders = Mapping[tuple[str, str], Sequence[StepRow]]
"""The rows of each case and scheme."""
STEPS = Layout("steps", "Time integration", columns_of(StepRow), brief=False)


def study_motions(cases: Sequence[Case], options: StudyOptions) -> tuple[Ladders, Section]:
    """Every scheme on every case over the ladder of steps."""
    rows: list[StepRow] = []
    for case in options.each(cases, lambda case: f"time integration: {case.title}"):
        rows += ladder_rows(case, TRIED, full=options.full)
    ladders = grouped(rows, lambda row: (row.case, row.scheme))
    return ladders, Section([CASES.table(cases), STEPS.table(rows)], omissions=list(_failures(ladders)))


def ladder_rows(case: Case, schemes: Mapping[str, Scheme], *, full: bool) -> list[StepRow]:
    """Every scheme on a case, each from its smallest step to its largest; run from the largest to the smallest.

    Besides the steps of the ladder there are those that were tried to find the largest one for `ADVISED_GOALS`.
    """
    steps = FINE_LADDER if full else [step for step in LADDER if step >= case.finest]
    left, found = dict(schemes), list[StepRow]()
    for omega_dt in sorted(steps, reverse=True):
        rows = measured(case, [(scheme, omega_dt) for scheme in left.values()], _TIMED_STEPS[full])
        if not full and omega_dt <= _FINE:
            left = {row.scheme: schemes[row.scheme] for row in rows if not meets(row, GOALS[-1])}
        found += rows
    for goal in ADVISED_GOALS:
        for look in (_up_to, _below):
            for name, ladder in grouped(found, lambda row: row.scheme).items():
                found += look(goal, case, schemes[name], ladder)
    for goal in ADVISED_GOALS:
        best = [largest_step(ladder, goal) for ladder in grouped(found, lambda row: row.scheme).values()]
        again = [(schemes[row.scheme], row.omega_dt) for row in best if row is not None and row.repeats == 1]
        timed = {(row.scheme, row.omega_dt): row for row in measured(case, again, _TIMED_STEPS[full])}
        found = [timed.get((row.scheme, row.omega_dt), row) for row in found]
    order = list(schemes)
    return sorted(found, key=lambda row: (order.index(row.scheme), row.omega_dt))


def largest_step(ladder: Iterable[StepRow], goal: float) -> StepRow | None:
    """The largest step of a ladder up to which every error is at or below a goal."""
    best = None
    for row in sorted(ladder, key=lambda row: row.omega_dt):
        if not meets(row, goal):
            break
        best = row
    return best


def _up_to(goal: float, case: Case, scheme: Scheme, ladder: Sequence[StepRow]) -> Iterator[StepRow]:
    """Steps from the largest one of a ladder for a goal towards the next, up to the first that does not meet it."""
    best = largest_step(ladder, goal)
    larger = [row.omega_dt for row in ladder if best is not None and row.omega_dt > best.omega_dt]
    if best is None or not larger:
        return
    for part in range(1, PARTS):
        tried = row(case, scheme, best.omega_dt * (min(larger) / best.omega_dt) ** (part / PARTS))
        yield tried
        if not meets(tried, goal):
            return


def _below(goal: float, case: Case, scheme: Scheme, ladder: Sequence[StepRow]) -> Iterator[StepRow]:
    """Steps just below the largest one for a goal, closer to each other; below a smaller one where one fails."""
    if scheme.name not in COMPARED:
        return
    rows, best = list(ladder), largest_step(ladder, goal)
    smallest = min(row.omega_dt for row in rows)
    while best is not None:
        steps = [best.omega_dt * _WIDEST ** (-part / (_CLOSER * PARTS)) for part in range(1, PARTS + 1)]
        known = np.array([one.omega_dt for one in rows])
        tried = [row(case, scheme, step) for step in steps if step > smallest and not np.isclose(known, step).any()]
        yield from tried
        rows += tried
        found = largest_step(rows, goal)
        best = None if all(meets(one, goal) for one in tried) else found


def meets(row: StepRow, goal: float) -> bool:
    """Whether all errors are at or below a goal."""
    return row.worst is not None and row.worst <= goal


def measured(case: Case, tries: Sequence[tuple[Scheme, float]], timed_steps: int) -> list[StepRow]:
    """Schemes on a case, each at an omega dt; runs of at most so many steps are timed `REPEATS` times, in turns."""
    found = [[row(case, *one)] for one in tries]
    for _ in range(REPEATS - 1):
        for (scheme, omega_dt), rows in zip(tries, found, strict=True):
            if omega_dt <= _TIMED and rows[0].steps <= timed_steps:
                rows.append(row(case, scheme, omega_dt))
    return [_timed(rows) for rows in found]


def _timed(rows: Sequence[StepRow]) -> StepRow:
    """The first of equal rows, with the run times of all."""
    if len(rows) == 1:
        return rows[0]
    quick, median, slow = np.percentile([row.seconds for row in rows], (25, 50, 75)).tolist()
    return rows[0]._replace(seconds=median, quick=quick, slow=slow, repeats=len(rows))


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
    evaluations = float(run.evaluations.mean()) / steps
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
        evaluations / nominal,
        float(run.iterations.mean()),
        failed,
        reason,
        evaluations * 2.0 * math.pi / omega_dt,
        bracketed=int(run.bisected.sum()),
    )


def _failures(ladders: Ladders) -> Iterator[Omission]:
    """One for each scheme on each case, with the steps at which it failed."""
    for (case, scheme), rows in ladders.items():
        failed = [row for row in rows if row.reason]
        if failed:
            steps = ", ".join(f"{row.omega_dt:.3g}" for row in failed)
            yield Omission(f"{scheme}, {case}, omega dt {steps}", failed[0].reason)
