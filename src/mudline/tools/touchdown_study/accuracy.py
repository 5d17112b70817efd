"""Errors of time steps and elements of a touchdown zone, against a finer run of the same zone."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from mudline.model.results.stage_times import Timer
from mudline.model.scene.load_case import OwnSteps, generalised_alpha
from mudline.tools.touchdown_study.beam import BeamRun, NotConvergedError
from mudline.tools.touchdown_study.stability import change, unstable
from mudline.tools.touchdown_study.zone import Measures, Variant, Zone

SHORT, COARSE, ADVISED = 0.02, 0.05, 0.01
"""Largest errors of a step that is short enough, of a coarse step, and of an advised step."""
MOST_STEPS = 20_000
_FEW = 96.0
"""Number of steps of a run below which no step twice as long is tried."""
_BOUNCING = 5.0
"""Ratio of landings to those of the reference above which a run is unstable."""
_LEAST_LANDINGS = 20
_UNDAMPED, _REFERENCE = 0.8, 0.4
"""Spectral radius from which on a scheme is no reference, and that of the scheme in its place."""
_NO_STEP = 100.0
"""Steps of a period that are tried if the deck has none."""


class Errors(NamedTuple):
    """Errors against a reference: rms of the touchdown point over its travel; of range and force, with signs."""

    touchdown: float
    range: float
    force: float


@dataclass(frozen=True)
class StepRow:
    """A time step.

    Attributes:
        step: the step.
        own: True for the deck's step.
        run_time: seconds of processor time for a second of motion.
        measures: results of the run.
        run: the run.
        errors: errors; None for the reference and for unstable runs.
        rms: rms error of the touchdown point, in the deck's unit of length.
        state: reason why a run has no errors, or "".
    """

    step: float
    own: bool
    run_time: float | None = None
    measures: Measures | None = field(default=None, repr=False)
    run: BeamRun | None = field(default=None, repr=False)
    errors: Errors | None = None
    rms: float | None = None
    state: str = ""

    @property
    def worst(self) -> float:
        """The largest error; infinite for a run that is unstable, or did not end."""
        return math.inf if self.errors is None else max(map(abs, self.errors))

    def json(self) -> dict[str, Any]:
        """Return the row as in JSON."""
        measures, run = self.measures, self.run
        errors = self.errors or (None, None, None)
        return {
            "step": self.step,
            "own": self.own,
            "largest_force": measures and measures.largest_force,
            "largest_moment": measures and measures.largest_moment,
            "moment_range": measures and measures.moment_range,
            "touchdown": measures and [float(measures.touchdown.min()), float(measures.touchdown.max())],
            **dict(zip(("touchdown_error", "range_error", "force_error"), errors, strict=True)),
            "iterations": {"mean": run and run.mean_iterations, "most": run and run.most_iterations},
            "searches": run and run.searches,
            "cuts": run and run.cuts,
            "run_time": self.run_time,
        }


class Mesh(NamedTuple):
    """Changes by halving the elements at a step, and the verdict with a consistent element matrix."""

    step: float
    element_length: tuple[float, float]
    changes: Errors | None
    consistent_verdict: str | None

    def json(self) -> dict[str, Any]:
        """Return the row as in JSON."""
        names = ("touchdown_error", "range_change", "force_change")
        return {
            "step": self.step,
            "element_length": list(self.element_length),
            **dict(zip(names, self.changes or (None, None, None), strict=True)),
            "consistent_matrix": {"verdict": self.consistent_verdict},
        }


_LADDERS = (
    ((2.0, 1.0, 0.5, 0.25), 0.125),
    ((2.0, 1.0, 0.5), 0.25),
    ((2.0, 1.0), 0.5),
    ((4.0, 2.0), 1.0),
)
"""Steps of the rows and of the reference over the deck's step, the best first."""


def _steps_of(zone: Zone, own: OwnSteps | None) -> tuple[list[tuple[float, bool]], float]:
    """Return the steps of the rows, the largest first, each with True for the deck's; and that of the reference."""
    period = zone.motion.period
    base, given = (period / _NO_STEP, False) if own is None else (own.largest, True)
    budget = MOST_STEPS // zone.cost
    fit: list[tuple[tuple[float, ...], float]] = []
    while True:
        whole = zone.periods * period / base
        fit = [each for each in _LADDERS if whole * (sum(1.0 / part for part in each[0]) + 1.0 / each[1]) <= budget]
        if fit:
            break
        base, given = 2.0 * base, False  # the deck's step takes too long to run: longer steps show whether it is needed
    factors, reference = fit[0]
    steps = {base * part: given and part == 1.0 for part in factors if part <= 1.0 or whole >= _FEW}
    first = own.first if own is not None and given else base
    near = next((step for step in steps if abs(step / first - 1.0) < ADVISED), first)
    if first < base and near >= base * reference:
        steps[near] = True
    return sorted(steps.items(), reverse=True), base * reference


def _measured(zone: Zone, step: float, timer: Timer, variant: Variant = Variant(), *, own: bool = False) -> StepRow:  # noqa: B008 - a constant
    """Return a row without errors."""
    span, began = zone.periods * zone.motion.period, timer()
    try:
        measures, run = zone.run(max(round(span / step), 4 * zone.periods), zone.periods, variant)
    except NotConvergedError:
        return StepRow(step, own, state="does not converge")
    if not np.isfinite(measures.touchdown).all():
        return StepRow(step, own, state="has no touchdown in its zone")
    return StepRow(step, own, (timer() - began) / span, measures, run)


def _against(row: StepRow, reference: StepRow) -> StepRow:
    """Return a row with its errors against a reference; an unstable run has none."""
    coarse, exact, run, fine = row.measures, reference.measures, row.run, reference.run
    if coarse is None or exact is None or run is None or fine is None:
        return row
    if unstable(coarse, exact) or run.landings > _BOUNCING * max(fine.landings, _LEAST_LANDINGS):
        return replace(row, state="is unstable")
    missed = coarse.touchdown - np.interp(run.times, fine.times, exact.touchdown)
    rms, travel = float(np.sqrt(np.mean(missed * missed))), float(np.ptp(exact.touchdown))
    errors = Errors(
        rms / travel if travel > 0.0 else 0.0,
        change(coarse.moment_range, exact.moment_range),
        change(coarse.largest_force, exact.largest_force),
    )
    return replace(row, errors=errors, rms=rms)


Accuracy = tuple[list[StepRow], StepRow | None, Mesh | None, list[str]]
"""Rows, the largest step first; the reference, None if its run did not end; the mesh; notes."""


def measured_accuracy(zone: Zone, own: OwnSteps | None, timer: Timer) -> Accuracy:
    """Return the errors of time steps and elements of a zone, from runs of the zone."""
    steps, last = _steps_of(zone, own)
    held, notes = zone, []
    if zone.scheme.radius >= _UNDAMPED:
        held = replace(zone, scheme=generalised_alpha(_REFERENCE))
        notes.append(f"The reference is run with generalised-alpha ({_REFERENCE}), which damps.")
    if zone.cost > 1:
        notes.append("Laws with memory take long: two periods are run, and in the first the motion grows.")
    reference = _measured(held, last, timer)
    rows = [_against(_measured(zone, step, timer, own=is_own), reference) for step, is_own in steps]
    if reference.measures is None:
        return rows, None, None, [*notes, f"The reference, a step of {last:.4g}, {reference.state}."]
    mesh = None
    if zone.cost == 1 and rows[-1].measures is not None:
        mesh = _mesh(zone, rows[-1], next((row for row in rows if row.own), rows[-1]), timer)
    return rows, reference, mesh, notes


def _mesh(zone: Zone, finest: StepRow, own: StepRow, timer: Timer) -> Mesh:
    """Return the changes by halving the elements at the shortest step, and the verdict with a consistent matrix."""
    size = float(zone.beam.lengths[zone.node - 1])
    halved = _against(_measured(zone, finest.step, timer, Variant(parts=2)), finest)
    verdict = None
    if own.step > finest.step:
        coarse, fine = (_measured(zone, row.step, timer, Variant(matrix="consistent")) for row in (own, finest))
        verdict = verdict_of(_against(coarse, fine).worst)
    return Mesh(finest.step, (size, 0.5 * size), halved.errors, verdict)


def verdict_of(worst: float) -> str:
    """Return the verdict on a step by its largest error."""
    return "short enough" if worst <= SHORT else "coarse" if worst <= COARSE else "too long"
