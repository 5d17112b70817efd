"""Motions of a mass on the seabed whose exact outcome is known: dropped, pulled off against suction, dragged.

A mass dropped on an elastic seabed comes with some speed, sinks in, and leaves with the same speed. The deepest
penetration z follows from the energies, m v^2 / 2 + w z = U(z), with the stored work U of the law; times from a tight
integration of scipy that stops at every event.

A mass is pulled off with a constant force, from its static penetration to beyond breakout. The suction depends on the
velocity, so there is no closed form: the exact values come from an integration that stops at the corners of the
trapezoid, with an independent implementation of the law.

A mass is dragged with some speed, slides against Coulomb friction, and returns. Below the limit mu N friction is a
spring Kt. With omega = sqrt(Kt / m) and the threshold displacement Th = mu N / Kt: it sticks up to Th, where the speed
is v1 = sqrt(v^2 - omega^2 Th^2); slips v1^2 m / (2 mu N) farther; and oscillates about Th before its last place, with
the speed omega Th.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.contact.laws.friction import FrictionHistory, FrictionLaw, slide
from mudline.contact.laws.suction import SuctionHistory, SuctionLaw, SuctionState, step
from mudline.study.laws import Falling, Law, LinearLaw, SuctionNumbers
from mudline.study.motion import Forces, History, Motion, Trajectory
from mudline.study.precision.integration import RUNS, Case, Start, uneven
from mudline.study.report import StudyError

Rate = Callable[[float, FloatArray], list[float]]
Event = Callable[[float, FloatArray], float]
_MOST_PHASES = 1000
_MOST_EVALUATIONS = 200_000
_MOST_BREAKS = 200
"""A curve of more points is smooth enough to be integrated without stops."""
_DOUBLINGS = 12
_MARGIN = 3.0
"""The pull over the largest suction at the usual velocity."""
_STOPS = 20
_SLIDING_SPEED = 3.0
"""Of omega Th: most of the displacement is slip."""
_FINEST = 1e-2
"""Smallest omega dt: laws with a history take ten times the time of a spring."""


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


def _terminal(event: Event) -> Event:
    def stop(time: float, state: FloatArray) -> float:
        return event(time, state)

    setattr(stop, "terminal", True)  # noqa: B010 - scipy asks for an attribute of a function
    return stop


# ----------------------------------------------------------------------------------------------------------------- drop


class Flight(NamedTuple):
    """A bounce: its duration, deepest penetration and rebound speed."""

    time: float
    deepest: float
    speed: float


def bounce(law: Law, mass: float, weight: float, speed: float) -> Flight:
    """The whole contact of a mass that reaches the seabed with a speed, stopping at every break of the law."""

    def rate(_: float, state: FloatArray) -> list[float]:
        force = float(law.spring(state[:1])[0][0])
        return [float(state[1]), (weight - force) / mass]

    def passes(level: float) -> Event:
        return lambda _, state: float(state[0]) - level

    breaks = law.breaks().tolist()
    stops = breaks if len(breaks) <= _MOST_BREAKS else []
    events: list[Event] = [passes(-law.top), lambda _, state: float(state[1]), *map(passes, stops)]
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


@dataclass(frozen=True, slots=True)
class Drop:
    """A drop, in SI or the deck's units, per unit length.

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
    system = Falling(np.full(RUNS, drop.mass), drop.law, drop.weight)
    return Case(
        name=name,
        title=title,
        quantities=("peak penetration", "rebound speed", "energy"),
        reference="balance of energies, exact",
        system=system,
        omega=math.sqrt(drop.law.steepest(drop.deepest) / drop.mass),
        duration=1.15 * bounce(drop.law, drop.mass, drop.weight, drop.speed).time,
        bound=1e3 * drop.deepest,
        start=lambda dt: _start(drop, system, dt),
        errors=lambda run: _errors(drop, run),
        missing="no step ended above the seabed in 1.15 times the exact time and 8 steps",
    )


def _start(drop: Drop, system: Falling, dt: float) -> Start:
    """A share of a step above the seabed, on the path that reaches it with the given speed."""
    fall = max(drop.weight, 0.0) / drop.mass
    before = (np.arange(RUNS) + 0.5) / RUNS * min(dt, 0.9 * drop.speed / fall if fall else dt)
    height = drop.law.top + drop.speed * before - 0.5 * fall * before**2
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


# ----------------------------------------------------------------------------------------------------------------- pull


@dataclass(frozen=True, slots=True)
class Pull:
    """A pull, per unit length.

    Attributes:
        embedment: penetration at the start.
        velocity: a usual pull-out velocity, which scales the pull.
    """

    name: str
    law: Law
    suction: SuctionNumbers
    mass: float
    embedment: float
    velocity: float

    @property
    def pull(self) -> float:
        """Force upwards, in addition to the force that carries the weight."""
        usual = math.pow(self.velocity, self.suction.force_exponent)
        return _MARGIN * self.suction.largest * usual

    def passing(self) -> float:
        """Speed when the mass passes the mudline, from the energies."""
        stored = float(self.law.work(np.array([self.embedment]))[0])
        return math.sqrt(2.0 * (stored + self.pull * self.embedment) / self.mass)


class Breakout(NamedTuple):
    """The exact outcome: seconds from the mudline, uplift and speed at breakout, largest suction, work against it."""

    time: float
    uplift: float
    speed: float
    suction: float
    work: float


def breakout(pull: Pull) -> Breakout:
    """Integrate from the mudline to breakout, stopping at the corners of the trapezoid.

    Raises:
        StudyError: the mass slows down before breakout, or does not break out.
    """
    law, mass, force = pull.suction, pull.mass, pull.pull

    def rate(_: float, state: FloatArray) -> list[float]:
        x, v, _work = state.tolist()
        resistance = law.force(x, v) if x > 0.0 else 0.0
        return [v, (force - resistance) / mass, resistance * v]

    def corner(share: float) -> Event:
        return lambda _, state: float(state[0]) - share * law.depth(float(state[1]))

    events = [corner(share) for share in (law.first_corner, law.second_corner, 1.0)]
    stop = Stop(0.0, np.array([0.0, pull.passing(), 0.0]), -1)
    longest = 1e3 * law.depth(pull.passing()) / pull.passing()
    largest = 0.0
    for _ in range(_STOPS):
        before = float(stop.state[1])
        stop = next_event(rate, stop, events, longest)
        if stop.event < 0 or float(stop.state[1]) < before:
            raise StudyError(f"{pull.name}: the pull does not break the mass out without slowing down")
        largest = max(largest, law.force(float(stop.state[0]), float(stop.state[1])))
        if stop.event == len(events) - 1:
            x, v, work = stop.state.tolist()
            return Breakout(stop.time, x, v, largest, work)
    raise StudyError(f"{pull.name}: the mass passes the corners of its suction law repeatedly")


class _Risen(NamedTuple):
    """History of the suction, and the largest suction so far."""

    suction: SuctionHistory
    largest: FloatArray


@dataclass(frozen=True, slots=True)
class _Rising:
    mass: FloatArray
    law: Law
    suction: SuctionLaw
    pull: float

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        reaction, slope = self.law.spring(-position)
        found, after = step(self.suction, history.suction, np.maximum(position, 0.0), velocity, reaction > 0.0)
        memory = _Risen(after, np.maximum(history.largest, -found.force))
        return Forces(reaction + found.force + self.pull, found.by_uplift - slope, found.by_velocity, memory)


def pull_case(pull: Pull) -> Case:
    """The case of a pull; raises StudyError as `breakout` does."""
    exact = breakout(pull)
    rise = exact.suction / (pull.suction.first_corner * exact.uplift)
    omega = math.sqrt(max(pull.law.steepest(pull.embedment), rise) / pull.mass)
    system = _Rising(np.full(RUNS, pull.mass), pull.law, pull.suction.rows(RUNS), pull.pull)
    rest = pull.passing() * pull.mass / pull.pull

    def start(dt: float) -> Start:
        memory = _Risen(SuctionHistory.initial(system.suction), np.zeros(RUNS))
        return Start(Motion.start(system, np.full(RUNS, -pull.embedment), np.zeros(RUNS), memory), uneven(dt))

    return Case(
        name="pull",
        title=f"pulled off {pull.name}, suction",
        quantities=("largest suction", "speed at breakout", "work against suction"),
        reference="event-located integration (DOP853, rtol 1e-12)",
        system=system,
        omega=omega,
        duration=1.05 * (rest + exact.time),
        bound=1e3 * (exact.uplift + pull.embedment),
        start=start,
        errors=lambda run: _pull_errors(pull, exact, run),
        missing="the mass did not break out in time",
        finest=_FINEST,
    )


def _pull_errors(pull: Pull, exact: Breakout, run: Trajectory) -> FloatArray:
    """After breakout only the pull acts: the speed at the exact uplift follows from the end of a run."""
    memory: _Risen = run.end.history
    x, v = run.end.position, run.end.velocity
    squared = v * v - 2.0 * pull.pull / pull.mass * (x - exact.uplift)
    work = 0.5 * pull.mass * (pull.passing() ** 2 - squared) + pull.pull * exact.uplift
    speed = np.sqrt(np.maximum(squared, 0.0))
    found = np.array([memory.largest / exact.suction, speed / exact.speed, work / exact.work])
    # Broken out, or so far away since that the history was reset.
    out = ~memory.suction.armed & (memory.suction.state != SuctionState.COMPRESSION) & (x > 0.5 * exact.uplift)
    return np.where(out, np.abs(found - 1.0), np.nan)


# ----------------------------------------------------------------------------------------------------------------- drag


@dataclass(frozen=True, slots=True)
class Drag:
    """A mass per unit length, its friction limit mu N, and the stiffness Kt of the friction spring."""

    name: str
    mass: float
    limit: float
    stiffness: float


class _Slid(NamedTuple):
    """History of the friction, and the energy dissipated by slip so far."""

    friction: FrictionHistory
    dissipated: FloatArray


@dataclass(frozen=True, slots=True)
class _Sliding:
    mass: FloatArray
    law: FrictionLaw
    limit: FloatArray

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        points = np.zeros((len(position), 3))
        points[:, 1] = position
        along, across = np.zeros_like(points), np.zeros_like(points)
        along[:, 1], across[:, 2] = 1.0, 1.0
        found = slide(self.law, history.friction, points, (along, across), self.limit)
        memory = _Slid(found.history, history.dissipated + found.dissipated)
        return Forces(found.force[:, 0], found.by_position[:, 0, 0], np.zeros(velocity.shape), memory)


def drag_case(drag: Drag) -> Case:
    """The case of a drag."""
    omega, threshold = math.sqrt(drag.stiffness / drag.mass), drag.limit / drag.stiffness
    speed = _SLIDING_SPEED * omega * threshold
    slipping = math.sqrt(speed**2 - (omega * threshold) ** 2)
    travel = threshold + slipping**2 * drag.mass / (2.0 * drag.limit)
    sticks, slips = math.asin(1.0 / _SLIDING_SPEED) / omega, slipping * drag.mass / drag.limit
    ones = np.ones((RUNS, 2))
    law = FrictionLaw(ones, np.full((RUNS, 2), drag.stiffness), ones, np.zeros(RUNS, np.bool_), np.ones(RUNS, np.bool_))
    system = _Sliding(np.full(RUNS, drag.mass), law, np.full(RUNS, drag.limit))

    def start(dt: float) -> Start:
        memory = _Slid(FrictionHistory.initial(law.active), np.zeros(RUNS))
        motion = Motion.start(system, np.zeros(RUNS), np.full(RUNS, speed), memory)
        return Start(motion, uneven(dt))

    def errors(run: Trajectory) -> FloatArray:
        memory: _Slid = run.end.history
        stretch = run.end.position - memory.friction.stick_points[:, 1]
        back = np.sqrt(run.end.velocity**2 + (omega * stretch) ** 2)
        energy = 0.5 * drag.mass * back**2 + memory.dissipated
        came = 0.5 * drag.mass * speed**2
        return np.abs(np.array([run.position.max(axis=0) / travel, back / (omega * threshold), energy / came]) - 1.0)

    return Case(
        name="drag",
        title=f"dragged, {drag.name}",
        quantities=("maximum displacement", "return velocity", "energy"),
        reference="closed form",
        system=system,
        omega=omega,
        duration=sticks + slips + 0.5 * math.pi / omega,
        bound=1e3 * travel,
        start=start,
        errors=errors,
        missing="",
        finest=_FINEST,
    )
