"""A mass dropped on an elastic seabed: it comes with some speed, sinks in, and leaves with the same speed.

The deepest penetration z follows from the energies, m v^2 / 2 + w z = U(z), with the stored work U of the law.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.study.motion import Forces, History, Motion, Trajectory
from mudline.study.precision.integration import RUNS, Case, Start
from mudline.study.precision.laws import Law
from mudline.study.precision.reference import contact_time
from mudline.study.report import StudyError

_DOUBLINGS = 12


@dataclass(frozen=True, slots=True)
class Drop:
    """What falls on what: SI or the deck's units, per unit length.

    Attributes:
        law: of the seabed.
        mass: > 0.
        weight: in water.
        speed: with which the mass reaches the seabed.
        deepest: exact deepest penetration.
    """

    law: Law
    mass: float
    weight: float
    speed: float
    deepest: float


@dataclass(frozen=True, slots=True)
class _Falling:
    mass: FloatArray
    law: Law
    weight: float

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        force, slope = self.law.spring(-position)
        return Forces(force - self.weight, -slope, np.zeros(velocity.shape), history)


def drop_to(law: Law, mass: float, weight: float, depth: float) -> Drop:
    """The drop that reaches this penetration, or a multiple of it where the weight alone reaches deeper.

    Raises:
        StudyError: the seabed never carries the weight.
    """
    for doubling in range(_DOUBLINGS):
        deepest = depth * 2.0**doubling
        grid = np.concatenate([np.linspace(0.0, deepest, 400), law.breaks()[law.breaks() < deepest]])
        left = law.work(grid) - weight * grid
        end = float(law.work(np.array([deepest]))[0]) - weight * deepest
        if end > 0.0 and (left < end)[grid < deepest].all() and law.spring(np.array([deepest]))[0][0] > 1.2 * weight:
            return Drop(law, mass, weight, math.sqrt(2.0 * end / mass), deepest)
    raise StudyError(f"{law.name} never stops a mass that falls on it")


def drop_case(name: str, title: str, drop: Drop) -> Case:
    """The case of a drop."""
    omega = math.sqrt(drop.law.steepest(drop.deepest) / drop.mass)
    return Case(
        name=name,
        title=title,
        quantities=("peak penetration", "rebound speed", "energy"),
        reference="balance of energies, exact",
        system=_Falling(np.full(RUNS, drop.mass), drop.law, drop.weight),
        omega=omega,
        duration=1.15 * contact_time(drop.law, drop.mass, drop.weight, drop.speed),
        bound=1e3 * drop.deepest,
        start=lambda dt: _start(drop, dt),
        errors=lambda run: _errors(drop, run),
        missing="no step ended above the seabed in 1.15 times the exact time and 8 steps",
    )


def _start(drop: Drop, dt: float) -> Start:
    """A share of a step above the seabed, on the path that reaches it with the given speed."""
    fall = max(drop.weight, 0.0) / drop.mass
    before = (np.arange(RUNS) + 0.5) / RUNS * min(dt, 0.9 * drop.speed / fall if fall else dt)
    height = drop.law.top + drop.speed * before - 0.5 * fall * before**2
    system = _Falling(np.full(RUNS, drop.mass), drop.law, drop.weight)
    return Start(Motion.start(system, height, fall * before - drop.speed), np.full(RUNS, dt))


def _errors(drop: Drop, run: Trajectory) -> FloatArray:
    exit_, left = _exit(run.position, drop.law.top)
    runs = np.arange(run.position.shape[1])
    x, v = run.position[exit_, runs] - drop.law.top, run.velocity[exit_, runs]
    rebound = np.sqrt(np.maximum(v * v + 2.0 * drop.weight / drop.mass * x, 0.0))
    during = np.arange(len(run.position))[:, None] <= exit_
    kinetic, height = 0.5 * drop.mass * run.velocity**2, run.position - drop.law.top
    energy = kinetic + drop.weight * height + drop.law.work(-run.position.reshape(-1)).reshape(run.position.shape)
    came = 0.5 * drop.mass * drop.speed**2
    errors = np.array(
        [
            np.abs(_deepest(run, during) / drop.deepest - 1.0),
            np.abs(rebound / drop.speed - 1.0),
            np.abs(np.where(during, energy / came - 1.0, 0.0)).max(axis=0),
        ]
    )
    return np.where(left, errors, np.nan)


def _exit(position: FloatArray, top: float) -> tuple[IndexArray, BoolArray]:
    """The first step that ends off the seabed after it was touched, for each run; and whether there is one."""
    touched = np.maximum.accumulate(position < top, axis=0)
    away = touched & (position >= top)
    left: BoolArray = np.any(away, axis=0)
    return np.argmax(away, axis=0), left


def _deepest(run: Trajectory, during: BoolArray) -> FloatArray:
    """The deepest point of the cubics that join positions and velocities of the steps."""
    dt = (run.time[1] - run.time[0])[None, :]
    x0, x1, v0, v1 = run.position[:-1], run.position[1:], dt * run.velocity[:-1], dt * run.velocity[1:]
    square, linear = 3.0 * (2.0 * (x0 - x1) + v0 + v1), 2.0 * (3.0 * (x1 - x0) - 2.0 * v0 - v1)
    root = np.sqrt(np.maximum(linear**2 - 4.0 * square * v0, 0.0))
    share = np.clip(np.nan_to_num(-2.0 * v0 / (linear + root)), 0.0, 1.0)
    low = x0 + share * (v0 + share * (0.5 * linear + share * square / 3.0))
    turns = during[1:] & (v0 <= 0.0) & (v1 >= 0.0)
    deepest: FloatArray = -np.minimum(np.where(turns, low, np.inf).min(axis=0), run.position.min(axis=0))
    return deepest
