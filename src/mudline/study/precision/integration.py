"""Every scheme on every case over a ladder of steps."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray
from mudline.study.motion import Scheme, march
from mudline.study.precision.case import RUNS, Case
from mudline.study.schemes import SCHEMES

LADDER = (1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 3.0, 10.0)
"""Of omega dt."""
FINE_LADDER = tuple(10.0 ** (power / 6.0) for power in range(-18, 7))
_TRIED = tuple(name for name, scheme in SCHEMES.items() if scheme.limit > 0.0)
_MORE_STEPS = 8
_MOST_STEPS = 60_000
_FAILED = (None, None, None)


class StepRow(NamedTuple):
    """A scheme on a case at a step: the largest errors of all runs, None where one of them failed.

    errors: of the three quantities of the case.
    seconds, evaluations: of run time, and of the forces, per simulated second; all runs side by side count as one.
    iterations: Newton iterations per step, the mean.
    failed: runs that failed, and why the first of them did.
    """

    case: str
    scheme: str
    omega_dt: float
    dt: float
    steps: int
    errors: tuple[float | None, float | None, float | None]
    seconds: float
    evaluations: float
    iterations: float
    failed: int
    reason: str


def tried() -> list[Scheme]:
    """The schemes of this study: those that are stable on an oscillator at some step."""
    return [SCHEMES[name] for name in _TRIED]


def integrate(cases: Iterable[Case], ladder: tuple[float, ...]) -> Iterator[StepRow]:
    """Run all of it."""
    for case in cases:
        for scheme in tried():
            for omega_dt in ladder:
                yield row(case, scheme, omega_dt)


def row(case: Case, scheme: Scheme, omega_dt: float) -> StepRow:
    """One scheme on one case at one step."""
    nominal = omega_dt / case.omega
    start = case.start(nominal)
    steps = math.ceil(case.duration / float(start.dt.min())) + _MORE_STEPS
    if steps > _MOST_STEPS:
        reason = f"it would take {steps} steps: the stiffnesses of the bed are too far apart"
        return StepRow(case.name, scheme.name, omega_dt, nominal, steps, _FAILED, 0.0, 0.0, 0.0, RUNS, reason)
    run = march(scheme, case.system, start.motion, start.dt, steps, case.bound)
    with np.errstate(all="ignore"):
        errors = case.errors(run)
    missing: BoolArray = np.any(np.isnan(errors), axis=0)
    missing[list(run.failures)] = True
    reason = ""
    if missing.any():
        reason = run.failures.get(int(np.argmax(missing)), case.missing)
    first, second, third = np.max(errors, axis=1).tolist()
    simulated = steps * nominal
    return StepRow(
        case.name,
        scheme.name,
        omega_dt,
        nominal,
        steps,
        _FAILED if reason else (first, second, third),
        run.seconds / simulated,
        run.evaluations / simulated,
        float(run.iterations.mean()),
        int(missing.sum()),
        f"{int(missing.sum())} of {RUNS} runs: {reason}" if reason else "",
    )
