"""A mass dropped on an elastic seabed: it comes with some speed, sinks in, and leaves with the same speed.

The deepest penetration z follows from the energies, m v^2 / 2 + w z = U(z), with the stored work U of the law; times
from a tight integration of scipy's that stops at every event.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.study.laws import Falling, Law, LinearLaw
from mudline.study.motion import Motion, Trajectory
from mudline.study.precision.integration import RUNS, Case, Start
from mudline.study.report import StudyError

Rate = Callable[[float, FloatArray], list[float]]
Event = Callable[[float, FloatArray], float]
_MOST_PHASES = 1000
_MOST_EVALUATIONS = 200_000
_MOST_BREAKS = 200
"""A curve of more points is smooth enough to do without stops."""


class Stop(NamedTuple):
    """Where an integration stopped: time, state, and the index of the event."""

    time: float
    state: FloatArray
    event: int


def next_event(rate: Rate, start: Stop, events: Sequence[Event], longest: float) -> Stop:
    """Integrate to the next event other than that of the start; event -1 when there is none up to `longest`."""
    evaluations = iter(range(_MOST_EVALUATIONS))

    def counted(time: float, state: FloatArray) -> list[float]:
        if next(evaluations, None) is None:
            raise StudyError("the exact motion takes too long to find: its stiffnesses differ too much")
        return rate(time, state)

    numbers = [index for index in range(len(events)) if index != start.event]
    wanted = [_terminal(events[index]) for index in numbers]
    found = solve_ivp(
        counted,
        (start.time, longest),
        start.state,
        method="DOP853",
        rtol=1e-12,
        atol=1e-14 * (1.0 + np.abs(start.state)),
        events=wanted,
    )
    if found.status == 1:
        times, states = found.t_events or [], found.y_events or []
        hit = next(place for place, reached in enumerate(times) if len(reached))
        return Stop(float(times[hit][0]), states[hit][0], numbers[hit])
    return Stop(float(found.t[-1]), found.y[:, -1], -1)


def _above(level: float, _: float, state: FloatArray) -> float:
    return float(state[0]) - level


def _terminal(event: Event) -> Event:
    def stop(time: float, state: FloatArray) -> float:
        return event(time, state)

    setattr(stop, "terminal", True)  # noqa: B010 - scipy asks for an attribute of a function
    return stop


class Flight(NamedTuple):
    """A bounce: how long it took, how deep it went, how fast it left."""

    time: float
    deepest: float
    speed: float


def bounce(law: Law, mass: float, weight: float, speed: float) -> Flight:
    """The whole contact of a mass that reaches the seabed with a speed, stopping at every break of the law."""

    def rate(_: float, state: FloatArray) -> list[float]:
        force = float(law.spring(state[:1])[0][0])
        return [float(state[1]), (weight - force) / mass]

    breaks = law.breaks()
    events: list[Event] = [lambda _, state: float(state[0]) + law.top, lambda _, state: float(state[1])]
    if len(breaks) <= _MOST_BREAKS:
        events += [partial(_above, at) for at in breaks.tolist()]
    longest = 1e3 * math.pi / math.sqrt(law.steepest(0.0) / mass)
    stop, deepest = Stop(0.0, np.array([-law.top, speed]), 0), 0.0
    for _ in range(_MOST_PHASES):
        stop = next_event(rate, stop, events, longest)
        deepest = max(deepest, float(stop.state[0]))
        if stop.event <= 0:
            break
    if stop.event != 0:
        raise StudyError(f"{law.name} does not release a mass that falls on it")
    return Flight(stop.time, deepest, -float(stop.state[1]))


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
        system=Falling(np.full(RUNS, drop.mass), drop.law, drop.weight),
        omega=omega,
        duration=1.15 * bounce(drop.law, drop.mass, drop.weight, drop.speed).time,
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
    system = Falling(np.full(RUNS, drop.mass), drop.law, drop.weight)
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


def reference_drop() -> Drop:
    """500 kg fall on 50 kN/m with 0.5 m/s: 0.20820726588 m deep."""
    mass, stiffness, speed = 500.0, 5e4, 0.5
    static = mass * 9.81 / stiffness
    deepest = static + math.sqrt(static**2 + mass * speed**2 / stiffness)
    return Drop(LinearLaw("50 kN/m", stiffness), mass, mass * 9.81, speed, deepest)
