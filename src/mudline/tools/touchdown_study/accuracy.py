"""Errors of the time steps and of the elements of a touchdown zone, against a finer run of its own."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from mudline.model.results.stage_times import Timer
from mudline.model.scene.load_case import OwnSteps
from mudline.model.scene.time_stepping import generalised_alpha
from mudline.tools.touchdown_study.beam import NotConvergedError, Run
from mudline.tools.touchdown_study.stability import change, unstable
from mudline.tools.touchdown_study.zone import Measures, Variant, Zone

SHORT, COARSE, ADVISED = 0.02, 0.05, 0.01
"""Errors up to which a step is short enough, and coarse; those of a step that is advised."""
MOST_STEPS = 20_000
_FEW = 96.0
"""Steps of a run below which none is tried that is twice as long."""
_BOUNCING = 5.0
"""Of the landings of the reference: a run with more is unstable."""
_LEAST_LANDINGS = 20
_UNDAMPED, _REFERENCE = 0.8, 0.4
"""Spectral radius from which on a scheme is no reference, and that of the scheme that takes its place."""
_NO_STEP = 100.0
"""Steps of a period that are tried where the deck has none."""


class Errors(NamedTuple):
    """Errors against a reference: of the touchdown point over its travel, and with their signs of range and force."""

    touchdown: float
    range: float
    force: float


@dataclass(frozen=True)
class StepRow:
    """A time step.

    own: whether it is the deck's. run_time: seconds of processor time for a second of motion. errors: None for the
    reference and for unstable runs. rms: of the touchdown point, in the deck's unit of length. state: "", or what
    became of the run.
    """

    step: float
    own: bool
    run_time: float | None = None
    measures: Measures | None = field(default=None, repr=False)
    run: Run | None = field(default=None, repr=False)
    errors: Errors | None = None
    rms: float | None = None
    state: str = ""

    @property
    def worst(self) -> float:
        """The largest amount of the errors; infinite for a run that is unstable, or did not end."""
        return math.inf if self.errors is None else max(map(abs, self.errors))

    def json(self) -> dict[str, Any]:
        """Return the row as JSON has it."""
        found, run = self.measures, self.run
        errors = self.errors or (None, None, None)
        return {
            "step": self.step,
            "own": self.own,
            "largest_force": found and found.largest_force,
            "largest_moment": found and found.largest_moment,
            "moment_range": found and found.moment_range,
            "touchdown": found and [float(found.touchdown.min()), float(found.touchdown.max())],
            **dict(zip(("touchdown_error", "range_error", "force_error"), errors, strict=True)),
            "iterations": {"mean": run and run.mean_iterations, "most": run and run.most_iterations},
            "searches": run and run.searches,
            "cuts": run and run.cuts,
            "run_time": self.run_time,
        }


class Mesh(NamedTuple):
    """What halving the elements changes at a step; the verdict with a consistent element matrix."""

    step: float
    element_length: tuple[float, float]
    changes: Errors | None
    consistent_verdict: str | None

    def json(self) -> dict[str, Any]:
        """Return the row as JSON has it."""
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
    """The steps of the rows, the largest first, each with whether it is the deck's, and that of the reference."""
    period = zone.motion.period
    base, given = (period / _NO_STEP, False) if own is None else (own.largest, True)
    budget = MOST_STEPS // zone.cost
    fit: list[tuple[tuple[float, ...], float]] = []
    while True:
        whole = zone.periods * period / base
        fit = [each for each in _LADDERS if whole * (sum(1.0 / part for part in each[0]) + 1.0 / each[1]) <= budget]
        if fit:
            break
        base, given = 2.0 * base, False  # the deck's step is too short to be run: longer ones say whether it has to be
    factors, reference = fit[0]
    steps = {base * part: given and part == 1.0 for part in factors if part <= 1.0 or whole >= _FEW}
    first = own.first if own is not None and given else base
    near = next((step for step in steps if abs(step / first - 1.0) < ADVISED), first)
    if first < base and near >= base * reference:
        steps[near] = True
    return sorted(steps.items(), reverse=True), base * reference


def _measured(zone: Zone, step: float, timer: Timer, variant: Variant = Variant(), *, own: bool = False) -> StepRow:  # noqa: B008 - a constant
    """A row without errors."""
    span, began = zone.periods * zone.motion.period, timer()
    try:
        found, run = zone.run(max(round(span / step), 4 * zone.periods), zone.periods, variant)
    except NotConvergedError:
        return StepRow(step, own, state="does not converge")
    if not np.isfinite(found.touchdown).all():
        return StepRow(step, own, state="has no touchdown in its zone")
    return StepRow(step, own, (timer() - began) / span, found, run)


def _against(row: StepRow, reference: StepRow) -> StepRow:
    """A row with its errors against a reference; an unstable run has none."""
    one, other, run, fine = row.measures, reference.measures, row.run, reference.run
    if one is None or other is None or run is None or fine is None:
        return row
    if unstable(one, other) or run.landings > _BOUNCING * max(fine.landings, _LEAST_LANDINGS):
        return replace(row, state="is unstable")
    missed = one.touchdown - np.interp(run.times, fine.times, other.touchdown)
    rms, travel = float(np.sqrt(np.mean(missed * missed))), float(np.ptp(other.touchdown))
    errors = Errors(
        rms / travel if travel > 0.0 else 0.0,
        change(one.moment_range, other.moment_range),
        change(one.largest_force, other.largest_force),
    )
    return replace(row, errors=errors, rms=rms)


Accuracy = tuple[list[StepRow], StepRow | None, Mesh | None, list[str]]
"""The rows, the largest step first; the reference, None where its run did not end; the mesh; notes."""


def measured_accuracy(zone: Zone, own: OwnSteps | None, timer: Timer) -> Accuracy:
    """Return the errors of time steps and elements of a zone, measured by its own runs."""
    steps, last = _steps_of(zone, own)
    held, notes = zone, []
    if zone.scheme.radius >= _UNDAMPED:
        held = replace(zone, scheme=generalised_alpha(_REFERENCE))
        notes.append(f"The reference is run with generalised-alpha ({_REFERENCE}), which damps.")
    if zone.cost > 1:
        notes.append("Laws that remember take long: two periods are run, the first of which brings the motion up.")
    reference = _measured(held, last, timer)
    rows = [_against(_measured(zone, step, timer, own=is_own), reference) for step, is_own in steps]
    if reference.measures is None:
        return rows, None, None, [*notes, f"The reference, a step of {last:.4g}, {reference.state}."]
    mesh = None
    if zone.cost == 1 and rows[-1].measures is not None:
        mesh = _mesh(zone, rows[-1], next((row for row in rows if row.own), rows[-1]), timer)
    return rows, reference, mesh, notes


def _mesh(zone: Zone, finest: StepRow, own: StepRow, timer: Timer) -> Mesh:
    """What halving the elements changes at the shortest step, and the verdict with a consistent matrix."""
    size = float(zone.beam.lengths[zone.node - 1])
    halved = _against(_measured(zone, finest.step, timer, Variant(parts=2)), finest)
    verdict = None
    if own.step > finest.step:
        one, other = (_measured(zone, row.step, timer, Variant(matrix="consistent")) for row in (own, finest))
        verdict = verdict_of(_against(one, other).worst)
    return Mesh(finest.step, (size, 0.5 * size), halved.errors, verdict)


def verdict_of(worst: float) -> str:
    """Return the verdict on a step by its largest error."""
    return "short enough" if worst <= SHORT else "coarse" if worst <= COARSE else "too long"
