"""Motions of a mass on the seabed whose outcome is known: dropped, pulled off against suction, dragged.

A mass dropped on an elastic seabed comes with some speed, sinks in, and leaves with the same speed. The deepest
penetration z follows from the energies, m v^2 / 2 + w z = U(z), with the stored work U of the law.

A mass is pulled off with a constant force, from its static penetration to beyond breakout. The suction depends on the
velocity, so there is no closed form: the exact values come from a tight integration with an independent implementation
of the law, up to breakout.

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

from mudline.model.contact.arrays import BoolArray, FloatArray
from mudline.model.contact.laws.friction import FrictionHistory, FrictionLaw, slide
from mudline.model.contact.laws.suction import SuctionHistory, SuctionLaw, SuctionState, from_cohesion
from mudline.model.curves import ForceCurve
from tests.benchmarks.studies.laws import CLAY, DIAMETER, MASS, WEIGHT, CurveLaw, Falling, Law, LinearLaw
from tests.benchmarks.studies.motion import Forces, History, Motion, System, Trajectory
from tests.benchmarks.studies.suction import step

Rate = Callable[[float, FloatArray], list[float]]
RUNS = 32
"""Runs side by side, which land at different phases of a step; the worst of them counts."""
_SLIDING_SPEED = 3.0
"""Of omega Th: most of the displacement is slip."""


class Start(NamedTuple):
    """Where the runs begin, and the step of each (k,)."""

    motion: Motion
    dt: FloatArray


@dataclass(frozen=True, slots=True)
class Case:
    """A motion.

    Attributes:
        name: identifier in tables.
        omega: square root of the steepest stiffness over the mass, 1/s.
        duration: seconds that the motion takes.
        system: `RUNS` copies of the mass.
        bound: positions beyond this have diverged.
        start: the start of the runs for a nominal step.
        errors: (3, k) of an amount (penetration, suction or way), a speed and an energy, relative to the exact values;
            NaN where the motion did not get that far.
    """

    name: str
    omega: float
    duration: float
    system: System
    bound: float
    start: Callable[[float], Start]
    errors: Callable[[Trajectory, FloatArray], FloatArray]


def _uneven(dt: float) -> FloatArray:
    """Steps (k,) up to 18 % shorter than dt, so that events of runs that start alike fall at different phases."""
    return dt * (1.0 - np.linspace(0.0, 0.175, RUNS))


def _until(rate: Rate, state: Sequence[float], ends: int) -> tuple[float, FloatArray]:
    """Integrate until a component of the state passes zero upwards: time and state."""

    def event(_: float, now: FloatArray) -> float:
        return float(now[ends])

    event.terminal, event.direction = True, 1.0  # type: ignore[attr-defined]  # scipy asks for these
    found = solve_ivp(rate, (0.0, 1e3), state, method="DOP853", rtol=1e-12, atol=1e-14, events=event, max_step=1e-2)
    if found.status != 1:
        raise ArithmeticError("the motion does not end")
    return float(found.t[-1]), found.y[:, -1]


# ----------------------------------------------------------------------------------------------------------------- drop


@dataclass(frozen=True, slots=True)
class Drop:
    """A mass that falls on a seabed, per unit length: with its weight in water, and its speed at the seabed."""

    law: Law
    mass: float
    weight: float
    speed: float

    @property
    def deepest(self) -> float:
        """Exact deepest penetration: where the work of the law is the energy; by bisection."""
        low, high = 0.0, 1e3
        for _ in range(200):
            z = 0.5 * (low + high)
            rest = 0.5 * self.mass * self.speed**2 + self.weight * z - float(self.law.work(np.array([z]))[0])
            low, high = (z, high) if rest > 0.0 else (low, z)
        return low

    def case(self, name: str) -> Case:
        """The case of the drop."""
        system, deepest = Falling(np.full(RUNS, self.mass), self.law, self.weight), self.deepest

        def rate(_: float, state: FloatArray) -> list[float]:
            return [float(state[1]), float(self.law.spring(-state[:1])[0][0] - self.weight) / self.mass]

        duration, _ = _until(rate, [-1e-12, -self.speed], 0)
        return Case(
            name,
            math.sqrt(self.law.steepest / self.mass),
            1.15 * duration,
            system,
            1e3 * deepest,
            lambda dt: self._start(system, dt),
            lambda run, dt: self._errors(run, dt, deepest),
        )

    def _start(self, system: Falling, dt: float) -> Start:
        """A share of a step above the seabed, on the path that reaches it with the given speed."""
        fall = self.weight / self.mass
        before = (np.arange(RUNS) + 0.5) / RUNS * min(dt, 0.9 * self.speed / fall if fall else dt)
        height = self.speed * before - 0.5 * fall * before**2
        return Start(Motion.start(system, height, fall * before - self.speed), np.full(RUNS, dt))

    def _errors(self, run: Trajectory, dt: FloatArray, deepest: float) -> FloatArray:
        runs = np.arange(RUNS)
        touched = np.maximum.accumulate(run.position < 0.0, axis=0)
        away = touched & (run.position >= 0.0)
        out = np.argmax(away, axis=0)
        x, v = run.position[out, runs], run.velocity[out, runs]
        rebound = np.sqrt(np.maximum(v * v + 2.0 * self.weight / self.mass * x, 0.0))
        during = np.arange(len(run.position))[:, None] <= out
        kinetic = 0.5 * self.mass * run.velocity**2
        stored = self.law.work(-run.position.reshape(-1)).reshape(run.position.shape)
        energy = (kinetic + self.weight * run.position + stored) / (0.5 * self.mass * self.speed**2)
        errors = np.abs(
            [
                _deepest(run, dt, during) / deepest - 1.0,
                rebound / self.speed - 1.0,
                np.abs(np.where(during, energy - 1.0, 0.0)).max(axis=0),
            ]
        )
        return np.where(away.any(axis=0), errors, np.nan)


def _deepest(run: Trajectory, dt: FloatArray, during: BoolArray) -> FloatArray:
    """The deepest point of the cubics that join positions and velocities of the steps."""
    x0, x1, v0, v1 = run.position[:-1], run.position[1:], dt * run.velocity[:-1], dt * run.velocity[1:]
    square, linear = 3.0 * (2.0 * (x0 - x1) + v0 + v1), 2.0 * (3.0 * (x1 - x0) - 2.0 * v0 - v1)
    root = np.sqrt(np.maximum(linear**2 - 4.0 * square * v0, 0.0))
    with np.errstate(all="ignore"):
        share = np.clip(np.nan_to_num(-2.0 * v0 / (linear + root)), 0.0, 1.0)
    low = x0 + share * (v0 + share * (0.5 * linear + share * square / 3.0))
    turns = during[1:] & (v0 <= 0.0) & (v1 >= 0.0)
    deepest: FloatArray = -np.minimum(np.where(turns, low, np.inf).min(axis=0), run.position.min(axis=0))
    return deepest


PUBLISHED = Drop(LinearLaw(5e4), 500.0, 500.0 * 9.81, 0.5)
"""The published case: 0.20820726588 m deep."""
JUMPING = ForceCurve([(0.0, 300.0), *zip(CLAY.ratios.tolist()[1:], CLAY.forces.tolist()[1:], strict=True)])
"""The soft clay with a force at ratio 0, where it begins."""

# ----------------------------------------------------------------------------------------------------------------- pull

_FACTORS = from_cohesion(np.array([5000.0]), np.array([DIAMETER]))
_SUCTION = {name: float(values[0]) for name, values in _FACTORS._asdict().items()}
_CORNERS = {"first_corner": 0.2, "second_corner": 0.8, "cyclic": 1.0, "regularisation": 1e-3, "cyclic_floor": math.nan}
_PULL = 3.0 * _SUCTION["force_factor"] * 0.1 ** _SUCTION["force_exponent"]
"""Three times the largest suction at a tenth of a metre per second."""
_EMBEDMENT = 0.05 * DIAMETER


def _breakout(v: float) -> float:
    """Uplift at breakout at a velocity that never fell."""
    return _SUCTION["depth_factor"] * math.pow(max(v, _CORNERS["regularisation"]), _SUCTION["depth_exponent"])


def _resistance(x: float, v: float) -> float:
    """Suction at an uplift and a velocity above that of the regularisation: an implementation of its own."""
    share = x / _breakout(v)
    trapezoid = min(share / 0.2, 1.0, (1.0 - share) / 0.2)
    return _SUCTION["force_factor"] * math.pow(v, _SUCTION["force_exponent"]) * max(0.0, trapezoid)


class _Risen(NamedTuple):
    """History of the suction, and the largest suction so far."""

    suction: SuctionHistory
    largest: FloatArray


@dataclass(frozen=True, slots=True)
class _Rising:
    mass: FloatArray
    law: Law
    suction: SuctionLaw

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        reaction, slope = self.law.spring(-position)
        found, after = step(self.suction, history.suction, np.maximum(position, 0.0), velocity, reaction > 0.0)
        memory = _Risen(after, np.maximum(history.largest, -found.force))
        return Forces(reaction + found.force + _PULL, found.by_uplift - slope, found.by_velocity, memory)


def pull() -> Case:
    """The mass on the soft clay, pulled off against suction."""
    law = CurveLaw(CLAY, DIAMETER)
    stored = float(law.work(np.array([_EMBEDMENT]))[0])
    passing = math.sqrt(2.0 * (stored + _PULL * _EMBEDMENT) / MASS)

    def rate(share: float) -> Rate:
        """Of uplift, velocity, work, and of the uplift less a share of that at breakout."""

        def rates(_: float, state: FloatArray) -> list[float]:
            x, v = float(state[0]), float(state[1])
            force = _resistance(x, v)
            acceleration = (_PULL - force) / MASS
            return [
                v,
                acceleration,
                force * v,
                v - share * _SUCTION["depth_exponent"] * _breakout(v) / v * acceleration,
            ]

        return rates

    time, (uplift, speed, work, _) = _until(rate(1.0), [0.0, passing, 0.0, -_breakout(passing)], 3)
    # while the velocity grows, so does the plateau of the suction: it is largest at its second corner
    _, (corner, then, _, _) = _until(rate(0.8), [0.0, passing, 0.0, -0.8 * _breakout(passing)], 3)
    largest = _resistance(float(corner), float(then))
    law_rows = SuctionLaw(**{name: np.full(RUNS, value) for name, value in {**_SUCTION, **_CORNERS}.items()})
    system = _Rising(np.full(RUNS, MASS), law, law_rows)

    def start(dt: float) -> Start:
        memory = _Risen(SuctionHistory.initial(law_rows), np.zeros(RUNS))
        return Start(Motion.start(system, np.full(RUNS, -_EMBEDMENT), np.zeros(RUNS), memory), _uneven(dt))

    def errors(run: Trajectory, _: FloatArray) -> FloatArray:
        """After breakout only the pull acts: the speed at the exact uplift follows from the end of a run."""
        memory: _Risen = run.end.history
        x, v = run.end.position, run.end.velocity
        squared = v * v - 2.0 * _PULL / MASS * (x - uplift)
        done = 0.5 * MASS * (passing**2 - squared) + _PULL * uplift
        found = np.array([memory.largest / largest, np.sqrt(np.maximum(squared, 0.0)) / speed, done / work])
        # broken out, or so far away since that the history was reset
        out = ~memory.suction.armed & (memory.suction.state != SuctionState.COMPRESSION) & (x > 0.5 * uplift)
        return np.where(out, np.abs(found - 1.0), np.nan)

    duration = 1.05 * (passing * MASS / _PULL + time)
    return Case("pull", math.sqrt(law.steepest / MASS), duration, system, 1e3 * uplift, start, errors)


# ----------------------------------------------------------------------------------------------------------------- drag


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


def drag() -> Case:
    """The mass dragged along: a limit of half its weight, mobilised over 3 mm."""
    limit = 0.5 * WEIGHT
    stiffness = limit / 0.003
    omega, threshold = math.sqrt(stiffness / MASS), limit / stiffness
    speed = _SLIDING_SPEED * omega * threshold
    slipping = math.sqrt(speed**2 - (omega * threshold) ** 2)
    travel = threshold + slipping**2 * MASS / (2.0 * limit)
    sticks, slips = math.asin(1.0 / _SLIDING_SPEED) / omega, slipping * MASS / limit
    ones = np.ones((RUNS, 2))
    law = FrictionLaw(ones, stiffness * ones, ones, np.zeros(RUNS, np.bool_), np.ones(RUNS, np.bool_))
    system = _Sliding(np.full(RUNS, MASS), law, np.full(RUNS, limit))

    def start(dt: float) -> Start:
        memory = _Slid(FrictionHistory.initial(law.active), np.zeros(RUNS))
        return Start(Motion.start(system, np.zeros(RUNS), np.full(RUNS, speed), memory), _uneven(dt))

    def errors(run: Trajectory, _: FloatArray) -> FloatArray:
        memory: _Slid = run.end.history
        stretch = run.end.position - memory.friction.stick_points[:, 1]
        back = np.sqrt(run.end.velocity**2 + (omega * stretch) ** 2)
        energy = (0.5 * MASS * back**2 + memory.dissipated) / (0.5 * MASS * speed**2)
        return np.abs(np.array([run.position.max(axis=0) / travel, back / (omega * threshold), energy]) - 1.0)

    return Case("drag", omega, sticks + slips + 0.5 * math.pi / omega, system, 1e3 * travel, start, errors)


def cases() -> list[Case]:
    """All of them: on a linear seabed, on the soft clay, on the same with a jump of the force, pulled and dragged."""
    return [
        PUBLISHED.case("drop, linear"),
        Drop(CurveLaw(CLAY, DIAMETER), MASS, WEIGHT, 0.4).case("drop, curve"),
        Drop(CurveLaw(JUMPING, DIAMETER), MASS, WEIGHT, 0.4).case("drop, jump"),
        pull(),
        drag(),
    ]
