"""A mass pulled off the seabed against suction, and one dragged along it against friction: laws that remember.

It is pulled with a constant force, from its static penetration to beyond breakout. The suction depends on the velocity,
so there is no closed form: the exact values come from an integration that stops at the corners of the trapezoid, with
an independent implementation of the law.

It is dragged with some speed, slides against Coulomb friction, and returns. Below the limit mu N friction is a spring
Kt. With omega = sqrt(Kt / m) and the threshold displacement Th = mu N / Kt: it sticks up to Th, where the speed is
v1 = sqrt(v^2 - omega^2 Th^2); slips v1^2 m / (2 mu N) farther; and oscillates about Th before its last place, with the
speed omega Th.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.laws.friction import FrictionHistory, FrictionLaw, slide
from mudline.contact.laws.suction import SuctionHistory, SuctionLaw, SuctionState, step
from mudline.study.laws import Law
from mudline.study.motion import Forces, History, Motion, Trajectory
from mudline.study.precision.drop import Event, Stop, next_event
from mudline.study.precision.integration import RUNS, Case, Start, uneven
from mudline.study.report import StudyError

_MARGIN = 3.0
"""The pull over the largest suction at the usual velocity."""
_STOPS = 20
_FINEST = 1e-2
"""Of omega dt: laws that remember take ten times the time of a spring."""


class SuctionNumbers(NamedTuple):
    """The suction law of one element, as numbers; the fields are those of `SuctionLaw`."""

    force_factor: float
    force_exponent: float
    depth_factor: float
    depth_exponent: float
    first_corner: float
    second_corner: float
    cyclic: float
    regularisation: float
    cyclic_floor: float = math.nan

    def rows(self, count: int) -> SuctionLaw:
        """The law of so many elements."""
        return SuctionLaw(*(np.full(count, value) for value in self))

    @property
    def largest(self) -> float:
        """The factor of the largest suction before an uplift cycle is completed."""
        return self.force_factor * (self.cyclic if math.isnan(self.cyclic_floor) else 1.0)

    def depth(self, v: float) -> float:
        """Uplift at breakout at a velocity that never fell."""
        return self.depth_factor * math.pow(max(v, self.regularisation, 5e-324), self.depth_exponent)

    def force(self, x: float, v: float) -> float:
        """Suction at an uplift and a velocity > 0 that never fell."""
        n, share = self.force_exponent, x / self.depth(v)
        slow = v / self.regularisation if self.regularisation > v and n < 2.0 else 1.0
        most = self.largest * math.pow(v / slow, n) * slow * (2.0 - n + (n - 1.0) * slow)
        return most * max(0.0, min(share / self.first_corner, 1.0, (1.0 - share) / (1.0 - self.second_corner)))


@dataclass(frozen=True, slots=True)
class Pull:
    """What is pulled off what: per unit length.

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
        """Force upwards, besides what carries the weight."""
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
    """What suction remembers, and the largest suction so far."""

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
        start_height = np.full(RUNS, -pull.embedment)
        return Start(Motion.start(system, start_height, np.zeros(RUNS), memory), uneven(dt))

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
    """Behind breakout only the pull acts: the speed at the exact uplift follows from where a run ended."""
    memory: _Risen = run.end.history
    x, v = run.end.position, run.end.velocity
    squared = v * v - 2.0 * pull.pull / pull.mass * (x - exact.uplift)
    work = 0.5 * pull.mass * (pull.passing() ** 2 - squared) + pull.pull * exact.uplift
    found = np.array(
        [memory.largest / exact.suction, np.sqrt(np.maximum(squared, 0.0)) / exact.speed, work / exact.work]
    )
    # Broken out, or so far away since that the history was reset.
    out = ~memory.suction.armed & (memory.suction.state != SuctionState.COMPRESSION) & (x > 0.5 * exact.uplift)
    return np.where(out, np.abs(found - 1.0), np.nan)


_SPEED = 3.0
"""Of omega Th: most of the displacement is slip."""


@dataclass(frozen=True, slots=True)
class Drag:
    """A mass per unit length, its friction limit mu N, and the stiffness Kt of the friction spring."""

    name: str
    mass: float
    limit: float
    stiffness: float


class _Slid(NamedTuple):
    """What friction remembers, and the work done against slipping so far."""

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
    speed = _SPEED * omega * threshold
    slipping = math.sqrt(speed**2 - (omega * threshold) ** 2)
    travel = threshold + slipping**2 * drag.mass / (2.0 * drag.limit)
    sticks, slips = math.asin(1.0 / _SPEED) / omega, slipping * drag.mass / drag.limit
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
        found = np.array(
            [
                run.position.max(axis=0) / travel,
                back / (omega * threshold),
                energy / (0.5 * drag.mass * speed**2),
            ]
        )
        return np.abs(found - 1.0)

    return Case(
        name="drag",
        title=f"dragged on {drag.name}, friction",
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
