"""Error against run time: three schemes on a motion against the stiffest contact of each kind that a deck has.

A mass is dropped on the stiffest curve or linear law, dragged against the stiffest friction, and pulled off against the
suction. The work of a scheme is its number of force evaluations; what one takes is measured on as many masses side by
side as the deck has elements.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple, Protocol

import numpy as np

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.input import ContactInput
from mudline.model.scene.deck_values import FOOT
from mudline.model.scene.model import Scene
from mudline.tools.study.drops import CurveLaw, drop_to
from mudline.tools.study.schemes import SCHEMES, Motion, Stepper, System, march
from mudline.tools.study.slides import Drag, Pull, SuctionNumbers
from mudline.tools.study.stability import Contact, OwnStep, landing_on

GOALS = (0.01, 0.001)
"""Relative errors for which a step is looked for."""
LARGEST, SMALLEST = 2.5, 2e-3
"""omega dt that are tried; the smallest only where larger ones do not meet the goals."""
_MOST_STEPS = 1500
"""Of a motion: smaller steps are not tried."""
_PER_OCTAVE = 10
_FINER = 8
"""Steps between the largest one that meets a goal and the next."""
_REACH = 0.25
"""Of the diameter: how deep the mass falls."""
_DIAMETER = 0.3
_USUAL_VELOCITY = 0.1
"""Of a pull-out, in m/s; in units of their own per second."""
_MEASURED_STEPS, _REPEATS = 40, 3
_MASSES = (16, 4096)
"""The fewest and the most side by side whose run time is measured."""

Timer = Callable[[], float]
"""Seconds since some moment."""


class Mass(System, Protocol):
    """A motion whose exact outcome is known."""

    @property
    def omega(self) -> float:
        """Root of the largest stiffness over mass."""
        ...

    @property
    def duration(self) -> float:
        """The exact time that it takes."""
        ...

    def start(self, dt: FloatArray) -> Motion:
        """Return masses that begin to move, with steps (k,)."""
        ...

    def errors(self, step: Stepper, dt: FloatArray, /) -> tuple[FloatArray, FloatArray]:
        """Return the largest relative error for steps (k,), and the force evaluations per step."""
        ...


class PrecisionRow(NamedTuple):
    """A scheme on a contact and the largest step for a goal; None where no step that was tried meets it.

    error: at that step. error_at_own_step: at the step of the deck; None where it diverges, or has none.
    evaluations: of the force, per second of motion. run_time: seconds per second of motion and element.
    """

    contact: str
    kind: str
    file: str
    deck_line: int
    scheme: str
    goal: float
    step: float | None
    error: float | None
    error_at_own_step: float | None
    evaluations: float | None
    run_time: float | None


class WorkCurve(NamedTuple):
    """A scheme on a motion over ascending steps (k,): errors, and seconds per second of motion and element.

    own: step, error and run time of the deck's own step; None where it has none, or the motion diverges there.
    """

    motion: str
    scheme: str
    steps: FloatArray
    errors: FloatArray
    run_times: FloatArray
    own: tuple[float, float, float] | None


class Precision(NamedTuple):
    """The rows and what is drawn; why a contact has no motion, in `left_out`."""

    rows: list[PrecisionRow]
    curves: list[WorkCurve]
    left_out: list[str]


def measured(
    scene: Scene, given: ContactInput, contacts: Sequence[Contact], own: OwnStep | None, timer: Timer
) -> Precision:
    """Return the errors and run times of all schemes on the motions of a scene."""
    found = Precision([], [], [])
    for contact, make in _chosen(scene, given, contacts):
        try:
            words, mass = make()
            for scheme in SCHEMES:
                rows, curve = _row_and_curve(contact, words, mass, scheme, own, timer, len(given.element_ids))
                found.rows.extend(rows)
                found.curves.append(curve)
        except (ValueError, ArithmeticError) as error:
            found.left_out.append(f"{contact.row.contact}: no motion: {error}")
    return found


# -------------------------------------------------------------------------------------------------------------- motions

_Made = Callable[[], tuple[str, Mass]]


def _chosen(scene: Scene, given: ContactInput, contacts: Sequence[Contact]) -> Iterator[tuple[Contact, _Made]]:
    """The stiffest contact of each kind that has a motion, and what makes it; ValueError where there is none."""
    landed = max((one for one in contacts if one.law is not None), key=lambda one: one.row.omega, default=None)
    if landed is not None:
        yield landed, lambda: ("drop", _drop(scene, landed))
    rubbed = max((one for one in contacts if one.row.kind == "friction"), key=lambda one: one.row.omega, default=None)
    if rubbed is not None:
        yield rubbed, lambda: ("drag", _drag(scene, given, rubbed))
    pulled = min(
        (one for one in contacts if one.row.kind == "suction"), key=lambda one: one.row.explicit_step, default=None
    )
    if pulled is not None:
        yield pulled, lambda: ("pull-out", _pull(scene, given, pulled, contacts))


def _drop(scene: Scene, contact: Contact) -> Mass:
    element, law = contact.oscillation.element, contact.law
    if law is None:
        raise ValueError("nothing lands on it")
    weight, diameter = float(scene.submerged_weight[element]), float(scene.diameter[element])
    depth = _REACH * (diameter if math.isfinite(diameter) else _DIAMETER)
    if not isinstance(law, CurveLaw):
        depth = max(depth, 8.0 * law.half_width)
    drop = drop_to(law, contact.row.mass, float(np.fmax(weight, 0.0)), depth)
    if drop is None:
        raise ValueError("it never stops a mass that falls on it")
    return drop


def _drag(scene: Scene, given: ContactInput, contact: Contact) -> Mass:
    """Along the direction with the stiffer spring, under the static normal force of the node."""
    friction, row = given.assigned["friction"], contact.row
    at = int(np.searchsorted(friction.rows, contact.oscillation.node))
    coefficients, constant, lengths = (
        np.array([friction[f"{side}_{name}"][at] for side in ("axial", "lateral")])
        for name in ("coefficient", "stiffness", "mobilisation")
    )
    springs = np.where(np.isnan(constant), coefficients / lengths, constant)
    side = int(np.argmax(np.where(coefficients > 0.0, springs, -1.0)))
    limit = row.stiffness * float(lengths[side])
    if not math.isnan(constant[side]):
        limit = float(coefficients[side] * scene.submerged_weight[contact.oscillation.element])
    if not (math.isfinite(limit) and limit > 0.0):
        raise ValueError("the friction limit is not known, as the submerged weight is not")
    return Drag(row.mass, limit, row.stiffness)


def _pull(scene: Scene, given: ContactInput, contact: Contact, contacts: Sequence[Contact]) -> Mass:
    """From the static penetration of an elastic law of the deck: of the same element, else the stiffest."""
    element, suction = contact.oscillation.element, given.assigned["suction"]
    elastic = [one for one in contacts if one.law is not None]
    below = next((one for one in elastic if one.oscillation.element == element), elastic[0] if elastic else None)
    if below is None or below.law is None:
        raise ValueError("there is no elastic law below the suction")
    at = int(np.searchsorted(suction.rows, element))
    numbers = SuctionNumbers(**{name: float(values[at]) for name, values in suction.parameters.items()})
    velocity = _USUAL_VELOCITY / (FOOT if scene.units == "imperial" else 1.0)
    return Pull(below.law, numbers, contact.row.mass, landing_on(scene, below, below.law).deepest, velocity)


# ---------------------------------------------------------------------------------------------------------------- steps


def _row_and_curve(  # noqa: PLR0913, PLR0917 - a scheme on a motion, and how it is measured
    contact: Contact, words: str, mass: Mass, scheme: str, own: OwnStep | None, timer: Timer, elements: int
) -> tuple[list[PrecisionRow], WorkCurve]:
    stepper, row = SCHEMES[scheme], contact.row
    tried = ladder(mass, stepper)
    found = [_largest(mass, stepper, tried, goal) for goal in GOALS]
    usual = found[0].step or float(tried.steps[0])
    cost = seconds_per_evaluation(mass, stepper, usual, elements, timer)
    # a step that is smaller than all that are tried has no larger error than the smallest of them
    at_own = None if own is None else _tried(mass, stepper, np.array([max(own.step, float(tried.steps[0]))]))
    error = None if at_own is None or not math.isfinite(at_own.errors[0]) else float(at_own.errors[0])
    names = (row.contact, row.kind, row.file, row.deck_line, scheme)
    rows = [
        PrecisionRow(
            *names, goal, one.step, one.error, error, one.evaluations, one.evaluations and one.evaluations * cost
        )
        for goal, one in zip(GOALS, found, strict=True)
    ]
    shown = None
    if own is not None and at_own is not None and error is not None:
        shown = (own.step, error, float(at_own.evaluations[0]) / own.step * cost)
    return rows, WorkCurve(
        f"{words}, {row.contact}", scheme, tried.steps, tried.errors, tried.evaluations / tried.steps * cost, shown
    )


class Ladder(NamedTuple):
    """Ascending steps (k,) of a scheme on a motion, their errors (NaN: diverged) and force evaluations per step."""

    steps: FloatArray
    errors: FloatArray
    evaluations: FloatArray


def _tried(mass: Mass, step: Stepper, steps: FloatArray) -> Ladder:
    with np.errstate(all="ignore"):
        return Ladder(steps, *mass.errors(step, steps))


def ladder(mass: Mass, step: Stepper) -> Ladder:
    """Try steps octave by octave, from the largest on, until two octaves meet every goal."""
    highest, met = LARGEST / mass.omega, 0
    lowest = max(SMALLEST / mass.omega, mass.duration / _MOST_STEPS)
    if not 0.0 < lowest < highest < math.inf:
        raise ValueError("its stiffnesses differ too much")
    parts: list[Ladder] = []
    while met < 2 and highest > lowest:
        steps = highest * 0.5 ** (np.arange(_PER_OCTAVE, 0, -1) / _PER_OCTAVE)
        parts.insert(0, _tried(mass, step, steps))
        met = met + 1 if (parts[0].errors <= min(GOALS)).all() else 0
        highest = float(steps[0])
    return Ladder(*(np.concatenate(column) for column in zip(*parts, strict=True)))


class _Reached(NamedTuple):
    """The largest step for a goal, the error there, and evaluations per second of motion."""

    step: float | None
    error: float | None
    evaluations: float | None


def _largest(mass: Mass, step: Stepper, tried: Ladder, goal: float) -> _Reached:
    """The largest step that meets a goal, as all smaller ones do."""
    met = tried.errors <= goal
    first = len(met) if met.all() else int(np.argmin(met))
    if first == 0:
        return _Reached(None, None, None)
    fine = Ladder(*(column[first - 1 : first] for column in tried))
    if first < len(met):
        between = np.geomspace(tried.steps[first - 1], tried.steps[first], _FINER + 2)[:-1]
        fine = _tried(mass, step, between)
        met = fine.errors <= goal
        first = max(len(met) if met.all() else int(np.argmin(met)), 1)
    at = min(first, len(fine.steps)) - 1
    return _Reached(float(fine.steps[at]), float(fine.errors[at]), float(fine.evaluations[at]) / float(fine.steps[at]))


def seconds_per_evaluation(mass: Mass, step: Stepper, dt: float, elements: int, timer: Timer) -> float:
    """Measure what a force evaluation of one of so many masses takes with its share of the scheme."""
    count = min(max(elements, _MASSES[0]), _MASSES[1])
    every = np.full(count, dt)
    steps = max(1, min(_MEASURED_STEPS, math.ceil(mass.duration / dt)))
    taken, evaluations = math.inf, every
    for _ in range(_REPEATS):
        start = mass.start(every)
        began = timer()
        evaluations = march(step, mass, start, every, lambda number, _: number >= steps)
        taken = min(taken, timer() - began)
    return taken / (steps * float(evaluations.sum()))
