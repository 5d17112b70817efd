"""Tight integration that stops at every event, from scipy: for times, and where there is no closed form."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from mudline.contact.arrays import FloatArray
from mudline.study.precision.laws import Law
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


def contact_time(law: Law, mass: float, weight: float, speed: float) -> float:
    """Seconds from touchdown to leaving the seabed."""
    return bounce(law, mass, weight, speed).time
